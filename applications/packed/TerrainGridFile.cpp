// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TerrainGrid.h"

#include <algorithm>
#include <cstring>

namespace osgAnalyticBin {

namespace {

constexpr std::uint8_t kVersion = 2;
constexpr std::int64_t kMostCells = 240;  // whose vertices 16 bits can count
constexpr std::int64_t kMostColumns = std::int64_t{1} << 40;
constexpr std::int64_t kMostSteps = std::int64_t{1} << 30;
constexpr std::int64_t kMostStops = 64;
constexpr std::int64_t kMostTexels = 65536;

// Little-endian, whole numbers in groups of seven bits with the sign in the lowest.
class Writer {
public:
    void byte(std::uint8_t value) { _bytes.push_back(static_cast<char>(value)); }
    void whole(std::int64_t value) {
        auto rest = (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
        for (; rest >= 0x80; rest >>= 7) byte(static_cast<std::uint8_t>(rest | 0x80));
        byte(static_cast<std::uint8_t>(rest));
    }
    void real(double value) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        for (int i = 0; i < 8; ++i) byte(static_cast<std::uint8_t>(bits >> (8 * i)));
    }
    [[nodiscard]] std::string take() { return std::move(_bytes); }

private:
    std::string _bytes;
};

// Past the end it reads zeros and remembers that it did.
class Reader {
public:
    explicit Reader(const std::string& bytes) : _bytes(bytes) {}

    std::uint8_t byte() {
        if (_next < _bytes.size()) return static_cast<std::uint8_t>(_bytes[_next++]);
        _isGood = false;
        return 0;
    }
    std::int64_t whole(std::int64_t least, std::int64_t most) {
        std::uint64_t rest = 0;
        for (int shift = 0; shift < 64; shift += 7) {
            const std::uint8_t group = byte();
            rest |= static_cast<std::uint64_t>(group & 0x7F) << shift;
            if (group < 0x80) break;
        }
        const auto value = static_cast<std::int64_t>(rest >> 1) ^ -static_cast<std::int64_t>(rest & 1);
        _isGood = _isGood && value >= least && value <= most;
        return std::clamp(value, least, most);
    }
    double real(double least, double most) {
        std::uint64_t bits = 0;
        for (int i = 0; i < 8; ++i) bits |= static_cast<std::uint64_t>(byte()) << (8 * i);
        double value = 0.0;
        std::memcpy(&value, &bits, sizeof value);
        if (value >= least && value <= most) return value;
        _isGood = false;
        return least;
    }
    [[nodiscard]] bool isGood() const { return _isGood; }
    [[nodiscard]] bool isAtEnd() const { return _next == _bytes.size(); }

private:
    const std::string& _bytes;
    std::size_t _next = 0;
    bool _isGood = true;
};

// A plane through the three neighbours that are known already.
std::int64_t foretold(const std::vector<std::int32_t>& heights, std::size_t width, std::size_t i) {
    const bool hasWest = i % width != 0;
    const bool hasSouth = i >= width;
    if (hasWest && hasSouth) return std::int64_t{heights[i - 1]} + heights[i - width] - heights[i - width - 1];
    return hasWest ? heights[i - 1] : hasSouth ? heights[i - width] : 0;
}

void write(Writer& writer, const std::vector<std::int32_t>& values) {
    std::int64_t last = 0;
    for (const std::int64_t value : values) {
        writer.whole(value - last);
        last = value;
    }
}

std::vector<std::int32_t> read(Reader& reader, std::size_t count) {
    std::vector<std::int32_t> values;
    std::int64_t last = 0;
    for (std::size_t i = 0; i < count && reader.isGood(); ++i) {
        last = std::clamp(last + reader.whole(-kMostSteps, kMostSteps), std::int64_t{0}, kMostSteps);
        values.push_back(static_cast<std::int32_t>(last));
    }
    return values;
}

void writeHead(Writer& writer, const TerrainGrid& grid) {
    writer.byte(kVersion);
    writer.byte(grid.relief ? 1 : 0);
    writer.real(grid.ellipsoid.equatorialRadius());
    writer.real(grid.ellipsoid.polarRadius());
    writer.whole(grid.cells);
    writer.whole(grid.columns);
    writer.whole(grid.firstColumn);
    writer.whole(grid.firstRow);
    writer.real(grid.quantum);
    for (int axis = 0; axis < 3; ++axis) writer.real(grid.origin[axis]);
    writer.whole(grid.textureSize);
    writer.whole(static_cast<std::int64_t>(grid.colours.size()));
    for (const TerrainGrid::ColourStop& stop : grid.colours) {
        writer.real(stop.height);
        for (const std::uint8_t part : stop.colour) writer.byte(part);
    }
}

TerrainGrid readHead(Reader& reader) {
    constexpr double kLeastRadius = 1e-3;
    constexpr double kMostRadius = 1e12;
    constexpr double kMostFlat = 100.0;  // one radius over the other; beyond, the poles have no finite place
    constexpr double kLeastQuantum = 1e-9;
    TerrainGrid grid;
    grid.relief = reader.byte() != 0;
    const double equatorial = reader.real(kLeastRadius, kMostRadius);
    const double polar = reader.real(equatorial / kMostFlat, equatorial * kMostFlat);
    grid.ellipsoid = core::Ellipsoid(equatorial, polar);
    grid.cells = static_cast<std::int32_t>(reader.whole(1, kMostCells));
    grid.columns = reader.whole(2, kMostColumns);
    grid.firstColumn = reader.whole(0, kMostColumns);
    grid.firstRow = reader.whole(0, kMostColumns);
    grid.quantum = reader.real(kLeastQuantum, kMostRadius);
    for (int axis = 0; axis < 3; ++axis) grid.origin[axis] = reader.real(-kMostRadius, kMostRadius);
    grid.textureSize = static_cast<std::int32_t>(reader.whole(0, kMostTexels));
    grid.colours.resize(static_cast<std::size_t>(reader.whole(0, kMostStops)));
    for (TerrainGrid::ColourStop& stop : grid.colours) {
        stop.height = static_cast<float>(reader.real(-1e9, 1e9));
        for (std::uint8_t& part : stop.colour) part = reader.byte();
    }
    return grid;
}

bool rises(const std::vector<TerrainGrid::ColourStop>& stops) {
    return std::adjacent_find(stops.begin(), stops.end(),
                              [](const auto& a, const auto& b) { return !(a.height < b.height); }) == stops.end();
}

}  // namespace

std::string packed(const TerrainGrid& grid) {
    Writer writer;
    writeHead(writer, grid);
    const auto width = static_cast<std::size_t>(grid.cells + 3);
    for (std::size_t i = 0; i < grid.heights.size(); ++i)
        writer.whole(grid.heights[i] - foretold(grid.heights, width, i));
    for (const TerrainGrid::Skirt& skirt : grid.skirts) {
        write(writer, skirt.depth);
        write(writer, skirt.lean);
    }
    return writer.take();
}

std::optional<TerrainGrid> unpacked(const std::string& bytes) {
    Reader reader(bytes);
    if (reader.byte() != kVersion) return std::nullopt;
    TerrainGrid grid = readHead(reader);
    if (!reader.isGood() || !rises(grid.colours)) return std::nullopt;
    const auto width = static_cast<std::size_t>(grid.cells + 3);
    grid.heights.reserve(width * width);
    for (std::size_t i = 0; i < width * width && reader.isGood(); ++i) {
        const std::int64_t height = foretold(grid.heights, width, i) + reader.whole(-4 * kMostSteps, 4 * kMostSteps);
        if (height < -kMostSteps || height > kMostSteps) return std::nullopt;
        grid.heights.push_back(static_cast<std::int32_t>(height));
    }
    for (TerrainGrid::Skirt& skirt : grid.skirts) {
        skirt.depth = read(reader, width - 2);
        skirt.lean = read(reader, width - 2);
    }
    if (!reader.isGood() || !reader.isAtEnd()) return std::nullopt;
    return grid;
}

}  // namespace osgAnalyticBin
