// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The classes that OSG loads by name, through .osgt and .osgb files and the serializer module.
// Needs OSG_LIBRARY_PATH to name the folder above osgPlugins-3.6.5.

#include "CullFixture.h"

#include <osgAnalyticBin/HiddenByTerrainCallback.h>
#include <osgAnalyticBin/InstallBinsCallback.h>

#include <gtest/gtest.h>
#include <osg/MatrixTransform>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <support/CapturedNotes.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

using core::GeodeticBin;

class Serializer : public ::testing::TestWithParam<const char*> {
protected:
    osg::ref_ptr<osg::Node> roundTrip(const osg::Node& node) {
        const std::string file = _folder / (std::string("node.") + GetParam());
        if (!osgDB::writeNodeFile(node, file)) return nullptr;
        return osgDB::readRefNodeFile(file);
    }
    osg::ref_ptr<AnalyticBinCullCallback> roundTrip(AnalyticBinCullCallback* callback) {
        const osg::ref_ptr<osg::Group> node = new osg::Group;
        node->setCullCallback(callback);
        const osg::ref_ptr<osg::Node> back = roundTrip(*node);
        return back ? dynamic_cast<AnalyticBinCullCallback*>(back->getCullCallback()) : nullptr;
    }
    test::TemporaryFolder _folder;
};

AnalyticBin awkwardBin() {
    return AnalyticBin(GeodeticBin({0.1234567890123456, 0.2345678901234567}, {3.0, 3.3}, {-10376.123456789, 1.0 / 3.0}),
                       0.0625);
}

TEST_P(Serializer, TheCullCallbackReadsBackExactly) {
    CullOptions options = test::by(Method::Exact);
    options.expiry = 1.0 + 1.0 / 3.0;
    const osg::Matrixd frame = osg::Matrixd::rotate(1.0, 1, 2, 3) * osg::Matrixd::translate(1e6 / 3.0, 2e6 / 7.0, -5e6);
    const osg::ref_ptr<AnalyticBinCullCallback> written = new AnalyticBinCullCallback(
        AnalyticBin(GeodeticBin::fromDegrees({0, 11.25}, {168.75, 180}, {-7.25, 8848.86}), 1.0),
        osg::EllipsoidModel(3396190.125, 3376200.0 + 1.0 / 3.0), options);
    written->setLocalToEcef(frame);
    AnalyticBin surface = awkwardBin();
    surface.setSag(1.0 / 7.0);
    written->setSurface(surface);
    written->setSkirt(100.0 / 3.0);
    written->setTerrainShape(TerrainShape{10.0 / 3.0, 0.5, true, HUGE_VAL});
    const osg::ref_ptr<AnalyticBinCullCallback> read = roundTrip(written);
    ASSERT_TRUE(read && read->getTerrainShape().has_value());
    EXPECT_EQ(read->getBin(), written->getBin());
    EXPECT_EQ(read->getCullOptions().method, Method::Exact);
    EXPECT_EQ(read->getCullOptions().expiry, options.expiry);
    EXPECT_EQ(read->getRadiiText(), written->getRadiiText());
    EXPECT_EQ(read->getLocalToEcef(), frame);
    EXPECT_TRUE(*read->getTerrainShape() == *written->getTerrainShape());
    EXPECT_EQ(read->getSkirt(), written->getSkirt());
    EXPECT_TRUE(read->getSurface().contains(surface));
    EXPECT_EQ(read->getSurface().sag(), surface.sag());
}

TEST_P(Serializer, TheRequestAndNestedCallbacksReadBack) {
    const osg::ref_ptr<osg::Group> node = new osg::Group;
    node->setUpdateCallback(new InstallBinsCallback(test::by(Method::Exact)));
    node->addCullCallback(new HiddenByTerrainCallback);
    node->addCullCallback(new AnalyticBinCullCallback(awkwardBin(), osg::EllipsoidModel()));
    node->addCullCallback(new AnalyticBinCullCallback);
    const osg::ref_ptr<osg::Node> back = roundTrip(*node);
    ASSERT_TRUE(back);
    EXPECT_EQ(dynamic_cast<InstallBinsCallback&>(*back->getUpdateCallback()).getCullOptions().method, Method::Exact);
    ASSERT_NE(dynamic_cast<HiddenByTerrainCallback*>(back->getCullCallback()), nullptr);
    const auto* const bin = dynamic_cast<AnalyticBinCullCallback*>(back->getCullCallback()->getNestedCallback());
    ASSERT_NE(bin, nullptr);
    EXPECT_NE(dynamic_cast<const AnalyticBinCullCallback*>(bin->getNestedCallback()), nullptr);
}

TEST_P(Serializer, AnInstalledTerrainStaysVisibleWhenItComesBackWithoutItsDatabase) {
    const osg::ref_ptr<osg::Group> node = new osg::Group;
    const osg::ref_ptr<AnalyticBinCullCallback> written = new AnalyticBinCullCallback(
        AnalyticBin(GeodeticBin::fromDegrees({10, 20}, {10, 20}, {0, 5000})), osg::EllipsoidModel());
    written->setTerrainShape(TerrainShape{10.0, 1.0, false, 50.0});
    node->setCullCallback(written.get());
    node->setCullingActive(false);
    node->addChild(new osg::Group);
    const osg::ref_ptr<osg::Node> back = roundTrip(*node);
    ASSERT_TRUE(back);
    std::set<std::string> visited;
    back->asGroup()->getChild(0)->setCullCallback(new test::VisitRecorder("below", visited));
    (void)test::cull(*back, test::CullView::lookAt({-1e7, 0, 0}, {-2e7, 0, 0}, {0, 0, 1}, 10.0));
    EXPECT_EQ(visited.size(), 1u);
}

TEST(SerializedText, WithABrokenItemIsNeverCulled) {
    const std::string bin = AnalyticBin(GeodeticBin::fromDegrees({10, 20}, {10, 20}, {0, 5000})).toText();
    for (const char* item : {"; skirt x", "; surface 1 2", "; terrain 1 2 3", "; other 1"}) {
        const osg::ref_ptr<AnalyticBinCullCallback> callback = new AnalyticBinCullCallback;
        callback->setBinText(bin);
        EXPECT_TRUE(callback->getBin().valid());
        callback->setBinText(bin + item);
        EXPECT_FALSE(callback->getBin().valid()) << item;
    }
}

TEST_P(Serializer, DefaultsReadBackAsDefaults) {
    const osg::ref_ptr<osg::Group> node = new osg::Group;
    node->setCullCallback(new AnalyticBinCullCallback);
    node->setUpdateCallback(new InstallBinsCallback);
    const osg::ref_ptr<osg::Node> back = roundTrip(*node);
    ASSERT_TRUE(back);
    const auto& read = dynamic_cast<AnalyticBinCullCallback&>(*back->getCullCallback());
    EXPECT_FALSE(read.getBin().valid());
    EXPECT_EQ(read.getCullOptions().method, Method::Quadratic);
    EXPECT_EQ(read.getRadiiText(), osg::ref_ptr<AnalyticBinCullCallback>(new AnalyticBinCullCallback)->getRadiiText());
    EXPECT_TRUE(read.getLocalToEcef().isIdentity());
    EXPECT_EQ(dynamic_cast<InstallBinsCallback&>(*back->getUpdateCallback()).getCullOptions().method,
              Method::Quadratic);
}

TEST_P(Serializer, AStoredBinReadsBackExactly) {
    const osg::ref_ptr<osg::Group> node = new osg::Group;
    const AnalyticBin bin(GeodeticBin::fromDegrees({-11.25, 0}, {0, 11.25}, {-412.0, 1.0 / 3.0}), 0.1);
    setStoredBin(*node, bin);
    setStoredSurfaceLow(*node, -411.0 / 3.0);
    const osg::ref_ptr<osg::Node> back = roundTrip(*node);
    ASSERT_TRUE(back);
    EXPECT_EQ(storedBin(*back), bin);
    EXPECT_EQ(storedSurfaceLow(*back), -411.0 / 3.0);
}

INSTANTIATE_TEST_SUITE_P(Formats, Serializer, ::testing::Values("osgt", "osgb", "osgx"),
                         [](const auto& suite) { return std::string(suite.param); });

// As a scene may hold it with every tile.
TEST(StoredOptions, OfAMethodForComparisonAreTheDefaultAfterOneWarning) {
    const std::string text = "method=paper,horizon=-500";
    const test::CapturedNotes notes;
    const osg::ref_ptr<InstallBinsCallback> request = new InstallBinsCallback;
    request->setOptionsText(text);
    EXPECT_TRUE(request->getCullOptions() == CullOptions());
    for (int tile = 0; tile < 3; ++tile) {
        const osg::ref_ptr<AnalyticBinCullCallback> callback = new AnalyticBinCullCallback;
        callback->setOptionsText(text);
        EXPECT_TRUE(callback->getCullOptions() == CullOptions());
    }
    EXPECT_EQ(notes.count("bad method \"paper\""), 1u);
}

}  // namespace
}  // namespace osgAnalyticBin
