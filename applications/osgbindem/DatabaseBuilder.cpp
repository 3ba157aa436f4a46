// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BuildSources.h"
#include "DatabaseFolder.h"
#include "DiskFile.h"
#include "Failure.h"
#include "Interruption.h"
#include "ProgramRun.h"
#include "TaskWork.h"
#include "TileFiles.h"

#include <cpl_string.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <new>
#include <optional>
#include <thread>
#include <utility>

namespace osgbindem {

using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::Interrupted;
using osgAnalyticBin::support::stopRequested;
using osgAnalyticBin::support::throwIfStopRequested;

namespace {

/// Ends the program, MPI's part left out, as mpirun wants it after a signal.
[[noreturn]] void leaveAfterSignal() {
    std::_Exit(osgAnalyticBin::support::kInterrupted);
}

/// Says what an earlier run has left, and makes the state one of this database.
void beginOrGoOn(const Settings& settings, const std::string& sources, std::size_t parts, DatabaseFolder& folder) {
    const bool isSame = folder.isStateOf(sources);
    const std::size_t done = folder.doneCount();
    if (isSame && !settings.restart) {
        if (done > 0 && !settings.quiet) {
            std::cout << "resumes: " << done << " of " << parts << " parts are done" << std::endl;
        }
        return;
    }
    if (done > 0 && !settings.quiet) {
        std::cout << "starts again: \"" << folder.partial() << "\" was "
                  << (isSame ? "to be removed" : "built from other settings or rasters") << std::endl;
    }
    folder.clear();
    folder.beginState(sources);
}

/// For the user, after a message; empty when nothing is kept.
std::string whatIsKept(const DatabaseFolder& folder, std::size_t parts) {
    const std::size_t done = folder.doneCount();
    if (done == 0) return {};
    return "; " + std::to_string(done) + " of " + std::to_string(parts) + " parts are kept in \"" + folder.partial() +
           "\"; the same command goes on with them";
}

std::string interruption(const DatabaseFolder& folder, std::size_t parts) {
    const std::string kept = whatIsKept(folder, parts);
    return "interrupted" + (kept.empty() ? "; nothing was left behind" : kept);
}

std::string placeOf(const Tally::Extreme& extreme) {
    const double latitude = extreme.position.latitudeDeg;
    const double longitude = std::remainder(extreme.position.longitudeDeg, 360.0);
    return CPLSPrintf("%.1f m (%.4f %c, %.4f %c)", extreme.metres, std::abs(latitude), latitude < 0.0 ? 'S' : 'N',
                      std::abs(longitude), longitude < 0.0 ? 'W' : 'E');
}

/// Says what was built, in lines, and warns where data is missing. `seconds`: the time that it took.
void tell(const Tally& tally, const std::string& name, int startLevel, double seconds) {
    std::cout << name
              << CPLSPrintf(": %.0f tiles in levels %d to %.0f, %.0f files, %.1f MiB, %.1f s", tally.tiles, startLevel,
                            tally.deepest, tally.files, std::ldexp(tally.bytes, -20), seconds);
    if (tally.missing < tally.posts)
        std::cout << "\nheights from " << placeOf(tally.lowest) << " to " << placeOf(tally.highest);
    std::cout << CPLSPrintf("; of %.0f posts, %.0f are filled voids and %.0f are at 0 m without data", tally.posts,
                            tally.filled, tally.missing)
              << std::endl;
    if (tally.missing == 0.0) return;
    std::cerr << CPLSPrintf(
                     "osgbindem: warning: no raster has data for %.0f of %.0f posts, which are at 0 m; add a "
                     "raster below, or build a part of the earth with -te",
                     tally.missing, tally.posts)
              << std::endl;
}

/// The three times at which all ranks wait for each other: when the first one has prepared the folder, when all parts
/// are done, and when the first one has completed the database. Those that are left are held when the object goes.
class Meetings final {
public:
    /// `interrupted`: called when a signal comes while this rank waits, and does not return.
    Meetings(const Ranks& ranks, std::function<void()> interrupted)
        : _ranks(ranks), _interrupted(std::move(interrupted)) {}
    Meetings(const Meetings&) = delete;
    Meetings& operator=(const Meetings&) = delete;
    ~Meetings() {
        giveUp();
        (void)_ranks.meet(false, {});
    }

    /// What to do with a signal from now on.
    void setInterrupted(std::function<void()> interrupted) { _interrupted = std::move(interrupted); }

    /// The next one.
    /// Throws: when a rank has failed, what it says in the first rank (Failure), Interrupted in the others.
    void hold() {
        ++_held;
        if (!_ranks.meet(false, [this] {
                if (stopRequested) _interrupted();
            }))
            return;
        // It was sent before that rank came.
        std::optional<std::string> text;
        while (_ranks.isFirst() && !(text = _ranks.failureElsewhere()))
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        fail(text.value_or(""));
    }
    /// This rank has failed: returns when no other one writes any more.
    void giveUp() {
        constexpr int kUntilPartsAreDone = 2;
        for (; _held < kUntilPartsAreDone; ++_held) (void)_ranks.meet(true, {});
    }
    /// Throws as hold().
    void glance(bool isStopped) const {
        if (isStopped) _interrupted();
        if (const auto text = _ranks.failureElsewhere()) fail(*text);
    }

private:
    [[noreturn]] void fail(const std::string& text) const {
        if (_ranks.isFirst()) throw Failure(text);
        throw Interrupted();
    }

    const Ranks& _ranks;
    std::function<void()> _interrupted;
    int _held = 0;
};

/// Ranks take turns, so that each has as much to do as the others.
std::vector<Task> partsOf(const Ranks& ranks, const std::vector<Task>& plan) {
    std::vector<Task> parts;
    for (std::size_t i = static_cast<std::size_t>(ranks.rank()); i < plan.size();
         i += static_cast<std::size_t>(ranks.count()))
        parts.push_back(plan[i]);
    return parts;
}

/// Does this rank's parts, and waits until all ranks have done theirs.
void doParts(const Site& site, const std::vector<Task>& plan, const Ranks& ranks, Meetings& meetings) {
    try {
        Glance glance;
        if (ranks.count() > 1) glance = [&](bool isStopped) { meetings.glance(isStopped); };
        doTasks(site, partsOf(ranks, plan), glance);
        if (!ranks.isFirst())
            osgAnalyticBin::support::flushToDisk(site.folder.partial());  // what this machine holds back
        meetings.hold();
    } catch (...) {
        if (ranks.isFirst()) {
            ranks.sendFailure({});
            meetings.giveUp();
        }
        throw;
    }
}

void buildWith(const Settings& given, const Ranks& ranks) {
    const auto start = std::chrono::steady_clock::now();
    Meetings meetings(ranks, throwIfStopRequested);
    prepareNodeFiles();
    const Settings settings = withDeclaredRadii(given);
    const TileLayout layout = checkedLayoutFor(settings);
    DatabaseFolder folder(settings.output);
    folder.lock();
    if (!settings.overwrite) folder.requireNone();
    const std::vector<Task> plan = planTasks(DemMosaic(settings, &layout), layout);
    const std::string sources = describeSources(settings, layout);
    beginOrGoOn(settings, sources, plan.size(), folder);
    meetings.hold();
    // Others may be writing still, and mpirun has no patience: all is left as it is, as after a kill.
    meetings.setInterrupted([&] {
        std::cerr << "osgbindem: " + interruption(folder, plan.size()) + "\n" << std::flush;
        leaveAfterSignal();
    });
    try {
        Progress progress(!settings.quiet, weightOf(partsOf(ranks, plan)));
        const Site site{settings, layout, folder, progress};
        doParts(site, plan, ranks, meetings);
        const std::vector<BuiltTile> starts = buildStarts(site, plan);
        const std::string root = rootFileBytes(starts, settings, layout);
        folder.complete(root, sources);
        progress.finish();
        if (settings.quiet) return;
        Tally tally;
        for (const BuiltTile& tile : starts) tally.add(tile.survey.tally);
        ++tally.files;
        tally.bytes += static_cast<double>(root.size());
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
        tell(tally, settings.output, layout.startLevel(), time.count());
    } catch (const Interrupted&) {
        throw Interrupted(interruption(folder, plan.size()));
    } catch (const Failure& failure) {
        throw Failure(failure.what() + whatIsKept(folder, plan.size()));
    }
}

/// Every rank but the first.
void helpFirstRank(const Settings& given, const Ranks& ranks) {
    Meetings meetings(ranks, leaveAfterSignal);
    try {
        prepareNodeFiles();
        const Settings settings = withDeclaredRadii(given);
        const TileLayout layout = layoutFor(settings, DemMosaic(settings));
        const std::vector<Task> plan = planTasks(DemMosaic(settings, &layout), layout);
        meetings.hold();
        const DatabaseFolder folder(settings.output);
        Progress progress(false, 1.0);
        doParts({settings, layout, folder, progress}, plan, ranks, meetings);
    } catch (const Interrupted&) {
        // the first rank knows why
    } catch (const std::bad_alloc&) {
        ranks.sendFailure("out of memory; use fewer ranks or --threads on a machine");
    } catch (const std::exception& error) {
        ranks.sendFailure(error.what());
    }
}

}  // namespace

void buildDatabase(const Settings& settings, const Ranks& ranks) {
    ranks.isFirst() ? buildWith(settings, ranks) : helpFirstRank(settings, ranks);
}

}  // namespace osgbindem
