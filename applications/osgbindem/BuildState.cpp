// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BuildState.h"

#include "Failure.h"
#include "NodeFile.h"
#include "TileFiles.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

namespace osgbindem {

using osgAnalyticBin::AnalyticBin;
using osgAnalyticBin::core::Interval;
using osgAnalyticBin::support::Failure;

namespace fs = std::filesystem;

namespace {

// Records are read where they were written, or on a machine of the same kind: numbers are stored as memory has them.
constexpr std::uint64_t kMagic = 0x6F73676254736B31U;

class Writer {
public:
    template <class Number>
    void add(Number number) {
        static_assert(std::is_arithmetic_v<Number>);
        _bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    void add(const std::vector<double>& numbers) {
        add(static_cast<std::uint64_t>(numbers.size()));
        for (const double number : numbers) add(number);
    }
    void add(const Interval& interval) {
        add(interval.lower);
        add(interval.upper);
    }
    std::string takeBytes() { return std::move(_bytes); }

private:
    std::string _bytes;
};

/// Requires: the checksum was right, so that what is read was written.
class Reader {
public:
    explicit Reader(std::string_view bytes) : _bytes(bytes) {}

    template <class Number>
    Number take() {
        Number number{};
        if (_bytes.size() >= sizeof number) {
            std::memcpy(&number, _bytes.data(), sizeof number);
            _bytes.remove_prefix(sizeof number);
        }
        return number;
    }
    std::vector<double> takeAll() {
        std::vector<double> numbers(std::min<std::uint64_t>(take<std::uint64_t>(), _bytes.size() / sizeof(double)));
        for (double& number : numbers) number = take<double>();
        return numbers;
    }
    Interval takeInterval() {
        const auto lower = take<double>();
        return {lower, take<double>()};
    }

private:
    std::string_view _bytes;
};

void addBin(const AnalyticBin& bin, Writer& out) {
    out.add(bin.valid() ? 1 : 0);
    out.add(bin.bin().latitude());
    out.add(bin.bin().longitude());
    out.add(bin.bin().altitude());
    out.add(bin.margin());
    out.add(bin.sag());
}

AnalyticBin takeBin(Reader& in) {
    const bool isValid = in.take<int>() != 0;
    const Interval latitude = in.takeInterval();
    const Interval longitude = in.takeInterval();
    const Interval altitude = in.takeInterval();
    const auto margin = in.take<double>();
    const auto sag = in.take<double>();
    if (!isValid) return {};
    AnalyticBin bin(osgAnalyticBin::core::GeodeticBin(latitude, longitude, altitude), margin);
    bin.setSag(sag);
    return bin;
}

void addTileId(const TileId& tile, Writer& out) {
    out.add(tile.level);
    out.add(tile.x);
    out.add(tile.y);
}

TileId takeTileId(Reader& in) {
    const int level = in.take<int>();
    const int x = in.take<int>();
    return {level, x, in.take<int>()};
}

std::string bytesOf(const TaskRecord& record) {
    Writer out;
    out.add(kMagic);
    addTileId(record.tile.heights.tile(), out);
    out.add(record.files.files);
    out.add(record.files.bytes);
    out.add(record.files.checksum);
    out.add(record.tile.range.lower);
    out.add(record.tile.range.upper);
    addBin(record.tile.below, out);
    out.add(record.tile.heights.values());
    for (const EdgeSkirt& edge : record.tile.skirt) {
        out.add(edge.depth);
        out.add(edge.lean);
    }
    return out.takeBytes();
}

std::optional<TaskRecord> recordFrom(std::string_view bytes, const TileId& tile, const TileLayout& layout) {
    Reader in(bytes);
    if (in.take<std::uint64_t>() != kMagic || !(takeTileId(in) == tile)) return std::nullopt;
    TaskRecord record{{HeightGrid(tile, layout), {}, {}, {}}, {}};
    record.files.files = in.take<std::uint64_t>();
    record.files.bytes = in.take<std::uint64_t>();
    record.files.checksum = in.take<std::uint64_t>();
    record.tile.range.lower = in.take<double>();
    record.tile.range.upper = in.take<double>();
    record.tile.below = takeBin(in);
    if (!record.tile.heights.setValues(in.takeAll())) return std::nullopt;
    for (EdgeSkirt& edge : record.tile.skirt) {
        edge.depth = in.takeAll();
        edge.lean = in.takeAll();
        const auto posts = static_cast<std::size_t>(layout.posts());
        if (edge.depth.size() != posts || edge.lean.size() != posts) return std::nullopt;
    }
    return record;
}

std::string content(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void createFolder(const std::string& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw Failure("cannot create \"" + folder + "\": " + error.message() + "; choose another folder");
}

}  // namespace

std::string BuildState::fileOf(const TileId& tile) const {
    return _folder + "/" + startName(tile) + "/" + tileName(tile) + ".task";
}

bool BuildState::isOf(const std::string& sources) const {
    return content(sourcesFile()) == sources;
}

void BuildState::begin(const std::string& sources) const {
    createFolder(_folder);
    writeFile(sourcesFile(), sources);
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
    createFolder(fs::path(file).parent_path().string());
    const std::string bytes = bytesOf(record);
    const std::uint64_t checksum = checksumOf(bytes);
    writeFile(file, bytes + std::string(reinterpret_cast<const char*>(&checksum), sizeof checksum));
}

std::optional<TaskRecord> BuildState::find(const TileId& tile, const TileLayout& layout) const {
    const std::string bytes = content(fileOf(tile));
    std::uint64_t checksum = 0;
    if (bytes.size() < sizeof checksum) return std::nullopt;
    const std::string_view body = std::string_view(bytes).substr(0, bytes.size() - sizeof checksum);
    std::memcpy(&checksum, bytes.data() + body.size(), sizeof checksum);
    return checksum == checksumOf(body) ? recordFrom(body, tile, layout) : std::nullopt;
}

}  // namespace osgbindem
