// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FigureChange.h"

#include "CullMethod.h"
#include "TextFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace osgAnalyticBin::bench {

using support::withDecimals;

namespace {

constexpr const char* kYardstick = "sphere";
constexpr double kLeastNoise = 0.05;
// What belongs to the view rather than to a method.
constexpr std::array<const char*, 6> kNeutral{"truth_tiles",   "surface_tiles", "visible_tiles",
                                              "visible_files", "hidden_tiles",  "frames"};

std::string numberText(double value) {
    return std::trunc(value) == value ? withDecimals(value, 0) : withDecimals(value, 4);
}

double ratioOf(double newValue, double oldValue) {
    if (oldValue == newValue) return 1.0;
    return oldValue > 0.0 ? newValue / oldValue : std::numeric_limits<double>::infinity();
}

std::string ratioText(double newValue, double oldValue) {
    const double ratio = ratioOf(newValue, oldValue);
    return std::isfinite(ratio) ? withDecimals(ratio, 3) : "-";
}

bool isTime(const std::string& column) {
    const std::string end = "_ms";
    return column.size() > end.size() && column.compare(column.size() - end.size(), end.size(), end) == 0;
}

bool isSpread(const std::string& column) {
    return column.find("_spread") != std::string::npos;
}

// cull_ms has its spread in cull_spread_ms.
std::string spreadColumnOf(const std::string& time) {
    return time.substr(0, time.size() - 2) + "spread_ms";
}

const MeasuredMethod* methodNamed(const std::vector<MeasuredMethod>& methods, const std::string& name) {
    const auto found = std::find_if(methods.begin(), methods.end(), [&](const auto& m) { return m.name == name; });
    return found == methods.end() ? nullptr : &*found;
}

std::optional<double> valueOf(const MeasuredMethod& method, const std::string& column) {
    const auto found = method.sums.find(column);
    if (found == method.sums.end()) return std::nullopt;
    return found->second;
}

// By how much a sum of times may be off, as a share of it: half the spread of each pose, which are independent of each
// other; nullopt where no spread was measured.
std::optional<double> uncertainty(const MeasuredMethod& method, const std::string& time) {
    const auto value = valueOf(method, time);
    const auto spread = valueOf(method, spreadColumnOf(time));
    if (!value || !spread || !(*value > 0.0)) return std::nullopt;
    const auto byPose = method.byPose.find(spreadColumnOf(time));
    if (byPose == method.byPose.end()) return *spread / 2.0 / *value;
    double squares = 0.0;
    for (const double pose : byPose->second) squares += pose * pose / 4.0;
    return std::sqrt(squares) / *value;
}

struct Pair {
    const MeasuredMethod& before;
    const MeasuredMethod& after;
};

std::string poseRange(const Pair& pair, const std::string& column) {
    const auto before = pair.before.byPose.find(column);
    const auto after = pair.after.byPose.find(column);
    if (before == pair.before.byPose.end() || after == pair.after.byPose.end()) return {};
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (std::size_t i = 0; i < before->second.size(); ++i) {
        const double ratio = ratioOf(after->second[i], before->second[i]);
        least = std::min(least, ratio);
        most = std::max(most, ratio);
    }
    const auto text = [](double ratio) { return std::isfinite(ratio) ? withDecimals(ratio, 2) : std::string("-"); };
    return text(least) + " .. " + text(most);
}

FigureChange changeOf(const Pair& pair, const std::string& column, double before, double after) {
    FigureChange change;
    change.method = pair.before.name;
    change.figure = column;
    change.before = numberText(before);
    change.after = numberText(after);
    change.ratio = ratioText(after, before);
    change.poses = poseRange(pair, column);
    return change;
}

Verdict verdictOn(double ratio, double noise) {
    if (std::abs(std::log(ratio)) <= std::log1p(noise)) return Verdict::Noise;
    return ratio > 1.0 ? Verdict::Worse : Verdict::Better;
}

// Whether the two differ at some pose, though their sums may not.
bool differs(const Pair& pair, const std::string& column) {
    const auto before = pair.before.byPose.find(column);
    const auto after = pair.after.byPose.find(column);
    return before != pair.before.byPose.end() && after != pair.after.byPose.end() && before->second != after->second;
}

FigureChange countChange(const Pair& pair, const std::string& column, double before, double after) {
    FigureChange change = changeOf(pair, column, before, after);
    const bool isNeutral =
        pair.before.name == kReferenceMethod || std::find(kNeutral.begin(), kNeutral.end(), column) != kNeutral.end();
    if (before != after && !isNeutral)
        change.verdict = after > before ? Verdict::Worse : Verdict::Better;
    else if (before != after || differs(pair, column))
        change.verdict = Verdict::Changed;
    return change;
}

std::optional<double> uncertainty(const Pair& pair, const std::string& time) {
    const auto before = uncertainty(pair.before, time);
    const auto after = uncertainty(pair.after, time);
    if (!before || !after) return std::nullopt;
    return std::hypot(*before, *after);
}

void judge(FigureChange& change, double ratio, double uncertainty) {
    const double noise = std::max(kLeastNoise, uncertainty);
    change.noise = withDecimals(noise, 3);
    change.verdict = verdictOn(ratio, noise);
}

// Whether the method's times are not of the kit, but what others are measured by.
bool isYardstick(const std::string& method) {
    return method == kYardstick || method == kReferenceMethod;
}

// The time in terms of the yardstick's; nullopt where that was not measured in both files.
std::optional<FigureChange> relativeTimeChange(const Pair& pair, const std::optional<Pair>& yardstick,
                                               const std::string& column) {
    if (!yardstick || isYardstick(pair.before.name)) return std::nullopt;
    const auto own = uncertainty(pair, column);
    const auto others = uncertainty(*yardstick, column);
    if (!own || !others) return std::nullopt;
    const double before = *valueOf(pair.before, column) / *valueOf(yardstick->before, column);
    const double after = *valueOf(pair.after, column) / *valueOf(yardstick->after, column);
    FigureChange change = changeOf(pair, column + "/" + kYardstick, before, after);
    judge(change, after / before, std::hypot(*own, *others));
    return change;
}

FigureChange timeChange(const Pair& pair, const std::string& column, double before, double after, bool isJudged) {
    FigureChange change = changeOf(pair, column, before, after);
    const auto own = uncertainty(pair, column);
    if (own) judge(change, after / before, *own);
    const bool isBeyondNoise = own ? change.verdict != Verdict::Noise : before != after;
    if (isBeyondNoise && !(own && isJudged)) change.verdict = Verdict::Changed;
    return change;
}

std::optional<Pair> pairOf(const std::string& name, const std::vector<MeasuredMethod>& before,
                           const std::vector<MeasuredMethod>& after) {
    const MeasuredMethod* const old = methodNamed(before, name);
    const MeasuredMethod* const now = methodNamed(after, name);
    if (!old || !now) return std::nullopt;
    return Pair{*old, *now};
}

}  // namespace

bool FigureChange::isCount() const {
    return !isTime(figure) && figure.find('/') == std::string::npos;
}

std::vector<FigureChange> changesOf(const std::vector<MeasuredMethod>& before,
                                    const std::vector<MeasuredMethod>& after) {
    const std::optional<Pair> yardstick = pairOf(kYardstick, before, after);
    std::vector<FigureChange> changes;
    for (const MeasuredMethod& method : before) {
        const std::optional<Pair> pair = pairOf(method.name, before, after);
        if (!pair) continue;
        for (const auto& [column, old] : method.sums) {
            const auto now = valueOf(pair->after, column);
            if (!now || isSpread(column)) continue;
            if (!isTime(column)) {
                changes.push_back(countChange(*pair, column, old, *now));
                continue;
            }
            const auto relative = relativeTimeChange(*pair, yardstick, column);
            changes.push_back(timeChange(*pair, column, old, *now, !relative && !isYardstick(method.name)));
            if (relative) changes.push_back(*relative);
        }
    }
    return changes;
}

std::vector<FigureChange> unjudged(std::vector<FigureChange> changes) {
    for (FigureChange& change : changes)
        if (change.verdict == Verdict::Worse || change.verdict == Verdict::Better) change.verdict = Verdict::Changed;
    return changes;
}

}  // namespace osgAnalyticBin::bench
