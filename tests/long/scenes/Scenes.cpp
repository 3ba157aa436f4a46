// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Scenes of files and random ones, culled with bins and without: what is seen without bins is drawn with them, and bins
// that are taken off leave nothing behind. tests/README.md tells how to run it.

#include "RandomScene.h"
#include "Run.h"
#include "SceneText.h"

#include <osgDB/ObjectWrapper>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <unistd.h>

using namespace osgAnalyticBin::test;

namespace {

// Without a display there are no pictures.
constexpr int kSkipped = 77;

struct Arguments {
    unsigned int scenes = 500;
    unsigned int seed = 1;
    unsigned int mostFailures = 10;
    bool describes = false;
    bool shrinks = true;
    bool hasPictures = false;
    bool hasBins = true;
    std::vector<std::string> files;
    bool isValid = true;
};

constexpr const char* kUsage =
    "osganalyticbin_scenes [--scenes N] [--seed S] [--only SEED] [--describe] [--failures N] [--no-shrink]\n"
    "                      [--pictures] [--no-bins] [FILE.scene or FOLDER]...\n"
    "  FILE, FOLDER  runs the scenes of these files, in place of random ones\n"
    "  --scenes N    runs N scenes (default 500), with seeds S, S + 1, ...\n"
    "  --seed S      the first seed (default 1)\n"
    "  --only SEED   runs one scene\n"
    "  --describe    prints the scenes as files have them\n"
    "  --failures N  ends after N failures (default 10)\n"
    "  --no-bins     compares scenes without bins with themselves: what fails is a fault of this program\n"
    "  --no-shrink   prints scenes that fail as they are\n"
    "  --pictures    compares pictures, in place of what is delivered; needs a display\n"
    "Exit code: 0 when no scene fails, 1 when one does, 2 for wrong arguments, 77 without a display.\n";

Arguments parse(int count, char** values) {
    Arguments result;
    osg::ArgumentParser parser(&count, values);
    (void)parser.read("--scenes", result.scenes);
    (void)parser.read("--seed", result.seed);
    (void)parser.read("--failures", result.mostFailures);
    if (parser.read("--only", result.seed)) result.scenes = 1;
    result.hasBins = !parser.read("--no-bins");
    result.describes = parser.read("--describe");
    result.shrinks = !parser.read("--no-shrink");
    result.hasPictures = parser.read("--pictures");
    parser.reportRemainingOptionsAsUnrecognized();
    result.isValid = !parser.errors();
    for (int i = 1; i < parser.argc(); ++i) result.files.emplace_back(parser[i]);
    return result;
}

// What a crash prints.
char presentScene[64] = "";

void onCrash(int signal) {
    const char* const name = signal == SIGABRT ? "aborted in scene " : "crashed in scene ";
    (void)!write(STDERR_FILENO, name, std::strlen(name));
    (void)!write(STDERR_FILENO, presentScene, std::strlen(presentScene));
    std::signal(signal, SIG_DFL);
    (void)std::raise(signal);
}

void report(const Description& description, const Failure& failure, bool shrinks, Painter* painter) {
    const char* const program = painter ? "osganalyticbin_scenes --pictures" : "osganalyticbin_scenes";
    std::printf("seed %llu FAILS in frame %d: %s: %s\n", static_cast<unsigned long long>(description.seed),
                failure.frame, failure.signature.c_str(), failure.text.c_str());
    std::fflush(stdout);
    const Shrunk shrunk = shrinks ? shrink(description, failure, painter) : Shrunk{description, failure};
    std::printf("%s", toText(shrunk.description).c_str());
    if (shrinks) std::printf("  shrunk, it fails in frame %d: %s\n", shrunk.failure.frame, shrunk.failure.text.c_str());
    std::printf("  again: %s --only %llu\n\n", program, static_cast<unsigned long long>(description.seed));
    std::fflush(stdout);
}

// The files themselves, and those that are in folders.
std::vector<std::string> sceneFiles(const std::vector<std::string>& paths) {
    namespace fs = std::filesystem;
    std::vector<std::string> files;
    for (const std::string& path : paths) {
        if (!fs::is_directory(path)) {
            files.push_back(path);
            continue;
        }
        for (const fs::directory_entry& entry : fs::directory_iterator(path))
            if (entry.path().extension() == ".scene") files.push_back(entry.path().string());
    }
    std::sort(files.begin(), files.end());
    return files;
}

// Returns: what is wrong, else nothing. `painter` null: pictures are not compared.
std::string wrongWith(const NamedScene& scene, bool describes, Painter* painter) {
    RunTotals totals;
    const auto failure = run(painter ? picturable(scene.description) : scene.description, totals, painter);
    const int spheres = static_cast<int>(totals.delivered), bins = static_cast<int>(totals.drawn);
    const std::string found = toText(Expectation{spheres, bins});
    if (describes) std::printf("%s%s\n", toText(scene.description).c_str(), found.c_str());
    if (failure) return "frame " + std::to_string(failure->frame) + ": " + failure->signature + ": " + failure->text;
    // scenes are changed a little for pictures, so the counts may differ
    if (painter || (scene.expected && scene.expected->holdsFor(spheres, bins))) return {};
    return "it delivers: " + found;
}

// All scenes of a file.
std::string wrongWith(const std::string& file, bool describes, Painter* painter) {
    std::ifstream in(file);
    if (!in) return "there is no such file";
    std::string first;
    for (const NamedScene& scene : readScenes(in)) {
        const std::string wrong = wrongWith(scene, describes, painter);
        if (!wrong.empty() && first.empty()) first = wrong + '\n' + toText(scene.description);
        if (!first.empty() && !describes) break;
    }
    return first;
}

int runFiles(const Arguments& arguments, Painter* painter) {
    const std::vector<std::string> files = sceneFiles(arguments.files);
    std::uint64_t failures = 0;
    for (const std::string& file : files) {
        if (failures == arguments.mostFailures) break;
        std::snprintf(presentScene, sizeof presentScene, "%s\n", std::filesystem::path(file).stem().c_str());
        std::string wrong;
        try {
            wrong = wrongWith(file, arguments.describes, painter);
        } catch (const std::runtime_error& error) {
            wrong = error.what();
        }
        if (wrong.empty()) continue;
        std::printf("%s FAILS in %s\n", file.c_str(), wrong.c_str());
        ++failures;
    }
    std::printf("%zu named scenes, %llu failures\n", files.size(), static_cast<unsigned long long>(failures));
    return failures == 0 && !files.empty() ? 0 : 1;
}

// Drawables are drawn in the order of the traversal: where surfaces coincide, the same one wins with bins and without.
std::unique_ptr<Painter> makePainter() {
    osgUtil::RenderBin::setDefaultRenderBinSortMode(osgUtil::RenderBin::TRAVERSAL_ORDER);
    try {
        return std::make_unique<Painter>();
    } catch (const std::runtime_error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return nullptr;
    }
}

}  // namespace

int main(int argc, char** argv) {
    const Arguments arguments = parse(argc, argv);
    if (!arguments.isValid) {
        std::fputs(kUsage, stderr);
        return 2;
    }
    for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) std::signal(signal, onCrash);
    osg::setNotifyLevel(osg::ALWAYS);
    // bins are saved and loaded, too
    osgDB::Registry::instance()->getLibraryFilePathList().push_front(LIBRARY_FOLDER);
    if (!osgDB::Registry::instance()->getObjectWrapperManager()->findWrapper(
            "osgAnalyticBin::AnalyticBinCullCallback")) {
        std::fputs("the serializers of osgAnalyticBin are not in " LIBRARY_FOLDER "\n", stderr);
        return 2;
    }
    const std::unique_ptr<Painter> painter = arguments.hasPictures ? makePainter() : nullptr;
    if (arguments.hasPictures && !painter) return kSkipped;
    if (!arguments.files.empty()) return runFiles(arguments, painter.get());
    const auto start = std::chrono::steady_clock::now();
    RunTotals totals;
    std::uint64_t failures = 0;
    std::uint64_t scenes = 0;
    for (; scenes < arguments.scenes && failures < arguments.mostFailures; ++scenes) {
        const std::uint64_t seed = std::uint64_t{arguments.seed} + scenes;
        std::snprintf(presentScene, sizeof presentScene, "%llu\n", static_cast<unsigned long long>(seed));
        Description description = randomDescription(seed);
        description.hasBins = arguments.hasBins;
        if (painter) description = picturable(std::move(description));
        if (arguments.describes) std::printf("%s", toText(description).c_str());
        const auto failure = run(description, totals, painter.get());
        if (!failure) continue;
        ++failures;
        report(description, *failure, arguments.shrinks, painter.get());
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::printf(
        "%llu scenes in %.1f s, %llu failures; %zu drawables delivered without bins, %zu of them not with "
        "bins; bins taken off and compared %zu times\n",
        static_cast<unsigned long long>(scenes), seconds.count(), static_cast<unsigned long long>(failures),
        totals.delivered, totals.lost, totals.undone);
    if (painter)
        std::printf("%zu pairs of pictures with something in %zu pixels, of which %zu differ as they may\n",
                    totals.pictures.pictures, totals.pictures.covered, totals.pictures.allowed);
    return failures == 0 ? 0 : 1;
}
