// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ClusterRemover.h"

#include <gtest/gtest.h>
#include <osg/Geode>
#include <osg/PagedLOD>
#include <osgDB/ReadFile>
#include <osgDB/Registry>

namespace osgAnalyticBin::bench {
namespace {

// Any file: a group with a PagedLOD, whose second page is kept for ten seconds. Files of OSG do not hold these times.
class Pages : public osgDB::ReadFileCallback {
public:
    osgDB::ReaderWriter::ReadResult readNode(const std::string&, const osgDB::Options*) override {
        const osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
        lod->addChild(new osg::Geode, 1e5F, 1e10F);
        lod->setFileName(1, "near.osgt");
        lod->setFileName(2, "nearer.osgt");
        lod->setMinimumExpiryTime(2, 10.0);
        const osg::ref_ptr<osg::Group> root = new osg::Group;
        root->addChild(lod);
        return root.get();
    }
};

TEST(ExpiryRaiser, RaisesTimesOfPagedChildrenThatAreShorter) {
    osgDB::Registry& registry = *osgDB::Registry::instance();
    const osg::ref_ptr<osgDB::ReadFileCallback> before = registry.getReadFileCallback();
    registry.setReadFileCallback(new Pages);
    const osg::ref_ptr<ExpiryRaiser> raiser = ExpiryRaiser::install();
    const auto expectTimes = [](double first, double second) {
        const osg::ref_ptr<osg::Node> root = osgDB::readRefNodeFile("scene.osgt");
        ASSERT_TRUE(root.valid());
        const auto& lod = dynamic_cast<const osg::PagedLOD&>(*root->asGroup()->getChild(0));
        EXPECT_EQ(lod.getMinimumExpiryTime(0), 0.0) << "its own mesh never expires";
        EXPECT_EQ(lod.getMinimumExpiryTime(1), first);
        EXPECT_EQ(lod.getMinimumExpiryTime(2), second);
    };
    expectTimes(0.0, 10.0);
    raiser->setSeconds(3.0);
    expectTimes(3.0, 10.0);
    raiser->setSeconds(20.0);
    expectTimes(20.0, 20.0);
    raiser->setSeconds(0.0);
    expectTimes(0.0, 10.0);
    registry.setReadFileCallback(before);
}

}  // namespace
}  // namespace osgAnalyticBin::bench
