// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// poses.csv: what is written is read back; broken files are named.

#include "PoseTable.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::flight {
namespace {

using test::TemporaryFolder;

PoseRecord record() {
    PoseRecord pose;
    pose.name = "fov10_1";
    pose.tiles = {11, 10, 9, 8, 7, 0, 6, 5, 4, 3};
    pose.files = 2;
    pose.cullMs = 0.1;
    pose.frameMs = 2.5;
    pose.picture = "fov10_1.png";
    return pose;
}

TEST(PoseTable, ReadsBackWhatItWrote) {
    const TemporaryFolder folder;
    std::string error;
    ASSERT_TRUE(writePoseTable(folder.path(), {record(), record()}, "a remark", error)) << error;
    const auto read = readPoseTable(folder.path(), error);
    ASSERT_TRUE(read.has_value()) << error;
    ASSERT_EQ(read->size(), 2u);
    const PoseRecord& pose = read->back();
    EXPECT_EQ(pose.name, "fov10_1");
    EXPECT_EQ(pose.tiles.tested, 11u);
    EXPECT_EQ(pose.tiles.kept, 10u);
    EXPECT_EQ(pose.tiles.drawn, 9u);
    EXPECT_EQ(pose.tiles.drawables, 8u);
    EXPECT_EQ(pose.tiles.triangles, 7u);
    EXPECT_EQ(pose.tiles.binsTested, 6u);
    EXPECT_EQ(pose.tiles.binsOutside, 5u);
    EXPECT_EQ(pose.tiles.binsInside, 4u);
    EXPECT_EQ(pose.tiles.binsStraddling, 3u);
    EXPECT_EQ(pose.files, 2u);
    EXPECT_EQ(pose.cullMs, 0.1);
    EXPECT_EQ(pose.frameMs, 2.5);
    EXPECT_EQ(pose.picture, "fov10_1.png");
}

TEST(PoseTable, LeavesNoTemporaryFile) {
    const TemporaryFolder folder;
    std::string error;
    ASSERT_TRUE(writePoseTable(folder.path(), {record()}, "", error)) << error;
    const std::filesystem::directory_iterator files(folder.path());
    EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(PoseTable, NamesAMissingFolderOrFile) {
    const TemporaryFolder folder;
    std::string error;
    EXPECT_FALSE(writePoseTable(folder / "missing", {record()}, "", error));
    EXPECT_NE(error.find("missing"), std::string::npos);
    EXPECT_FALSE(readPoseTable(folder.path(), error).has_value());
    EXPECT_NE(error.find("poses.csv"), std::string::npos);
}

TEST(PoseTable, NamesTheLineOfABrokenCell) {
    const TemporaryFolder folder;
    std::string error;
    ASSERT_TRUE(writePoseTable(folder.path(), {record()}, "", error)) << error;
    const std::string good = test::textOfFile(folder / "poses.csv");
    for (const char* const bad : {"x", "-1", "1.5"}) {
        std::string text = good;
        text.replace(text.find(",11,") + 1, 2, bad);
        EXPECT_EQ(folder.write("poses.csv", text), folder / "poses.csv");
        EXPECT_FALSE(readPoseTable(folder.path(), error).has_value()) << bad;
        EXPECT_NE(error.find("poses.csv:3: tilesTested"), std::string::npos) << error;
    }
}

}  // namespace
}  // namespace osgAnalyticBin::flight
