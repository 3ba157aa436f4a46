// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Makes random terrain with needles and pits, and asks the horizon buffer what is behind it for an eye above, or for
// all eyes in a box. Casts rays in long double to all that is said to be hidden, and fails if a single ray gets there
// without meeting a triangle.

#include "LongRun.h"
#include "OcclusionScene.h"

#include <cinttypes>

namespace osgAnalyticBin::test {
namespace {

struct Counts {
    std::atomic<std::uint64_t> trials{0}, wrong{0}, scenes{0}, quarters{0}, hidden{0};
};

// Rays to one part of a tile, and from one of its eyes.
constexpr int kRays = 200, kRaysOfEye = 20;

void tryScene(std::uint64_t number, const LongRun& run, Counts& counts) {
    Random random(1700 + number, run.seedValue);
    const OcclusionScene scene(random, true, number % 4 == 3);
    const glm::dvec3 eyes = run.hasFlag ? randomEyes(random, scene) : glm::dvec3(0.0);
    core::HorizonBuffer buffer = bufferOf(scene, eyes);
    const std::size_t cells = random.pick(std::array<std::size_t, 4>{1, 2, 4, 8});
    for (const GroundTile& tile : scene.tiles) addTile(buffer, scene, tile, cells);
    OcclusionScene seen = scene;  // from one of the eyes
    bool isAboveGround = true;
    for (const auto& [part, outline] : frontToBack(scene, buffer)) {
        ++counts.quarters;
        if (outline.isBeside || !buffer.hides(outline)) continue;
        ++counts.hidden;
        for (int ray = 0; ray < kRays; ++ray) {
            const bool isNewEye = run.hasFlag && ray % kRaysOfEye == 0;
            if (isNewEye) isAboveGround = moveEye(seen, random, frameOf(scene), eyes);
            // what an eye of a box sees and the one in the middle does not is at the top
            const bool isTop = run.hasFlag && random.chance(0.7);
            const RealVector point = isTop ? seen.topOf(random, part) : seen.pointIn(random, part);
            if (!isAboveGround || !isBeforeTheCamera(seen, point)) continue;
            ++counts.trials;
            if (seen.isBlocked(point)) continue;
            ++counts.wrong;
            std::printf("scene %" PRIu64 ": a ray reaches a quarter of a tile that is said to be hidden\n", number);
        }
    }
    ++counts.scenes;
}

int run(int argc, char** argv) {
    const auto run = longRunOf(argc, argv, "--boxes");
    if (!run) return 2;
    const Stopwatch watch;
    Counts counts;
    std::atomic<std::uint64_t> next{0};
    const auto work = [&] {
        while (counts.trials < run->trials) tryScene(next++, *run, counts);
    };
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < run->threads; ++i) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
    std::printf("%" PRIu64 " rays to %" PRIu64 " hidden quarters of %" PRIu64 ", in %" PRIu64
                " scenes and %.0f s: %" PRIu64 " wrong\n",
                counts.trials.load(), counts.hidden.load(), counts.quarters.load(), counts.scenes.load(),
                watch.seconds(), counts.wrong.load());
    return counts.wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace osgAnalyticBin::test

int main(int argc, char** argv) {
    return osgAnalyticBin::test::run(argc, argv);
}
