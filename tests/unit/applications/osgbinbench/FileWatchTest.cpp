// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What is done with files that are read: cluster culling callbacks that are taken off, times that are raised.

#include "ClusterCallbacks.h"
#include "FileWatch.h"

#include <gtest/gtest.h>
#include <osg/ClusterCullingCallback>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/NodeCallback>
#include <osg/PagedLOD>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgDB/WriteFile>
#include <osgTerrain/TerrainTile>

#include <filesystem>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::bench {
namespace {

osg::ref_ptr<osg::ClusterCullingCallback> cluster() {
    return new osg::ClusterCullingCallback(osg::Vec3(1, 0, 0), osg::Vec3(1, 0, 0), 0.5F);
}

TEST(RemoveClusterCallbacks, TakesThemOffNodesAndDrawables) {
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    root->addChild(geode);
    geode->addDrawable(geometry);
    root->setCullCallback(cluster());
    geometry->setCullCallback(cluster());
    EXPECT_EQ(removeClusterCallbacks(*root), 2U);
    EXPECT_EQ(root->getCullCallback(), nullptr);
    EXPECT_EQ(geometry->getCullCallback(), nullptr);
    EXPECT_EQ(removeClusterCallbacks(*root), 0U);
}

TEST(RemoveClusterCallbacks, LeavesOtherCallbacksOfTheChain) {
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    const osg::ref_ptr<osg::NodeCallback> other = new osg::NodeCallback;
    root->addCullCallback(other);
    root->addCullCallback(cluster());
    EXPECT_EQ(removeClusterCallbacks(*root), 1U);
    EXPECT_EQ(root->getCullCallback(), other);
    EXPECT_EQ(other->getNestedCallback(), nullptr);
}

TEST(RemoveClusterCallbacks, TreatsTerrainTilesWithoutTraversingThem) {
    const osg::ref_ptr<osgTerrain::TerrainTile> tile = new osgTerrain::TerrainTile;
    tile->setCullCallback(cluster());
    EXPECT_EQ(removeClusterCallbacks(*tile), 1U);
    // A traversal would have given it a technique.
    EXPECT_EQ(tile->getTerrainTechnique(), nullptr);
}

TEST(FileWatch, TreatsWhatIsReadAsItIsTold) {
    const test::TemporaryFolder folder;
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    root->setCullCallback(cluster());
    const std::string file = folder / "scene.osgt";
    ASSERT_TRUE(osgDB::writeNodeFile(*root, file));
    const osg::ref_ptr<FileWatch> watch = new FileWatch;
    watch->install();
    EXPECT_NE(osgDB::readRefNodeFile(file)->getCullCallback(), nullptr);
    watch->setTreatment(Clusters::Remove, 0.0);
    EXPECT_EQ(osgDB::readRefNodeFile(file)->getCullCallback(), nullptr);
    EXPECT_EQ(watch->nodeFiles(), 2U);
    EXPECT_EQ(watch->nodeBytes(), 2 * std::filesystem::file_size(file));
    watch->uninstall();
    EXPECT_NE(osgDB::Registry::instance()->getReadFileCallback(), watch.get());
}

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

TEST(FileWatch, RaisesTimesOfPagedChildrenThatAreShorter) {
    osgDB::Registry& registry = *osgDB::Registry::instance();
    const osg::ref_ptr<osgDB::ReadFileCallback> before = registry.getReadFileCallback();
    registry.setReadFileCallback(new Pages);
    const osg::ref_ptr<FileWatch> watch = new FileWatch;
    watch->install();
    const auto expectTimes = [](double first, double second) {
        const osg::ref_ptr<osg::Node> root = osgDB::readRefNodeFile("scene.osgt");
        ASSERT_TRUE(root.valid());
        const auto& lod = dynamic_cast<const osg::PagedLOD&>(*root->asGroup()->getChild(0));
        EXPECT_EQ(lod.getMinimumExpiryTime(0), 0.0) << "its own mesh never expires";
        EXPECT_EQ(lod.getMinimumExpiryTime(1), first);
        EXPECT_EQ(lod.getMinimumExpiryTime(2), second);
    };
    expectTimes(0.0, 10.0);
    watch->setTreatment(Clusters::Keep, 3.0);
    expectTimes(3.0, 10.0);
    watch->setTreatment(Clusters::Keep, 20.0);
    expectTimes(20.0, 20.0);
    watch->setTreatment(Clusters::Keep, 0.0);
    expectTimes(0.0, 10.0);
    registry.setReadFileCallback(before);
}

}  // namespace
}  // namespace osgAnalyticBin::bench
