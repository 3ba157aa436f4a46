// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullTimer.h"

#include "Failure.h"
#include "Quantiles.h"

#include <osgDB/DatabasePager>

#include <optional>
#include <utility>

namespace osgAnalyticBin::bench {

namespace {

constexpr int kUntimedPerTurn = 2;
constexpr int kTimedPerTurn = 3;
// A visitor serves so many turns, in which it learns from view to view, for example that bins save nothing. Then a new
// one takes its place, because cull times differ by some percent with the place of the visitor in memory.
constexpr int kTurnsOfVisitor = 8;
// Touching more than a large cache holds takes longer than hundreds of traversals.
constexpr int kRoundsForOneCold = 4;
constexpr std::size_t kMebibyte = 1024 * 1024;

// Reads and writes every cache line of some memory, which replaces what the processor's data caches hold. No processor
// that runs this has shorter lines.
void touchEveryLine(std::vector<unsigned char>& memory) {
    constexpr std::size_t kCacheLine = 64;
    for (std::size_t i = 0; i < memory.size(); i += kCacheLine) ++memory[i];
}

CullTime timeOf(std::vector<double> times) {
    const support::Quantiles quantiles(std::move(times));
    return {quantiles.at(1, 4), quantiles.at(2, 4), quantiles.at(3, 4) - quantiles.at(1, 4)};
}

/// The traversals of one scene, as those of a viewer that stands still.
class Turns {
public:
    explicit Turns(MethodScene& scene) : _scene(scene), _frameStamp(new osg::FrameStamp(scene.frameStamp())) {
        // A file asked for here would be read behind the benchmark's back.
        _pager->setAcceptNewDatabaseRequests(false);
    }

    // `memory`: empty where this turn does not time cold caches.
    void take(std::vector<unsigned char>& memory) {
        if (_turns++ % kTurnsOfVisitor == 0) _stage.emplace(*_pager);
        for (int i = 0; i < kUntimedPerTurn; ++i) (void)nextMs();
        for (int i = 0; i < kTimedPerTurn; ++i) _warm.push_back(nextMs());
        if (memory.empty()) return;
        touchEveryLine(memory);
        _cold.push_back(nextMs());
    }

    [[nodiscard]] CullTimes result() const { return {timeOf(_warm), timeOf(_cold)}; }

private:
    // Frames are numbered on: what is done every so many frames has its share in every run.
    double nextMs() {
        _frameStamp->setFrameNumber(_frameStamp->getFrameNumber() + 1);
        return _stage->cull(_scene.camera(), *_frameStamp);
    }

    MethodScene& _scene;
    osg::ref_ptr<osg::FrameStamp> _frameStamp;
    osg::ref_ptr<osgDB::DatabasePager> _pager = new osgDB::DatabasePager;
    std::optional<flight::CullStage> _stage;
    int _turns = 0;
    std::vector<double> _warm;
    std::vector<double> _cold;
};

}  // namespace

std::vector<CullTimes> cullTimes(const std::vector<std::unique_ptr<MethodScene>>& scenes, int rounds,
                                 int flushMebibytes) {
    std::vector<unsigned char> other(static_cast<std::size_t>(flushMebibytes) * kMebibyte), none;
    std::vector<Turns> stages;
    for (const auto& scene : scenes) stages.emplace_back(*scene);
    for (int round = 0; round < rounds; ++round) {
        support::throwIfStopRequested();
        for (std::size_t i = 0; i < stages.size(); ++i)
            stages[(i + static_cast<std::size_t>(round)) % stages.size()].take(round % kRoundsForOneCold == 0 ? other
                                                                                                              : none);
    }
    std::vector<CullTimes> times;
    for (const Turns& stage : stages) times.push_back(stage.result());
    return times;
}

}  // namespace osgAnalyticBin::bench
