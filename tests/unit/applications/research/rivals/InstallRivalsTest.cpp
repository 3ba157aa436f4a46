// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Databases that are culled by the rules of the paper and of other programs: that all tiles have them.
// The rules themselves: RivalBinsTest.cpp; what they draw: osgbinbench.Program.JudgesEveryMethodByTheReference.

#include "PagedFlight.h"
#include "Rivals.h"

#include <osgDB/ReadFile>

#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

TEST(Rivals, CullsAlsoWhatIsPagedIn) {
    const test::TemporaryFolder folder;
    const std::string file = test::writeSyntheticDatabase(folder.path());
    const osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(file + ".(occlusion=off).analyticbin");
    ASSERT_TRUE(scene);
    EXPECT_EQ(rivals::installRivals(*scene, {rivals::Rule::Corners}), 32U);
    test::PagedFlight flight(*scene);
    ASSERT_TRUE(flight.load(test::lookDown(1.0)));
    EXPECT_GT(test::tilesWith<rivals::RivalCullCallback>(*scene), 40U) << "32 are in the root file";
}

}  // namespace
}  // namespace osgAnalyticBin
