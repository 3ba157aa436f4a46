// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Report.h"

#include "PathGroups.h"
#include "PictureDifference.h"
#include "Table.h"
#include "TextFile.h"

#include <osgDB/WriteFile>

#include <algorithm>
#include <array>
#include <filesystem>
#include <ostream>

namespace osgAnalyticBin::report {

namespace {

using flight::PoseRecord;
using support::withDecimals;

constexpr const char* kRatioBase = "sphere";

/// A figure of a flight at one pose, or its sum.
struct Column {
    const char* title;
    int decimals;
    double (*value)(const Flight& run, std::size_t pose);
};

template <auto Count>
double tiles(const Flight& run, std::size_t pose) {
    return static_cast<double>(run.poses[pose].tiles.*Count);
}

using flight::TileCounts;

constexpr std::array<Column, 8> kColumns{
    {{"tested", 0, tiles<&TileCounts::tested>},
     {"kept", 0, tiles<&TileCounts::kept>},
     {"drawn", 0, tiles<&TileCounts::drawn>},
     {"triangles", 0, tiles<&TileCounts::triangles>},
     {"files", 0, [](const Flight& run, std::size_t pose) { return static_cast<double>(run.poses[pose].files); }},
     {"cull ms", 3, [](const Flight& run, std::size_t pose) { return run.poses[pose].cullMs; }},
     {"frame ms", 2, [](const Flight& run, std::size_t pose) { return run.poses[pose].frameMs; }},
     {"diff. pixels", 0,
      [](const Flight& run, std::size_t pose) { return static_cast<double>(run.differingPixels[pose]); }}}};

using Figures = std::array<double, kColumns.size()>;

Figures sumOf(const Flight& run, const std::vector<std::size_t>& poses) {
    Figures sum{};
    for (const std::size_t pose : poses)
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += kColumns[i].value(run, pose);
    return sum;
}

std::vector<std::string> lineOf(const std::string& title, const std::string& label, const Figures& figures) {
    std::vector<std::string> cells{title, label};
    for (std::size_t i = 0; i < figures.size(); ++i) cells.push_back(withDecimals(figures[i], kColumns[i].decimals));
    return cells;
}

// Of all but the pixels: a ratio of differing pixels says nothing.
std::vector<std::string> ratioLineOf(const std::string& label, const Figures& figures, const Figures& base) {
    std::vector<std::string> cells{"", label};
    for (std::size_t i = 0; i + 1 < figures.size(); ++i) cells.push_back(ratioText(figures[i], base[i]));
    return cells;
}

// In the order of the path; poses that stand alone are no group.
std::vector<PathGroup> groupsOf(const std::vector<PoseRecord>& poses) {
    std::vector<std::string> names;
    for (const PoseRecord& pose : poses) names.push_back(pose.name);
    std::vector<PathGroup> groups = pathGroupsOf(names);
    groups.erase(std::remove_if(groups.begin(), groups.end(), [](const PathGroup& g) { return g.poses.size() < 2; }),
                 groups.end());
    return groups;
}

PathGroup allOf(const std::vector<PoseRecord>& poses) {
    PathGroup all{"all poses", {}};
    for (std::size_t i = 0; i < poses.size(); ++i) all.poses.push_back(i);
    return all;
}

void addSums(TextTable& table, const std::vector<Flight>& runs, const PathGroup& group) {
    const std::string title = "sum of " + group.name + (group.name == "all poses" ? "" : "_*");
    table.addGap();
    for (const Flight& run : runs)
        table.add(lineOf(&run == &runs.front() ? title : "", run.label, sumOf(run, group.poses)));
    const auto base = std::find_if(runs.begin(), runs.end(), [](const Flight& run) { return run.label == kRatioBase; });
    if (base == runs.end()) return;
    const Figures baseSum = sumOf(*base, group.poses);
    for (const Flight& run : runs)
        if (&run != &*base) table.add(ratioLineOf(run.label + " / " + kRatioBase, sumOf(run, group.poses), baseSum));
}

bool isSound(const std::string& label) {
    return label != "paper" && label != "corners";
}

std::string nameOf(const std::string& folder) {
    const std::filesystem::path path = std::filesystem::path(folder).lexically_normal();
    return (path.has_filename() ? path : path.parent_path()).filename().string();
}

bool hasPosesOf(const Flight& reference, const Flight& run) {
    return std::equal(reference.poses.begin(), reference.poses.end(), run.poses.begin(), run.poses.end(),
                      [](const PoseRecord& a, const PoseRecord& b) { return a.name == b.name; });
}

bool write(const PictureDifference& difference, const std::string& folder, const std::string& name,
           std::string& error) {
    const std::filesystem::path file = std::filesystem::path(folder) / (name + ".png");
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (!problem && osgDB::writeImageFile(*difference.picture, file.string())) return true;
    error = file.string() + ": cannot be written";
    return false;
}

bool comparePictures(const Flight& reference, Flight& run, const std::string& differenceFolder, std::string& error) {
    for (std::size_t i = 0; i < run.poses.size(); ++i) {
        const auto pathOf = [i](const Flight& of) {
            return (std::filesystem::path(of.folder) / of.poses[i].picture).string();
        };
        const auto difference = compareFiles(pathOf(reference), pathOf(run), error);
        if (!difference) return false;
        run.differingPixels[i] = difference->pixels;
        if (difference->pixels > 0 && !differenceFolder.empty() &&
            !write(*difference, differenceFolder, run.label + "_" + run.poses[i].name, error))
            return false;
    }
    return true;
}

}  // namespace

std::optional<Report> Report::of(const std::vector<std::string>& folders, const std::vector<std::string>& labels,
                                 const std::string& differenceFolder, std::string& error) {
    Report report;
    for (std::size_t i = 0; i < folders.size(); ++i) {
        auto poses = flight::readPoseTable(folders[i], error);
        if (!poses) return std::nullopt;
        Flight run{labels.empty() ? nameOf(folders[i]) : labels[i], folders[i], std::move(*poses), {}};
        run.differingPixels.resize(run.poses.size());
        if (i > 0 && !hasPosesOf(report._runs.front(), run)) {
            error = folders[i] + ": its poses are not those of " + folders.front();
            return std::nullopt;
        }
        if (i > 0 && !comparePictures(report._runs.front(), run, differenceFolder, error)) return std::nullopt;
        report._runs.push_back(std::move(run));
    }
    return report;
}

void Report::print(std::ostream& output) const {
    if (_runs.empty()) return;
    const std::vector<PoseRecord>& poses = _runs.front().poses;
    TextTable table(2);
    std::vector<std::string> titles{"pose", "method"};
    for (const Column& column : kColumns) titles.emplace_back(column.title);
    table.add(std::move(titles));
    for (std::size_t i = 0; i < poses.size(); ++i)
        for (const Flight& run : _runs)
            table.add(lineOf(&run == &_runs.front() ? poses[i].name : "", run.label, sumOf(run, {i})));
    for (const PathGroup& group : groupsOf(poses)) addSums(table, _runs, group);
    addSums(table, _runs, allOf(poses));
    table.print(output);
}

std::vector<Mismatch> Report::mismatches() const {
    std::vector<Mismatch> found;
    for (const Flight& run : _runs) {
        if (!isSound(run.label)) continue;
        for (std::size_t i = 0; i < run.poses.size(); ++i)
            if (run.differingPixels[i] > 0) found.push_back({run.label, run.poses[i].name, run.differingPixels[i]});
    }
    return found;
}

}  // namespace osgAnalyticBin::report
