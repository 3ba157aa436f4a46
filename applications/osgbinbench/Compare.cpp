// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Compare.h"

#include "CullMethod.h"
#include "Failure.h"
#include "Table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <ostream>

namespace osgAnalyticBin::bench {

using report::Json;
using support::Failure;

namespace {

constexpr const char* kYardstick = "sphere";
constexpr double kLeastNoise = 0.05;
// What belongs to the view rather than to a method.
constexpr std::array<const char*, 4> kNeutral{"truth_tiles", "visible_tiles", "hidden_tiles", "frames"};
constexpr std::array<const char*, 10> kConditions{"database", "path",      "options",   "vertical_scale", "width",
                                                  "height",   "threading", "flush_mib", "expiry",         "osg"};

Json measurementFrom(const std::string& file) {
    std::ifstream input(file);
    if (!input) throw Failure(file + ": cannot be opened");
    Json json = Json::parse(input, nullptr, false);
    const bool isOurs = json.is_object() && json.contains("mode") && json.contains("methods");
    if (!isOurs) throw Failure(file + ": is not what osgbinbench --json writes");
    return json;
}

bool endsWith(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// By how much a sum of times may be off, as a share of it: half the spread of each pose, which are independent of each
// other; nullopt where no spread was measured.
std::optional<double> uncertainty(const Json& file, const std::string& method, const std::string& time) {
    const Json poses = file.value("by_pose", Json::object()).value(method, Json::object());
    const std::string spread = time.substr(0, time.size() - 2) + "spread_ms";  // cull_ms: cull_spread_ms
    const double sum = file["methods"][method][time].get<double>();
    if (!poses.contains(spread) || !(sum > 0.0)) return std::nullopt;
    double squares = 0.0;
    for (const Json& pose : poses[spread]) squares += std::pow(pose.get<double>() / 2.0, 2);
    return std::sqrt(squares) / sum;
}

/// The table of what changed from one file to another one.
class FileComparison {
public:
    FileComparison(const Json& before, const Json& after) : _before(before), _after(after) {
        _table.add({"method", "figure", "old", "new", "new/old", "noise", "verdict"});
        for (const auto& [method, figures] : before["methods"].items()) {
            if (!after["methods"].contains(method)) continue;
            for (const auto& figure : figures.items()) {
                const std::string& column = figure.key();
                if (!after["methods"][method].contains(column) || column.find("_spread") != std::string::npos) continue;
                endsWith(column, "_ms") ? addTime(method, column) : addCount(method, column);
            }
        }
    }

    void print(std::ostream& output) const {
        _table.print(output);
        output << _same << " counts are the same\n\nbeyond noise: " << _worse << " worse, " << _better << " better\n";
    }

    [[nodiscard]] bool isWorse() const { return _worse > 0; }

private:
    void addCount(const std::string& method, const std::string& column) {
        const Json &old = _before["methods"][method][column], &now = _after["methods"][method][column];
        if (old == now) {
            ++_same;
            return;
        }
        const bool isNeutral = std::find(kNeutral.begin(), kNeutral.end(), column) != kNeutral.end();
        const bool isJudged = _before["mode"] == "poses" && method != kReferenceMethod && !isNeutral;
        const double before = old.get<double>(), after = now.get<double>();
        addLine(method, column, before, after, "", isJudged ? verdict(after > before) : "changed");
    }

    void addTime(const std::string& method, const std::string& column) {
        double before = _before["methods"][method][column].get<double>();
        double after = _after["methods"][method][column].get<double>();
        const bool isYardstick = method == kYardstick || method == kReferenceMethod;
        std::optional<double> noise = noiseOf(method, column);
        if (isYardstick || !noise) return addLine(method, column, before, after, "", "");
        std::string figure = column;
        if (const std::optional<double> others = noiseOf(kYardstick, column)) {
            before /= _before["methods"][kYardstick][column].get<double>();
            after /= _after["methods"][kYardstick][column].get<double>();
            noise = std::hypot(*noise, *others);
            figure += std::string("/") + kYardstick;
        }
        noise = std::max(kLeastNoise, *noise);
        const bool isNoise = std::abs(std::log(after / before)) <= std::log1p(*noise);
        addLine(method, figure, before, after, report::cellText(*noise, 3),
                isNoise ? "within noise" : verdict(after > before));
    }

    // Of both files' times together; nullopt where one has none.
    [[nodiscard]] std::optional<double> noiseOf(const std::string& method, const std::string& column) const {
        for (const Json* const file : {&_before, &_after})
            if (!(*file)["methods"].contains(method) || !(*file)["methods"][method].contains(column))
                return std::nullopt;
        const auto before = uncertainty(_before, method, column), after = uncertainty(_after, method, column);
        if (!before || !after) return std::nullopt;
        return std::hypot(*before, *after);
    }

    std::string verdict(bool isWorse) {
        ++(isWorse ? _worse : _better);
        return isWorse ? "WORSE" : "better";
    }

    void addLine(const std::string& method, const std::string& figure, double before, double after,
                 const std::string& noise, const std::string& verdict) {
        const auto text = [](double value) { return report::cellText(value, std::trunc(value) == value ? 0 : 4); };
        _table.add({method, figure, text(before), text(after), report::ratioText(after, before), noise, verdict});
    }

    const Json& _before;
    const Json& _after;
    report::TextTable _table{2};
    std::size_t _same = 0, _worse = 0, _better = 0;
};

void requireTheSameMeasurement(const Json& before, const Json& after, const std::string& files) {
    if (before["mode"] != after["mode"])
        throw Failure(files + ": one stopped at poses, the other flew on; measure both in the same way");
    if (before.value("pose_names", Json()) != after.value("pose_names", Json()))
        throw Failure(files + ": the poses are not the same; measure both with the same --path");
    for (const auto& method : before["methods"].items())
        if (after["methods"].contains(method.key())) return;
    throw Failure(files + ": no method is in both; measure both with the same --methods");
}

void warnOfOtherConditions(std::ostream& output, const Json& before, const Json& after) {
    std::string differences;
    for (const char* const key : kConditions) {
        const Json old = before.value(key, Json()), now = after.value(key, Json());
        if (old != now)
            differences +=
                (differences.empty() ? "" : ", ") + std::string(key) + " (" + old.dump() + " and " + now.dump() + ")";
    }
    if (!differences.empty()) output << "warning: not measured alike: " << differences << "\n\n";
}

}  // namespace

std::string comparisonRule() {
    return "--compare prints the ratio new/old of every figure that both files have. Counts have no noise: a greater\n"
           "one is worse, a smaller one better; those of the view (truth_tiles and the like) and of none are not\n"
           "judged. Times are judged by their ratio to sphere's in the same file, which cancels how fast the machine\n"
           "was, or as they are where a file has no sphere. Noise is the root of the sum of squares of half of each\n"
           "pose's cull_spread_ms over all times that enter, and 5 % at least. Times without a spread, times of "
           "sphere\n"
           "and none, and flights are not judged.\n";
}

bool compareFiles(const std::string& oldFile, const std::string& newFile, std::ostream& output) {
    const Json before = measurementFrom(oldFile), after = measurementFrom(newFile);
    const std::string files = oldFile + " and " + newFile;
    try {
        requireTheSameMeasurement(before, after, files);
        warnOfOtherConditions(output, before, after);
        const FileComparison comparison(before, after);
        comparison.print(output);
        return comparison.isWorse();
    } catch (const Json::exception& error) {
        throw Failure(files + ": one is not what osgbinbench --json writes: " + error.what());
    }
}

}  // namespace osgAnalyticBin::bench
