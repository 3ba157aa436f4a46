// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BuildState.h"

#include "Checksum.h"
#include "Failure.h"
#include "RecordStream.h"
#include "TextFile.h"
#include "TileFiles.h"

#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

namespace osgbindem {

using osgAnalyticBin::RecordReader;
using osgAnalyticBin::RecordWriter;
using osgAnalyticBin::support::Failure;
namespace support = osgAnalyticBin::support;

namespace fs = std::filesystem;

namespace {

// What is in a record, and in which order: another one for each change.
constexpr std::uint64_t kRecordFormat = 0x6F73676254736B33U;

/// One description of the bytes for both directions.
template <class Stream, class Record, class Numbers>
void passRecord(Stream& s, Record& record, Numbers& heights) {
    s.number(record.files.files);
    s.number(record.files.bytes);
    s.number(record.files.checksum);
    s.number(record.tile.range.lower);
    s.number(record.tile.range.upper);
    Tally::pass(s, record.tile.tally);
    s.bin(record.tile.below);
    s.numbers(heights);
    for (auto& edge : record.tile.skirt) {
        s.numbers(edge.depth);
        s.numbers(edge.lean);
    }
}

std::string headOf(const TileId& tile) {
    RecordWriter out;
    out.number(kRecordFormat);
    for (const int number : {tile.level, tile.x, tile.y}) out.number(number);
    return out.bytes;
}

std::string bytesOf(const TaskRecord& record) {
    RecordWriter out;
    passRecord(out, record, record.tile.heights.values());
    return headOf(record.tile.heights.tile()) + out.bytes;
}

std::optional<TaskRecord> recordFrom(std::string_view bytes, const TileId& tile, const TileLayout& layout) {
    const std::string head = headOf(tile);
    if (bytes.substr(0, head.size()) != head) return std::nullopt;
    TaskRecord record{{HeightGrid(tile, layout), {}, {}, {}, {}}, {}};
    std::vector<double> heights;
    try {
        RecordReader in(bytes.substr(head.size()));
        passRecord(in, record, heights);
    } catch (const std::out_of_range&) {
        return std::nullopt;
    }
    if (!record.tile.heights.setValues(std::move(heights))) return std::nullopt;
    const auto posts = static_cast<std::size_t>(layout.posts());
    for (const EdgeSkirt& edge : record.tile.skirt) {
        if (edge.depth.size() != posts || edge.lean.size() != posts) return std::nullopt;
    }
    return record;
}

}  // namespace

std::string BuildState::fileOf(const TileId& tile) const {
    return _folder + "/" + startName(tile) + "/" + tileName(tile) + ".task";
}

bool BuildState::isOf(const std::string& sources) const {
    return support::contentOf(sourcesFile()) == sources;
}

void BuildState::begin(const std::string& sources) const {
    support::makeFolder(_folder);
    support::writeFile(sourcesFile(), sources);
}

std::size_t BuildState::count() const {
    std::size_t count = 0;
    std::error_code error;
    for (fs::recursive_directory_iterator entry(_folder, error), end; !error && entry != end; entry.increment(error)) {
        if (entry->path().extension() == ".task") ++count;
    }
    return count;
}

void BuildState::keep(const TaskRecord& record) const {
    const std::string file = fileOf(record.tile.heights.tile());
    support::makeFolder(fs::path(file).parent_path().string());
    support::writeFile(file, support::withChecksum(bytesOf(record)));
}

std::optional<TaskRecord> BuildState::find(const TileId& tile, const TileLayout& layout) const {
    const std::string bytes = support::contentOf(fileOf(tile));
    const auto whole = support::wholeBytes(bytes);
    return whole ? recordFrom(*whole, tile, layout) : std::nullopt;
}

}  // namespace osgbindem
