// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// `osgbinbench report` over made-up flights: the parts here, the program's exit codes at the end.

#include "Output.h"
#include "Report.h"

#include <osg/Image>
#include <osgDB/WriteFile>

#include <support/Programs.h>
#include <support/TemporaryFolder.h>
#include <sys/wait.h>

namespace osgAnalyticBin::bench {
namespace {

using test::TemporaryFolder;

constexpr int kWidth = 8;
constexpr int kHeight = 4;

osg::ref_ptr<osg::Image> greyPicture() {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(kWidth, kHeight, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
    std::fill_n(image->data(), image->getTotalSizeInBytes(), static_cast<unsigned char>(90));
    return image;
}

// A flight of two poses that drew `drawn` tiles at each; its second picture is the one given.
std::string makeRun(const TemporaryFolder& folder, const std::string& name, std::uint64_t drawn,
                    const osg::Image& second) {
    const std::string run = folder.makeFolder(name);
    const std::string tiles = ',' + std::to_string(drawn);
    std::string table =
        "# a remark\nname,tested_tiles,kept_tiles,drawn_tiles,drawables,triangles,files_requested,cull_ms,frame_ms,"
        "picture\n";
    for (const std::string pose : {"far_1", "far_2"}) {
        table += pose + tiles + tiles + tiles + ",0,0,0,1.5,0," + pose + ".png\n";
        EXPECT_TRUE(osgDB::writeImageFile(pose == "far_1" ? *greyPicture() : second, run + "/" + pose + ".png"));
    }
    (void)folder.write(name + "/poses.csv", table);
    return run;
}

osg::ref_ptr<osg::Image> pictureWithOneOtherPixel() {
    osg::ref_ptr<osg::Image> image = greyPicture();
    ++image->data(3, 2)[1];
    return image;
}

int exitCodeOf(const std::string& arguments) {
    const int status = std::system(("'" BENCH_FILE "' report " + arguments + " >/dev/null 2>&1").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Report, NamesThePoseThatDiffersAndPrintsSumsAndRatios) {
    const TemporaryFolder folder;
    const Measurement flown =
        readFlights({makeRun(folder, "none", 10, *greyPicture()), makeRun(folder, "sphere", 4, *greyPicture()),
                     makeRun(folder, "quadratic", 1, *pictureWithOneOtherPixel()),
                     makeRun(folder, "paper", 4, *pictureWithOneOtherPixel())});
    // the published rule is known to be unsound
    EXPECT_EQ(mismatchesOf(flown), std::vector<std::string>{"method quadratic draws another picture than the reference "
                                                            "at pose far_2: 1 pixels differ"});
    EXPECT_EQ(flown.methods[3].rows[1]["differing_pixels"], 1);
    const auto sums = sumOf(flown.methods[2], allOf(flown.methods[2]));
    EXPECT_EQ(sums["drawn_tiles"], 2);
    EXPECT_EQ(sums["cull_ms"], 3.0);
    std::ostringstream text;
    print(text, tablesOf(flown));
    for (const char* part : {"sums over poses", "ratio to sphere", "kept_tiles        2.500   1.000      0.250  1.000"})
        EXPECT_NE(text.str().find(part), std::string::npos) << text.str();
}

TEST(Report, NamesWhatIsMissingOrBroken) {
    const TemporaryFolder folder;
    const std::string none = makeRun(folder, "none", 1, *greyPicture());
    const std::string sphere = makeRun(folder, "sphere", 1, *greyPicture());
    const auto expectError = [&](const std::string& run, const std::string& what) {
        const std::string error = test::failureOf([&] { (void)readFlights({none, run}); });
        EXPECT_NE(error.find(what), std::string::npos) << error;
    };
    expectError(folder / "gone", "gone/poses.csv");
    const std::string good = test::textOfFile(sphere + "/poses.csv");
    for (const char* const bad : {"x", "-1"}) {
        std::string text = good;
        text.replace(text.find(",1,") + 1, 1, bad);
        (void)folder.write("sphere/poses.csv", text);
        expectError(sphere, "poses.csv:3: tested_tiles");
    }
    (void)folder.write("sphere/poses.csv", good.substr(0, good.find("far_2")));
    expectError(sphere, "its poses are not those");
    (void)folder.write("sphere/poses.csv", "name,tested_tiles,picture\nfar_1,1,far_1.png\nfar_2,1,far_2.png\n");
    expectError(sphere, "its columns are not those");
    (void)folder.write("sphere/poses.csv", good);
    const std::string picture = sphere + "/far_2.png";
    const osg::ref_ptr<osg::Image> wider = greyPicture();
    wider->scaleImage(kWidth + 1, kHeight, 1);
    ASSERT_TRUE(osgDB::writeImageFile(*wider, picture));
    expectError(sphere, "8x4 and 9x4");
    std::filesystem::remove(picture);
    expectError(sphere, "sphere/far_2.png");
}

TEST(ReportProgram, SaysByItsExitCodeWhatItFound) {
    const TemporaryFolder folder;
    const std::string none = makeRun(folder, "none", 1, *greyPicture());
    const std::string same = makeRun(folder, "sphere", 1, *greyPicture());
    const std::string other = makeRun(folder, "quadratic", 1, *pictureWithOneOtherPixel());
    EXPECT_EQ(exitCodeOf(none + " " + same), 0);
    EXPECT_EQ(exitCodeOf(none + " " + same + " " + other), 1);
    EXPECT_EQ(exitCodeOf(none + " " + (folder / "gone")), 1);
    EXPECT_EQ(exitCodeOf(""), 2);
}

}  // namespace
}  // namespace osgAnalyticBin::bench
