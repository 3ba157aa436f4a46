// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Files that name themselves, each other, or what is none of the database's business. The kit reads nothing that the
// pager does not ask for, and follows cycles no farther than the pager does.

#include "CountedReads.h"
#include "CullFixture.h"
#include "DatabaseFixture.h"

#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/CoordinateSystemNode>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgDB/WriteFile>
#include <osgUtil/UpdateVisitor>

#include <string>
#include <support/CapturedNotes.h>
#include <support/TemporaryFolder.h>
#include <utility>

namespace osgAnalyticBin::test {
namespace {

class HostileNames : public ::testing::Test {
protected:
    void SetUp() override { osgDB::Registry::instance()->setReadFileCallback(_reads); }
    void TearDown() override { osgDB::Registry::instance()->setReadFileCallback(nullptr); }

    // A tile in a file, that pages another; a root has a globe above it.
    void write(const std::string& file, const std::string& paged, bool isRoot) {
        const osg::ref_ptr<osg::Group> root = isRoot ? new osg::CoordinateSystemNode : new osg::Group;
        const osg::ref_ptr<osg::Group> tile = makePaged(makeMeshTile(kExtents, 200.0), paged, 1e9f);
        root->addChild(tile);
        ASSERT_TRUE(osgDB::writeNodeFile(*root, _folder / file));
    }

    static void look(osg::Node& scene) {
        const osg::ref_ptr<osgUtil::UpdateVisitor> update = new osgUtil::UpdateVisitor;
        scene.accept(*update);
        const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
        (void)cull(scene, CullView::lookAt(ecefDeg(11, 21, 1e5), ecefDeg(11, 21, 0), {0, 0, 1}, 60.0), *visitor);
    }

    // Loads what the first PagedLOD below names, as the pager does, so many times down. Returns: tiles with bins.
    static int followDown(osg::Node& scene, int levels) {
        int installed = 0;
        osg::ref_ptr<osg::Node> node = &scene;
        for (int i = 0; i < levels; ++i) {
            auto* paged = dynamic_cast<osg::PagedLOD*>(node->asGroup()->getChild(0));
            if (!paged) return installed;
            installed += installedOn(*paged) ? 1 : 0;
            node = readBelow(*paged);
            if (!node) return installed;
            putBelow(*paged, node);
            look(scene);
        }
        return installed;
    }

    // Reads the root file, and goes down from it: one tile with bins and one file read for each level.
    void expectFollowedAsFarAsThePagerGoes() {
        constexpr int kLevels = 6;
        const osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(_folder / "root.osgb");
        ASSERT_TRUE(scene);
        ASSERT_EQ(installBins(*scene), 1u);
        const int before = _reads->total();
        EXPECT_EQ(followDown(*scene, kLevels), kLevels);
        EXPECT_EQ(_reads->total() - before, kLevels);
    }

    static inline const core::GeodeticBin kExtents = extentsDeg(10, 12, 20, 22);
    const TemporaryFolder _folder;
    osg::ref_ptr<CountedReads> _reads = new CountedReads;
    const CapturedNotes _notes;
};

TEST_F(HostileNames, AreNotReadUntilThePagerAsks) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    for (const char* name : {"../../outside.osgb", "/etc/passwd", "//etc/passwd", "http://host.invalid/tile.osgb",
                             "ftp://host.invalid/tile.osgb", "tile.osgb.analyticbin", "tile.osgb.90,0,0.rot", "..", ".",
                             "a\\..\\..\\outside.osgb", "%s%n.osgb"}) {
        root->addChild(makePaged(makeMeshTile(kExtents, 200.0), name, 1e9f));
    }
    for (const Method method : {Method::Quadratic, Method::None, Method::Exact}) {
        CullOptions options;
        options.method = method;
        (void)installBins(*root, options, _folder / "root.osgb");
        look(*root);
    }
    // the index beside the database is looked for, where its reader is there
    for (const auto& [name, count] : _reads->counts()) EXPECT_EQ(name, _folder / "root.osgb.bins");
    EXPECT_EQ(_notes.count(""), 0u);
}

TEST_F(HostileNames, OfFilesThatNameThemselvesOrEachOtherAreFollowedAsFarAsThePagerGoes) {
    for (const auto& [root, tile] :
         {std::pair("root.osgb", "tile.osgb"), {"tile.osgb", "tile.osgb"}, {"tile.osgb", "other.osgb"}}) {
        write("root.osgb", root, true);
        write("tile.osgb", tile, false);
        write("other.osgb", "tile.osgb", false);
        expectFollowedAsFarAsThePagerGoes();
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
