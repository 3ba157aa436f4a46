// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Cluster culling callbacks that are taken off a graph, and those that are not.

#include "ClusterRemover.h"

#include <gtest/gtest.h>
#include <osg/ClusterCullingCallback>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/NodeCallback>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgDB/WriteFile>
#include <osgTerrain/TerrainTile>

#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::bench {
namespace {

osg::ref_ptr<osg::ClusterCullingCallback> cluster() {
    return new osg::ClusterCullingCallback(osg::Vec3(1, 0, 0), osg::Vec3(1, 0, 0), 0.5F);
}

TEST(ClusterRemover, TakesThemOffNodesAndDrawables) {
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

TEST(ClusterRemover, LeavesOtherCallbacksOfTheChain) {
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    const osg::ref_ptr<osg::NodeCallback> other = new osg::NodeCallback;
    root->addCullCallback(other);
    root->addCullCallback(cluster());
    EXPECT_EQ(removeClusterCallbacks(*root), 1U);
    EXPECT_EQ(root->getCullCallback(), other);
    EXPECT_EQ(other->getNestedCallback(), nullptr);
}

TEST(ClusterRemover, TreatsTerrainTilesWithoutTraversingThem) {
    const osg::ref_ptr<osgTerrain::TerrainTile> tile = new osgTerrain::TerrainTile;
    tile->setCullCallback(cluster());
    EXPECT_EQ(removeClusterCallbacks(*tile), 1U);
    // A traversal would have given it a technique.
    EXPECT_EQ(tile->getTerrainTechnique(), nullptr);
}

TEST(ClusterRemover, TreatsWhatIsReadAsItIsTold) {
    const test::TemporaryFolder folder;
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    root->setCullCallback(cluster());
    const std::string file = folder / "scene.osgt";
    ASSERT_TRUE(osgDB::writeNodeFile(*root, file));
    const osg::ref_ptr<osgDB::ReadFileCallback> before = osgDB::Registry::instance()->getReadFileCallback();
    const osg::ref_ptr<ClusterRemover> remover = ClusterRemover::install();
    EXPECT_NE(osgDB::readRefNodeFile(file)->getCullCallback(), nullptr);
    remover->setTreatment(Clusters::Remove);
    EXPECT_EQ(osgDB::readRefNodeFile(file)->getCullCallback(), nullptr);
    osgDB::Registry::instance()->setReadFileCallback(before);
}

}  // namespace
}  // namespace osgAnalyticBin::bench
