// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The file of a BinIndex, little endian throughout:
//   "\x89osgBins"  u32 version  u32 bytes of the database's name
//   u64 bytes of the root file  i64 its time  u64 number of files  u64 number of tiles  the database's name
//   for each file, in order of their names: u32 bytes shared with the name before  u32 further bytes  u32 tiles  these
//   bytes for each tile, in order of the files: 4 doubles south north west east (radians)  5 floats low high margin sag
//   own-low (metres)  u32 flags (1: the bin is valid)  u64 fingerprint u32 CRC-32 of everything before
// and, where the index has stamps: u64 number of files  for each, in order of their names: its name as above, u64 bytes
//   i64 time  i64 nanoseconds  u32 CRC-32 of everything before

#include "../kit/WholeFile.h"
#include "Checksum.h"

#include <osgAnalyticBin/BinIndex.h>

#include <osg/Endian>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <istream>
#include <ostream>
#include <string_view>

namespace osgAnalyticBin {

namespace {

// Bins of version 1 held those parts of skirts that cracks can show.
constexpr std::uint32_t kVersion = 2;
constexpr std::uint32_t kValid = 1;
constexpr std::uint32_t kLongestName = 4096;
// Largest allocation at once, so that a wrong size fails at the end of the stream and not by lack of memory.
constexpr std::size_t kChunk = std::size_t{1} << 16;
constexpr double kMostLongitude = 12.6;  // two turns

constexpr const char* kTruncated = "ends too early";
constexpr const char* kDamaged = "is damaged";

// Thrown and caught in this file only.
struct Refusal {
    const char* why;
};

void toOrFromLittleEndian(char* number, std::size_t bytes) {
    if (osg::getCpuByteOrder() == osg::BigEndian) osg::swapBytes(number, static_cast<unsigned int>(bytes));
}

class Writer {
public:
    explicit Writer(std::ostream& out) : _out(out) {}

    void bytes(std::string_view text) {
        _checksum = indexing::crc32(text, _checksum);
        _out.write(text.data(), static_cast<std::streamsize>(text.size()));
    }
    template <class T>
    void number(T value) {
        char* const first = reinterpret_cast<char*>(&value);
        toOrFromLittleEndian(first, sizeof value);
        bytes({first, sizeof value});
    }
    void metres(double value) { number(static_cast<float>(value)); }
    [[nodiscard]] std::uint32_t checksum() const { return _checksum; }

private:
    std::ostream& _out;
    std::uint32_t _checksum = 0;
};

class Reader {
public:
    explicit Reader(std::istream& in) : _in(in) {}

    std::string bytes(std::size_t count) {
        std::string text;
        while (text.size() < count) {
            const std::size_t done = text.size();
            text.resize(done + std::min(count - done, kChunk));
            read(text.data() + done, text.size() - done);
        }
        return text;
    }
    template <class T>
    T number() {
        T value{};
        char* const first = reinterpret_cast<char*>(&value);
        read(first, sizeof value);
        toOrFromLittleEndian(first, sizeof value);
        return value;
    }
    double metres() { return static_cast<double>(number<float>()); }
    [[nodiscard]] std::uint32_t checksum() const { return _checksum; }

private:
    void read(char* to, std::size_t count) {
        _in.read(to, static_cast<std::streamsize>(count));
        if (static_cast<std::size_t>(_in.gcount()) != count) throw Refusal{kTruncated};
        _checksum = indexing::crc32({to, count}, _checksum);
    }

    std::istream& _in;
    std::uint32_t _checksum = 0;
};

void writeTile(Writer& out, const BinIndex::Entry& tile) {
    const bool isValid = tile.bin.valid();
    // an empty bin has infinite bounds
    const core::GeodeticBin bin = isValid ? tile.bin.bin() : core::GeodeticBin({0, 0}, {0, 0}, {0, 0});
    for (const core::Interval& angles : {bin.latitude(), bin.longitude()}) {
        out.number(angles.lower);
        out.number(angles.upper);
    }
    out.metres(bin.altitude().lower);
    out.metres(bin.altitude().upper);
    out.metres(isValid ? tile.bin.margin() : 0.0);
    out.metres(isValid ? tile.bin.sag() : 0.0);
    out.metres(tile.ownLow);
    out.number(isValid ? kValid : 0u);
    out.number(tile.fingerprint);
}

core::Interval readAngles(Reader& in) {
    const auto lower = in.number<double>();
    const auto upper = in.number<double>();
    return {lower, upper};
}

AnalyticBin checkedBin(const core::GeodeticBin& bin, double margin, double sag, const core::Interval& longitude) {
    const bool isRight = !bin.empty() && std::isfinite(margin) && std::isfinite(sag) && margin >= 0.0 && sag >= 0.0 &&
                         std::abs(longitude.lower) <= kMostLongitude && std::abs(longitude.upper) <= kMostLongitude;
    if (!isRight) throw Refusal{kDamaged};
    AnalyticBin result(bin, margin);
    result.setSag(sag);
    return result;
}

BinIndex::Entry readTile(Reader& in) {
    const core::Interval latitude = readAngles(in);
    const core::Interval longitude = readAngles(in);
    const double low = in.metres();
    const double high = in.metres();
    const double margin = in.metres();
    const double sag = in.metres();
    BinIndex::Entry tile;
    tile.ownLow = in.metres();
    const auto flags = in.number<std::uint32_t>();
    tile.fingerprint = in.number<std::uint64_t>();
    if (!std::isfinite(tile.ownLow) || (flags & ~kValid) != 0) throw Refusal{kDamaged};
    if (flags & kValid) {
        tile.bin = checkedBin(core::GeodeticBin(latitude, longitude, {low, high}), margin, sag, longitude);
    }
    return tile;
}

std::size_t sharedBytes(const std::string& a, const std::string& b) {
    const auto ends =
        std::mismatch(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(std::min(a.size(), b.size())), b.begin());
    return static_cast<std::size_t>(ends.first - a.begin());
}

// Of a sorted list of names: a name, after the bytes that it shares with the one before. `tiles`: a number between.
void writeName(Writer& out, const std::string& before, const std::string& name, const std::uint32_t* tiles = nullptr) {
    const std::size_t shared = sharedBytes(before, name);
    out.number(static_cast<std::uint32_t>(shared));
    out.number(static_cast<std::uint32_t>(name.size() - shared));
    if (tiles) out.number(*tiles);
    out.bytes(std::string_view(name).substr(shared));
}

// `before`: null for the first name.
std::string readName(Reader& in, const std::string* before, std::uint32_t* tiles = nullptr) {
    const auto shared = in.number<std::uint32_t>();
    const auto further = in.number<std::uint32_t>();
    if (tiles) *tiles = in.number<std::uint32_t>();
    if (shared > (before ? before->size() : 0) || further > kLongestName) throw Refusal{kDamaged};
    std::string name = before ? before->substr(0, shared) : std::string();
    name += in.bytes(further);
    if (name.size() > kLongestName || (before && name <= *before)) throw Refusal{kDamaged};
    return name;
}

void writeStamps(Writer& out, const BinIndex::Stamps& stamps) {
    out.number(static_cast<std::uint64_t>(stamps.size()));
    std::string before;
    for (const auto& [name, stamp] : stamps) {
        writeName(out, before, name);
        out.number(stamp.size);
        out.number(stamp.time);
        out.number(stamp.nanoseconds);
        before = name;
    }
    out.number(out.checksum());
}

BinIndex::Stamps readStamps(Reader& in) {
    BinIndex::Stamps stamps;
    const auto files = in.number<std::uint64_t>();
    for (std::uint64_t i = 0; i < files; ++i) {
        const std::string name = readName(in, stamps.empty() ? nullptr : &stamps.rbegin()->first);
        BinIndex::Stamp stamp;
        stamp.size = in.number<std::uint64_t>();
        stamp.time = in.number<std::int64_t>();
        stamp.nanoseconds = in.number<std::int64_t>();
        stamps.emplace_hint(stamps.end(), name, stamp);
    }
    return stamps;
}

void requireChecksum(Reader& in) {
    const std::uint32_t checksum = in.checksum();
    if (in.number<std::uint32_t>() != checksum) throw Refusal{kDamaged};
}

// The files with the numbers of their tiles.
using FileHeads = std::vector<std::pair<std::string, std::uint32_t>>;

FileHeads readFileHeads(Reader& in, std::uint64_t files, std::uint64_t tiles) {
    FileHeads heads;
    std::uint64_t sum = 0;
    for (std::uint64_t i = 0; i < files; ++i) {
        std::uint32_t count = 0;
        std::string name = readName(in, heads.empty() ? nullptr : &heads.back().first, &count);
        heads.emplace_back(std::move(name), count);
        sum += count;
    }
    if (sum != tiles) throw Refusal{kDamaged};
    return heads;
}

void requireMagic(Reader& in) {
    for (const char byte : BinIndex::kMagic) {
        if (static_cast<char>(in.number<std::uint8_t>()) != byte) throw Refusal{"is another kind of file"};
    }
}

osg::ref_ptr<BinIndex> readIndex(std::istream& stream) {
    Reader in(stream);
    requireMagic(in);
    if (in.number<std::uint32_t>() != kVersion) throw Refusal{"is of another version than this program reads"};
    const auto nameBytes = in.number<std::uint32_t>();
    if (nameBytes > kLongestName) throw Refusal{kDamaged};
    BinIndex::Source source;
    source.size = in.number<std::uint64_t>();
    source.time = in.number<std::int64_t>();
    const auto files = in.number<std::uint64_t>();
    const auto tiles = in.number<std::uint64_t>();
    source.name = in.bytes(nameBytes);

    osg::ref_ptr<BinIndex> index = new BinIndex;
    index->setSource(source);
    for (const auto& [name, count] : readFileHeads(in, files, tiles)) {
        std::vector<BinIndex::Entry> entries;
        for (std::uint32_t i = 0; i < count; ++i) entries.push_back(readTile(in));
        index->setTiles(name, std::move(entries));
    }
    requireChecksum(in);
    if (stream.peek() == std::istream::traits_type::eof()) return index;
    index->setStamps(readStamps(in));
    requireChecksum(in);
    if (index->stamps().empty()) throw Refusal{kDamaged};
    if (stream.peek() != std::istream::traits_type::eof()) throw Refusal{"goes on after its end"};
    return index;
}

}  // namespace

osg::ref_ptr<BinIndex> BinIndex::read(std::istream& in, std::string& error) {
    error.clear();
    try {
        return readIndex(in);
    } catch (const Refusal& refusal) {
        error = std::string("the index of bins ") + refusal.why + "; make it again with osgbinconv --index";
    } catch (const std::exception& failure) {
        error = std::string("the index of bins cannot be read: ") + failure.what();
    }
    return nullptr;
}

osg::ref_ptr<BinIndex> BinIndex::read(const std::string& path, std::string& error) {
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    if (!in) {
        error = "cannot read \"" + path + "\": " + std::strerror(errno);
        return nullptr;
    }
    osg::ref_ptr<BinIndex> index = read(in, error);
    if (!index) error = "\"" + path + "\": " + error;
    return index;
}

bool BinIndex::write(std::ostream& stream) const {
    Writer out(stream);
    out.bytes(BinIndex::kMagic);
    out.number(kVersion);
    out.number(static_cast<std::uint32_t>(_source.name.size()));
    out.number(_source.size);
    out.number(_source.time);
    out.number(static_cast<std::uint64_t>(fileCount()));
    out.number(static_cast<std::uint64_t>(tileCount()));
    out.bytes(_source.name);
    std::string before;
    for (const auto& [name, tiles] : _files) {
        const auto count = static_cast<std::uint32_t>(tiles.size());
        writeName(out, before, name, &count);
        before = name;
    }
    for (const auto& file : _files) {
        for (const Entry& tile : file.second) writeTile(out, tile);
    }
    out.number(out.checksum());
    if (!_stamps.empty()) writeStamps(out, _stamps);
    return static_cast<bool>(stream);
}

bool BinIndex::write(const std::string& path, std::string& error) const {
    return writeWholeFile(
        path, [this](std::ostream& out) { return write(out); }, error);
}

}  // namespace osgAnalyticBin
