// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The file of a BoxIndex is text:
//   osgAnalyticBin boxes 1
//   for each file: its number of LODs, a blank, and its name; then a line for each LOD: least x y z, greatest x y z,
//   or "unknown"
//   where the index has stamps, for each file: stamp, bytes, seconds, nanoseconds, and its name
//   end, the number of files and that of boxes

#include "../WholeFile.h"

#include <osgAnalyticBin/BoxIndex.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <istream>
#include <optional>
#include <ostream>
#include <string_view>

namespace osgAnalyticBin {

namespace {

constexpr std::string_view kUnknownBox = "unknown";
constexpr std::string_view kStamp = "stamp ";
constexpr std::string_view kEnd = "end ";

std::string textOf(const osg::BoundingBoxf& box) {
    if (!box.valid()) return std::string(kUnknownBox);
    std::string text;
    for (const float number : {box.xMin(), box.yMin(), box.zMin(), box.xMax(), box.yMax(), box.zMax()}) {
        char digits[32];
        // the shortest that reads back as the same number
        const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
        text.append(text.empty() ? "" : " ").append(digits, end);
    }
    return text;
}

std::optional<osg::BoundingBoxf> boxFrom(std::string_view text) {
    if (text == kUnknownBox) return osg::BoundingBoxf();
    float numbers[6] = {};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (float& number : numbers) {
        if (&number != numbers && (at == end || *at++ != ' ')) return std::nullopt;
        const auto [next, error] = std::from_chars(at, end, number);
        if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
        at = next;
    }
    const osg::BoundingBoxf box(numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5]);
    return at == end && box.valid() ? std::optional(box) : std::nullopt;
}

// Takes a number and the blank behind it from the front of a line.
template <class Number>
bool take(std::string_view& line, Number& number) {
    const auto [next, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    const auto blank = static_cast<std::size_t>(next - line.data());
    if (error != std::errc() || blank + 1 >= line.size() || line[blank] != ' ') return false;
    line.remove_prefix(blank + 1);
    return true;
}

// "3 Data/a.osgb" makes 3 and the name.
std::optional<std::pair<std::size_t, std::string>> fileFrom(std::string_view line) {
    std::size_t count = 0;
    if (!take(line, count)) return std::nullopt;
    return std::pair(count, std::string(line));
}

bool startsWith(std::string_view line, std::string_view word) {
    return line.compare(0, word.size(), word) == 0;
}

// Returns: whether the line is a stamp.
bool addStamp(std::string_view line, BinIndex::Stamps& stamps) {
    line.remove_prefix(kStamp.size());
    BinIndex::Stamp stamp;
    const bool isStamp = take(line, stamp.size) && take(line, stamp.time) && take(line, stamp.nanoseconds);
    return isStamp && stamps.emplace(line, stamp).second;
}

std::string endOf(const BoxIndex& index) {
    return std::string(kEnd) + std::to_string(index.numFiles()) + ' ' + std::to_string(index.numBoxes());
}

}  // namespace

const osg::BoundingBoxf* BoxIndex::find(const std::string& file, std::size_t ordinal) const {
    const auto found = _files.find(file);
    return found != _files.end() && ordinal < found->second.size() ? &found->second[ordinal] : nullptr;
}

std::size_t BoxIndex::numBoxes() const {
    std::size_t count = 0;
    for (const auto& [file, boxes] : _files) count += boxes.size();
    return count;
}

bool BoxIndex::write(std::ostream& out) const {
    out << kMagic << '\n';
    for (const auto& [file, boxes] : _files) {
        out << boxes.size() << ' ' << file << '\n';
        for (const osg::BoundingBoxf& box : boxes) out << textOf(box) << '\n';
    }
    for (const auto& [file, stamp] : _stamps)
        out << kStamp << stamp.size << ' ' << stamp.time << ' ' << stamp.nanoseconds << ' ' << file << '\n';
    out << endOf(*this) << '\n';
    return static_cast<bool>(out.flush());
}

bool BoxIndex::write(const std::string& path, std::string& error) const {
    return writeWholeFile(
        path, [this](std::ostream& out) { return write(out); }, error);
}

osg::ref_ptr<BoxIndex> BoxIndex::read(std::istream& in, std::string& error) {
    const osg::ref_ptr<BoxIndex> index = new BoxIndex;
    std::string line;
    if (!std::getline(in, line) || line != kMagic) {
        error = "is no index of boxes, or of another version";
        return nullptr;
    }
    while (std::getline(in, line)) {
        if (startsWith(line, kEnd)) {
            if (line == endOf(*index)) return index;
            break;
        }
        if (startsWith(line, kStamp)) {
            if (!addStamp(line, index->_stamps)) break;
            continue;
        }
        const auto file = fileFrom(line);
        Boxes boxes;
        while (file && boxes.size() < file->first && std::getline(in, line)) {
            const auto box = boxFrom(line);
            if (!box) break;
            boxes.push_back(*box);
        }
        if (!file || boxes.size() != file->first) break;
        index->add(file->second, std::move(boxes));
    }
    error = in.eof() ? "ends too early" : "is damaged";
    return nullptr;
}

osg::ref_ptr<BoxIndex> BoxIndex::read(const std::string& path, std::string& error) {
    std::ifstream in(path, std::ios::binary);
    if (!in) {
        error = "\"" + path + "\" cannot be read";
        return nullptr;
    }
    osg::ref_ptr<BoxIndex> index = read(in, error);
    if (!index) error = "\"" + path + "\" " + error + "; make it again: osgbinconv --index";
    return index;
}

std::string boxIndexPath(const std::string& metadataFile) {
    return metadataFile + ".boxes";
}

}  // namespace osgAnalyticBin
