// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullMethod.h"
#include "Output.h"
#include "TextFile.h"

#include <algorithm>

namespace osgAnalyticBin::bench {

namespace {

using support::withDecimals;

// A gain below this share is none.
constexpr double kLeastGain = 0.05;

/// The figures of bins, and the better of what they stand in place of.
struct Comparison {
    double bins = 0.0;
    double other = 0.0;
    std::string name;  // of the other

    [[nodiscard]] double ratio() const { return other > 0.0 ? bins / other : 1.0; }
    [[nodiscard]] bool isGain() const { return ratio() < 1.0 - kLeastGain; }
    [[nodiscard]] bool isLoss() const { return ratio() > 1.0 + kLeastGain; }
};

const MethodFigures* methodNamed(const std::vector<MethodFigures>& methods, const std::string& name) {
    const auto found = std::find_if(methods.begin(), methods.end(), [&](const auto& m) { return m.method == name; });
    return found == methods.end() ? nullptr : &*found;
}

constexpr const char* kTiles = "drawn_tiles";

/// Bins against the better of two methods, over some poses.
class Judge {
public:
    explicit Judge(const std::vector<MethodFigures>& methods)
        : _bins(methodNamed(methods, kDefaultMethod)),
          _spheres(methodNamed(methods, "sphere")),
          _clusters(methodNamed(methods, "cluster")) {}

    [[nodiscard]] bool isPossible() const { return _bins && (_spheres || _clusters); }

    [[nodiscard]] Comparison compare(const char* column, const PathGroup& poses) const {
        const auto value = [&](const MethodFigures& method) { return sumOf(method, poses)[column].get<double>(); };
        Comparison better{value(*_bins), 0.0, {}};
        const auto consider = [&](const MethodFigures* method, const char* name) {
            if (!method) return;
            const double other = value(*method);
            if (better.name.empty() || other < better.other) {
                better.other = other;
                better.name = name;
            }
        };
        consider(_spheres, "spheres");
        consider(_clusters, "cluster callbacks");
        return better;
    }

private:
    const MethodFigures* _bins;
    const MethodFigures* _spheres;
    const MethodFigures* _clusters;
};

std::string times(const Comparison& comparison) {
    return withDecimals(comparison.ratio(), 2) + " times";
}

std::string worth(const Comparison& tiles, const Comparison& time) {
    if (time.isLoss() && !tiles.isGain()) return "Bins are not worth it for this database";
    if (!time.isGain() && !tiles.isGain()) return "Bins change little for this database";
    return time.isLoss() ? "Bins are worth it for this database where drawing takes longer than culling"
                         : "Bins are worth it for this database";
}

std::string tilesSentence(const Comparison& tiles, const Comparison& time) {
    return worth(tiles, time) + ": they draw " + withDecimals(tiles.bins, 0) + " tiles where " + tiles.name + " draw " +
           withDecimals(tiles.other, 0) + " (" + times(tiles) + ").";
}

std::string costSentence(const Comparison& files, const Comparison& time, const Comparison& cold, std::size_t poses) {
    const auto perPose = [&](double ms) { return withDecimals(ms / static_cast<double>(poses), 3) + " ms"; };
    // --flush 0 leaves it out
    const std::string coldTimes = cold.other > 0.0 ? ", and " + times(cold) + " with cold caches" : "";
    return "They read " + withDecimals(files.bins, 0) + " files where " + files.name + " read " +
           withDecimals(files.other, 0) + " (" + times(files) + "), and a cull takes " + perPose(time.bins) +
           " where it takes " + perPose(time.other) + " with " + time.name + " (" + times(time) + coldTimes + ").";
}

std::string whereSentence(const Judge& judge, const std::vector<PathGroup>& paths) {
    std::string where;
    for (const PathGroup& path : paths) {
        const Comparison tiles = judge.compare(kTiles, path), time = judge.compare(kCullColumn, path);
        if (tiles.isGain() && !time.isLoss()) continue;
        if (!tiles.isLoss() && time.isGain()) continue;
        where += (where.empty() ? "" : ", ") + path.name + " (" + withDecimals(tiles.ratio(), 2) +
                 " times the tiles, " + withDecimals(time.ratio(), 2) + " times the cull time)";
    }
    return where.empty() ? "They help on every path that was flown."
                         : "They do not help, or cost time, here: " + where + ".";
}

}  // namespace

std::vector<std::string> adviceOf(const std::vector<std::string>& poses, const std::vector<MethodFigures>& methods) {
    const Judge judge(methods);
    if (!judge.isPossible()) return {};
    PathGroup all;
    for (std::size_t i = 0; i < poses.size(); ++i) all.poses.push_back(i);
    const Comparison tiles = judge.compare(kTiles, all), files = judge.compare("files_requested", all),
                     time = judge.compare(kCullColumn, all);
    return {tilesSentence(tiles, time), costSentence(files, time, judge.compare(kCullColdColumn, all), poses.size()),
            whereSentence(judge, pathGroupsOf(poses))};
}

}  // namespace osgAnalyticBin::bench
