// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Report.h"

#include "PathGroups.h"
#include "PictureDifference.h"
#include "RowTable.h"
#include "TextFile.h"
#include "TextTable.h"

#include <osgDB/WriteFile>

#include <algorithm>
#include <filesystem>
#include <ostream>

namespace osgAnalyticBin::report {

namespace {

using flight::PoseRecord;
using support::withDecimals;

constexpr const char* kRatioBase = "sphere";

/// What one line of the table shows.
struct Figures {
    double tested = 0.0;
    double kept = 0.0;
    double drawn = 0.0;
    double triangles = 0.0;
    double files = 0.0;
    double cullMs = 0.0;
    double frameMs = 0.0;
    double pixels = 0.0;
};

// Every figure but the pixels: a ratio of differing pixels says nothing.
constexpr double Figures::*kRatioFigures[] = {&Figures::tested, &Figures::kept,   &Figures::drawn,  &Figures::triangles,
                                              &Figures::files,  &Figures::cullMs, &Figures::frameMs};

Figures figuresOf(const Flight& run, std::size_t pose) {
    const PoseRecord& record = run.poses[pose];
    return {static_cast<double>(record.tiles.tested),
            static_cast<double>(record.tiles.kept),
            static_cast<double>(record.tiles.drawn),
            static_cast<double>(record.tiles.triangles),
            static_cast<double>(record.files),
            record.cullMs,
            record.frameMs,
            static_cast<double>(run.differingPixels[pose])};
}

Figures sumOf(const Flight& run, const std::vector<std::size_t>& poses) {
    Figures sum;
    for (const std::size_t pose : poses) {
        const Figures figures = figuresOf(run, pose);
        for (const auto figure : kRatioFigures) sum.*figure += figures.*figure;
        sum.pixels += figures.pixels;
    }
    return sum;
}

std::vector<std::string> lineOf(const std::string& title, const std::string& label, const Figures& f) {
    return {title,
            label,
            withDecimals(f.tested, 0),
            withDecimals(f.kept, 0),
            withDecimals(f.drawn, 0),
            withDecimals(f.triangles, 0),
            withDecimals(f.files, 0),
            withDecimals(f.cullMs, 3),
            withDecimals(f.frameMs, 2),
            withDecimals(f.pixels, 0)};
}

std::vector<std::string> ratioLineOf(const std::string& title, const std::string& label, const Figures& f,
                                     const Figures& base) {
    std::vector<std::string> cells{title, label};
    for (const auto figure : kRatioFigures) cells.push_back(ratioText(f.*figure, base.*figure));
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
        if (&run != &*base)
            table.add(ratioLineOf("", run.label + " / " + kRatioBase, sumOf(run, group.poses), baseSum));
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
    table.add(
        {"pose", "method", "tested", "kept", "drawn", "triangles", "files", "cull ms", "frame ms", "diff. pixels"});
    for (std::size_t i = 0; i < poses.size(); ++i)
        for (const Flight& run : _runs)
            table.add(lineOf(&run == &_runs.front() ? poses[i].name : "", run.label, figuresOf(run, i)));
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
