// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Compare.h"

#include "Failure.h"
#include "FigureChange.h"
#include "Table.h"

#include <algorithm>
#include <ostream>
#include <set>
#include <utility>

namespace osgAnalyticBin::bench {

using support::Failure;

namespace {

const char* wordFor(Verdict verdict) {
    switch (verdict) {
        case Verdict::Same:
            return "same";
        case Verdict::Noise:
            return "within noise";
        case Verdict::Changed:
            return "changed";
        case Verdict::Better:
            return "better";
        case Verdict::Worse:
            return "WORSE";
    }
    return "";
}

const MeasuredMethod* find(const std::vector<MeasuredMethod>& methods, const std::string& name) {
    const auto found = std::find_if(methods.begin(), methods.end(), [&](const auto& m) { return m.name == name; });
    return found == methods.end() ? nullptr : &*found;
}

void print(std::ostream& output, const std::string& title, const std::vector<FigureChange>& changes) {
    report::TextTable table(2);
    table.add({title, "figure", "old", "new", "new/old", "by pose", "noise", "verdict"});
    std::size_t same = 0;
    for (const FigureChange& change : changes) {
        if (change.verdict == Verdict::Same && change.isCount())
            ++same;
        else
            table.add({change.method, change.figure, change.before, change.after, change.ratio, change.poses,
                       change.noise, wordFor(change.verdict)});
    }
    table.print(output);
    output << same << " counts are the same\n";
}

std::set<std::string> columnsOf(const std::vector<MeasuredMethod>& methods) {
    std::set<std::string> columns;
    for (const MeasuredMethod& method : methods)
        for (const auto& [column, value] : method.sums) columns.insert(column);
    return columns;
}

void sayWhatIsMissing(std::ostream& output, const Measurement& here, const Measurement& there) {
    std::string missing;
    for (const MeasuredMethod& method : here.methods)
        if (!find(there.methods, method.name)) missing += " " + method.name;
    const std::set<std::string> known = columnsOf(there.methods);
    for (const std::string& column : columnsOf(here.methods))
        if (known.count(column) == 0) missing += " " + column;
    if (!missing.empty()) output << "only in " << here.file << ":" << missing << "\n";
}

void requireTheSameMeasurement(const Measurement& before, const Measurement& after) {
    const std::string both = before.file + " and " + after.file + ": ";
    if (before.mode != after.mode)
        throw Failure(both + "one stopped at poses, the other flew on; measure both in the same way");
    if (before.poseNames != after.poseNames)
        throw Failure(both + "the poses are not the same; measure both with the same --path");
    const bool share = std::any_of(before.methods.begin(), before.methods.end(),
                                   [&](const MeasuredMethod& m) { return find(after.methods, m.name); });
    if (!share) throw Failure(both + "no method is in both; measure both with the same --methods");
}

void warnOfOtherConditions(std::ostream& output, const Measurement& before, const Measurement& after) {
    std::string differences;
    for (std::size_t i = 0; i < before.conditions.size(); ++i) {
        const auto& [key, old] = before.conditions[i];
        const std::string& now = after.conditions[i].second;
        if (old != now) differences += (differences.empty() ? "" : ", ") + key + " (" + old + " and " + now + ")";
    }
    if (!differences.empty()) output << "warning: not measured alike: " << differences << "\n\n";
}

std::size_t countOf(const std::vector<FigureChange>& changes, Verdict verdict) {
    return static_cast<std::size_t>(std::count_if(
        changes.begin(), changes.end(), [&](const FigureChange& change) { return change.verdict == verdict; }));
}

}  // namespace

std::string comparisonRule() {
    return "--compare prints the ratio new/old of every figure that changed, with the least and the greatest ratio at "
           "a\n"
           "pose. Counts have no noise: a greater one is worse, a smaller one better; those of the view (truth_tiles "
           "and\n"
           "the like) and of none are not judged. Times are judged by their ratio to sphere's in the same file, which\n"
           "cancels how fast the machine was, or as they are where a file has no sphere. Noise is the root of the sum "
           "of\n"
           "squares of half of each pose's cull_spread_ms over all times that enter, and 5 % at least. Times without "
           "a\n"
           "spread, times of sphere and none, and all of a continuous flight or of \"live\" are not judged.\n";
}

bool compareFiles(const std::string& oldFile, const std::string& newFile, std::ostream& output) {
    const Measurement before = measurementFromFile(oldFile);
    const Measurement after = measurementFromFile(newFile);
    requireTheSameMeasurement(before, after);
    warnOfOtherConditions(output, before, after);
    std::vector<FigureChange> changes = changesOf(before.methods, after.methods);
    if (before.mode != "poses") changes = unjudged(std::move(changes));
    print(output, "method", changes);
    if (!before.live.empty() && !after.live.empty()) {
        output << '\n';
        print(output, "live", unjudged(changesOf(before.live, after.live)));
    }
    sayWhatIsMissing(output, before, after);
    sayWhatIsMissing(output, after, before);
    const std::size_t worse = countOf(changes, Verdict::Worse);
    output << "\nbeyond noise: " << worse << " worse, " << countOf(changes, Verdict::Better) << " better, "
           << countOf(changes, Verdict::Changed) << " changed otherwise\n";
    return worse > 0;
}

}  // namespace osgAnalyticBin::bench
