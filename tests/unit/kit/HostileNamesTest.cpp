// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Files that name what is none of the database's business: the kit reads nothing that the pager does not ask for.

#include "CountedReads.h"
#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

TEST(HostileNames, AreNotReadUntilThePagerAsks) {
    const TemporaryFolder folder;
    const CapturedNotes notes;
    const osg::ref_ptr<CountedReads> reads = new CountedReads;
    osgDB::Registry::instance()->setReadFileCallback(reads);
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    for (const char* name : {"../../outside.osgb", "/etc/passwd", "//etc/passwd", "http://host.invalid/tile.osgb",
                             "ftp://host.invalid/tile.osgb", "tile.osgb.analyticbin", "tile.osgb.90,0,0.rot", "..", ".",
                             "a\\..\\..\\outside.osgb", "%s%n.osgb"}) {
        root->addChild(makePaged(makeMeshTile(extentsDeg(10, 12, 20, 22), 200.0), name, 1e9f));
    }
    for (const Method method : {Method::Quadratic, Method::None, Method::Exact}) {
        CullOptions options;
        options.method = method;
        (void)installBins(*root, options, folder / "root.osgb");
        update(*root);
        const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
        (void)cull(*root, downTo(11.0, 21.0, 1e5, 60.0), *visitor);
    }
    osgDB::Registry::instance()->setReadFileCallback(nullptr);
    // the index beside the database is looked for, where its reader is there
    for (const auto& [name, count] : reads->counts()) EXPECT_EQ(name, folder / "root.osgb.bins");
    EXPECT_EQ(notes.count(""), 0u);
}

}  // namespace
}  // namespace osgAnalyticBin::test
