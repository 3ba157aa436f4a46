// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Settings.h"

#include "Bench.h"
#include "CommandLine.h"
#include "CullMethod.h"
#include "Failure.h"
#include "TextFile.h"
#include "ThreadingName.h"

#include <osgAnalyticBin/CullOptions.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <unistd.h>

namespace osgAnalyticBin::bench {

using support::UsageError;

namespace {

constexpr int kLargestPicture = 8192;

void takeSize(const std::string& text, Settings& settings) {
    int width = 0;
    int height = 0;
    char rest = 0;
    const bool read = std::sscanf(text.c_str(), "%5dx%5d%c", &width, &height, &rest) == 2;
    if (!read || width < 1 || height < 1 || width > kLargestPicture || height > kLargestPicture)
        throw UsageError("--size: \"" + text + "\" is no size; give pixels from 1 to " +
                         std::to_string(kLargestPicture) + ", for example 1280x720");
    settings.width = width;
    settings.height = height;
}

// In virtual machines sysconf() counts the caches of processors that this machine does not have; the kernel knows.
long lastLevelKibibytes() {
    long kibibytes = 0;
    for (int level = 0; level < 8; ++level) {
        std::ifstream file("/sys/devices/system/cpu/cpu0/cache/index" + std::to_string(level) + "/size");
        long size = 0;
        if (file >> size) kibibytes = std::max(kibibytes, size);
    }
    return kibibytes > 0 ? kibibytes : sysconf(_SC_LEVEL3_CACHE_SIZE) / 1024;
}

std::string footer() {
    using report::linesOf;
    constexpr std::size_t kWidth = 23;
    const std::string text =
        "Without --path: flies around the database (overview, oblique, low, turning), says in three sentences whether\n"
        "bins are worth it, and writes report.html. Ctrl-C ends with what was measured until then.\n\n"
        "Two commands, each with a --help of its own:\n"
        "  osgbinbench report   compares flights that binflight left\n"
        "  osgbinbench scale    measures how culling scales with depth and with tiles in memory\n\n"
        "At every pose every method starts from the root file alone and loads what it wants; then it is measured.\n"
        "Methods: none = no culling, always flown, as all others are judged by it; sphere = OSG's spheres and boxes,\n"
        "the database's ClusterCullingCallbacks taken away; cluster = OSG with these callbacks: the database's own, "
        "else\n"
        "such as VirtualPlanetBuilder makes, from every tile's mesh; box, orientedbox = boxes about the bins, along\n"
        "the axes of ECEF or east, north, up; corners, paper = rules that cull visible tiles, for comparison;\n"
        "quadratic, exact = analytic bins. The last six cull by the frustum's planes alone; +horizon adds the horizon\n"
        "(boxes: of one point), +edges tiles beyond an edge of the frustum (boxes: a frustum beyond a face), in "
        "this\n"
        "order; +occlusion behind them adds tiles behind terrain, looked for in every view (occlusion=on).\n"
        "bins = analytic bins with the kit's default options, as users have them: quadratic, with horizon, edges and\n"
        "terrain that hides terrain while that pays (occlusion=auto); --options changes them.\n"
        "oracle = what exact+horizon+edges keeps, recorded at each pose and repeated without any test: what culling\n"
        "would cost if tests were free (not in flight). all = these methods, in the combinations worth comparing.\n"
        "With --frames the path is flown continuously, every method once, while files are being loaded; with --jumps "
        "the\n"
        "camera stands still at each pose instead. Methods take turns of 50 frames each; these are culled, and not\n"
        "drawn. What leaves the view is kept in memory as long with all methods, unless --expiry says otherwise.\n\n"
        "Columns of --csv, one line for each pose and method, and keys of --json, sums over the poses:\n";
    return text + linesOf(kPoseColumns, kWidth) + "\nThe same with --frames and --jumps:\n" +
           linesOf(kFlightColumns, kWidth) + "\nThe same with --draw, over three flights of each method but none:\n" +
           linesOf(kDrawnColumns, kWidth) +
           "\n"
           "\"paths\" in --json holds the sums of the poses whose names share the text before the first _.\n\n"
           "Needs a display. Exit code: 0; 1 when something failed: one line says what, and no table is written; 2 "
           "when\n"
           "the command line is wrong.\n\n"
           "Examples:\n"
           "  xvfb-run -a osgbinbench earth.osgb\n"
           "  xvfb-run -a osgbinbench earth.osgb --path data/paths/vpb_sample.csv --csv poses.csv --json sums.json";
}

struct Words {
    std::string size = "1280x720";
    std::optional<double> expiry;
};

void declare(CLI::App& app, Settings& settings, Words& words) {
    app.add_option("DATABASE", settings.database, "root file of a paged globe or map that OSG reads")->required();
    app.add_option(
           "--path", settings.paths,
           "camera path, CSV: degrees and metres, as data/paths/demo.csv; over\na map eyeX, eyeY, lookX, lookY "
           "in place of degrees; or *.path, as key z\nof OpenSceneGraph's viewers records it; may be given several "
           "times\n(default: around the database)")
        ->allow_extra_args(false);
    support::addList(app, "--methods", settings.methods,
                     "comma-separated, see below, or all (default:\nsphere,cluster,bins)");
    app.add_option("--options", settings.binOptions,
                   "more options for the bins, comma-separated, such as heights=0..4000\n"
                   "or horizon=-500 (metres; for the methods with +horizon); what the\nname of a method says stays");
    app.add_option("--csv", settings.csv, "file for the figures of every pose");
    app.add_option("--json", settings.json, "file for the sums");
    app.add_option("--pictures", settings.pictures, "folder for pictures, METHOD/POSE.png");
    app.add_option("--report", settings.report,
                   "file for a page with the answer, tables, diagrams and pictures\n"
                   "(HTML; default without --path: report.html)");
    app.add_option("--plot", settings.plot,
                   "folder for diagrams, SVG and PNG, drawn by gnuplot, with their\nscripts and data");
    app.add_option("--vertical-scale", settings.verticalScale,
                   "factor for the heights of an osgTerrain database (default 1)")
        ->check(support::within(0.001, 1000.0));
    app.add_option("--size", words.size, "pixels of a picture, WIDTHxHEIGHT (default 1280x720)");
    std::map<std::string, osgViewer::ViewerBase::ThreadingModel> models;
    for (const auto& [model, name] : flight::kThreadingNames) models[name] = model;
    app.add_option("--threading", settings.threading,
                   "SingleThreaded (default), CullDrawThreadPerContext,\nDrawThreadPerContext or "
                   "CullThreadPerCameraDrawThreadPerContext")
        ->transform(CLI::CheckedTransformer(models).description(""));
    app.add_option(
           "--repeats", settings.repeats,
           "rounds of timed cull traversals, three as they come each and\nevery fourth time one with cold caches "
           "(default 40)")
        ->check(CLI::Range(1, 10000));
    app.add_option(
           "--flush", settings.flush,
           "MiB that are touched before each cull with cold caches\n(default twice the last-level cache, 64 at least; "
           "0: no such culls)")
        ->check(CLI::Range(0, 65536));
    app.add_option("--frames", settings.frames, "only fly continuously, that many frames in all")
        ->check(CLI::Range(1, 1000000));
    app.add_flag(
        "--draw", settings.draw,
        "draws the frames of --frames in a viewer, each once all of it\nis loaded, and times them instead of counting");
    app.add_flag("--jumps", settings.jumps,
                 "only jump from pose to pose with paging live, and stand at\neach until nothing is missing");
    app.add_option("--speed", settings.speed,
                   "metres a second: flies straight ahead from each pose, once it is\n"
                   "loaded, for its share of --frames (default: from pose to pose)")
        ->check(support::within(0.01, 1e6));
    app.add_option("--frame-rate", settings.frameRate,
                   "frames a second of flights and jumps at most, so that\nthe pager has time (default 60)")
        ->check(support::within(0.1, 10000.0));
    app.add_option(
           "--expiry", words.expiry,
           "seconds for which the pager keeps what methods without bins\nno longer show, to 86400, or osg: its own "
           "rule; for flights\n(default as bins: 3, or expiry= of --options)")
        ->transform(CLI::Transformer({{"osg", "0"}}).description(""))
        ->check(support::within(0.0, 86400.0));
    app.add_option("--timeout", settings.timeout, "seconds that one pose may take to load (default 120)")
        ->check(support::within(0.001, 86400.0));
}

void check(const Settings& settings) {
    if (std::filesystem::path(settings.database).extension().empty() && !std::filesystem::exists(settings.database))
        throw UsageError("there is no database and no command \"" + settings.database +
                         "\"; the commands are report and scale, and databases have names like earth.osgb");
    (void)cullMethodsFromNames(settings.methods);
    std::string error;
    if (settings.binOptions.find("method=") != std::string::npos)
        throw UsageError("--options: name methods in --methods instead of \"" + settings.binOptions + "\"");
    if (!cullOptionsFromText(settings.binOptions, error)) throw UsageError("--options: " + error);
    if (settings.frames > 0 && settings.jumps) throw UsageError("--jumps: leave --frames out");
    if (settings.draw && settings.frames == 0) throw UsageError("--draw: give --frames, how many are to be drawn");
    if (settings.speed > 0.0 && settings.frames == 0) throw UsageError("--speed: give --frames, how many are flown");
    const bool isLive = settings.frames > 0 || settings.jumps;
    if (isLive && !settings.pictures.empty())
        throw UsageError("--pictures: with paging live none are taken; leave --frames and --jumps out");
    if (isLive && !settings.plot.empty())
        throw UsageError("--plot: with paging live there is nothing to show; leave --frames and --jumps out");
    support::requireFolderOf("--csv", settings.csv);
    support::requireFolderOf("--json", settings.json);
    support::requireFolderOf("--pictures", settings.pictures);
    support::requireFolderOf("--plot", settings.plot);
    if (isLive && !settings.report.empty())
        throw UsageError("--report: with paging live there are no poses to show; leave --frames and --jumps out");
    support::requireFolderOf("--report", settings.report);
}

}  // namespace

int defaultFlush() {
    constexpr int kLeast = 64;
    return std::max(kLeast, static_cast<int>(2 * lastLevelKibibytes() / 1024));
}

bool settingsFromCommandLine(int argc, char** argv, Settings& settings) {
    CLI::App app{"Measures the culling of a paged globe or map, method by method, along a camera path.", "osgbinbench"};
    app.footer(footer());
    Words words;
    declare(app, settings, words);
    if (!support::parseCommandLine(app, argc, argv)) return false;
    takeSize(words.size, settings);
    check(settings);
    const bool isAtPoses = settings.frames == 0 && !settings.jumps;
    if (settings.paths.empty() && isAtPoses && settings.report.empty()) settings.report = "report.html";
    std::string error;
    settings.expiry = words.expiry.value_or(cullOptionsFromText(settings.binOptions, error)->expiry);
    return true;
}

}  // namespace osgAnalyticBin::bench
