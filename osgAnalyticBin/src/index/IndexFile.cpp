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
#include <optional>
#include <ostream>
#include <string_view>
#include <utility>
#include <vector>

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

// Numbers in the byte order of the file, names of sorted lists, and checksums of what was before. A list of names ends
// with the next checksum.
class Writer {
public:
    explicit Writer(std::ostream& out) : _out(out) {}

    void bytes(std::string_view text) {
        _checksum = indexing::crc32(text, _checksum);
        _out.write(text.data(), static_cast<std::streamsize>(text.size()));
    }
    template <class... T>
    void numbers(T... values) {
        (number(values), ...);
    }
    // A name after the bytes that it shares with the one before, with numbers between.
    template <class... T>
    void name(const std::string& name, T... between) {
        const auto shared =
            std::mismatch(name.begin(), name.end(), _before.begin(), _before.end()).first - name.begin();
        const std::string_view further = std::string_view(name).substr(static_cast<std::size_t>(shared));
        numbers(static_cast<std::uint32_t>(shared), static_cast<std::uint32_t>(further.size()), between...);
        bytes(further);
        _before = name;
    }
    void checksum() {
        number(_checksum);
        _before.clear();
    }

private:
    template <class T>
    void number(T value) {
        char* const first = reinterpret_cast<char*>(&value);
        toOrFromLittleEndian(first, sizeof value);
        bytes({first, sizeof value});
    }

    std::ostream& _out;
    std::uint32_t _checksum = 0;
    std::string _before;
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
    template <class... T>
    void numbers(T&... values) {
        (number(values), ...);
    }
    template <class... T>
    std::string name(T&... between) {
        std::uint32_t shared = 0, further = 0;
        numbers(shared, further, between...);
        if (shared > (_before ? _before->size() : 0) || further > kLongestName) throw Refusal{kDamaged};
        const std::string name = (_before ? _before->substr(0, shared) : std::string()) + bytes(further);
        if (name.size() > kLongestName || (_before && name <= *_before)) throw Refusal{kDamaged};
        _before = name;
        return name;
    }
    void checksum() {
        const std::uint32_t found = _checksum;
        std::uint32_t stored = 0;
        number(stored);
        if (stored != found) throw Refusal{kDamaged};
        _before.reset();
    }
    [[nodiscard]] bool isAtEnd() { return _in.peek() == std::istream::traits_type::eof(); }

private:
    template <class T>
    void number(T& value) {
        char* const first = reinterpret_cast<char*>(&value);
        read(first, sizeof value);
        toOrFromLittleEndian(first, sizeof value);
    }
    void read(char* to, std::size_t count) {
        _in.read(to, static_cast<std::streamsize>(count));
        if (static_cast<std::size_t>(_in.gcount()) != count) throw Refusal{kTruncated};
        _checksum = indexing::crc32({to, count}, _checksum);
    }

    std::istream& _in;
    std::uint32_t _checksum = 0;
    std::optional<std::string> _before;
};

// A tile as it is in the file.
struct TileNumbers {
    double south = 0.0, north = 0.0, west = 0.0, east = 0.0;
    float low = 0.0f, high = 0.0f, margin = 0.0f, sag = 0.0f, ownLow = 0.0f;
    std::uint32_t flags = 0;
    std::uint64_t fingerprint = 0;

    // Writes or reads them.
    template <class Stream>
    void pass(Stream& s) {
        s.numbers(south, north, west, east, low, high, margin, sag, ownLow, flags, fingerprint);
    }
};

TileNumbers numbersOf(const BinIndex::Entry& tile) {
    TileNumbers n;
    n.ownLow = static_cast<float>(tile.ownLow);
    n.fingerprint = tile.fingerprint;
    // an empty bin has infinite bounds
    if (!tile.bin.valid()) return n;
    const core::GeodeticBin& bin = tile.bin.bin();
    n.south = bin.latitude().lower, n.north = bin.latitude().upper;
    n.west = bin.longitude().lower, n.east = bin.longitude().upper;
    n.low = static_cast<float>(bin.altitude().lower), n.high = static_cast<float>(bin.altitude().upper);
    n.margin = static_cast<float>(tile.bin.margin()), n.sag = static_cast<float>(tile.bin.sag());
    n.flags = kValid;
    return n;
}

BinIndex::Entry entryFrom(const TileNumbers& n) {
    BinIndex::Entry tile;
    tile.ownLow = static_cast<double>(n.ownLow);
    tile.fingerprint = n.fingerprint;
    if (!std::isfinite(n.ownLow) || (n.flags & ~kValid) != 0) throw Refusal{kDamaged};
    if (n.flags == 0) return tile;
    const core::Interval altitude{static_cast<double>(n.low), static_cast<double>(n.high)};
    const core::GeodeticBin bin({n.south, n.north}, {n.west, n.east}, altitude);
    const bool isRight = !bin.empty() && std::isfinite(n.margin) && std::isfinite(n.sag) && n.margin >= 0.0f &&
                         n.sag >= 0.0f && std::abs(n.west) <= kMostLongitude && std::abs(n.east) <= kMostLongitude;
    if (!isRight) throw Refusal{kDamaged};
    tile.bin = AnalyticBin(bin, static_cast<double>(n.margin));
    tile.bin.setSag(static_cast<double>(n.sag));
    return tile;
}

void requireMagic(Reader& in) {
    for (const char byte : BinIndex::kMagic) {
        if (in.bytes(1).front() != byte) throw Refusal{"is another kind of file"};
    }
}

BinIndex::Stamps readStamps(Reader& in) {
    BinIndex::Stamps stamps;
    std::uint64_t files = 0;
    in.numbers(files);
    for (std::uint64_t i = 0; i < files; ++i) {
        BinIndex::Stamp& stamp = stamps[in.name()];
        in.numbers(stamp.size, stamp.time, stamp.nanoseconds);
    }
    if (stamps.empty()) throw Refusal{kDamaged};
    return stamps;
}

osg::ref_ptr<BinIndex> readIndex(std::istream& stream) {
    Reader in(stream);
    requireMagic(in);
    std::uint32_t version = 0, nameBytes = 0;
    in.numbers(version);
    if (version != kVersion) throw Refusal{"is of another version than this program reads"};
    in.numbers(nameBytes);
    if (nameBytes > kLongestName) throw Refusal{kDamaged};
    BinIndex::Source source;
    std::uint64_t files = 0, tiles = 0, sum = 0;
    in.numbers(source.size, source.time, files, tiles);
    source.name = in.bytes(nameBytes);
    std::vector<std::pair<std::string, std::uint32_t>> counts;  // of the tiles of each file
    for (std::uint64_t i = 0; i < files; ++i) {
        std::uint32_t count = 0;
        std::string name = in.name(count);
        counts.emplace_back(std::move(name), count);
        sum += count;
    }
    if (sum != tiles) throw Refusal{kDamaged};

    osg::ref_ptr<BinIndex> index = new BinIndex;
    index->setSource(source);
    for (const auto& [name, count] : counts) {
        std::vector<BinIndex::Entry> entries;
        for (std::uint32_t i = 0; i < count; ++i) {
            TileNumbers numbers;
            numbers.pass(in);
            entries.push_back(entryFrom(numbers));
        }
        index->setTiles(name, std::move(entries));
    }
    in.checksum();
    if (in.isAtEnd()) return index;
    index->setStamps(readStamps(in));
    in.checksum();
    if (!in.isAtEnd()) throw Refusal{"goes on after its end"};
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
    out.numbers(kVersion, static_cast<std::uint32_t>(_source.name.size()), _source.size, _source.time,
                std::uint64_t{fileCount()}, std::uint64_t{tileCount()});
    out.bytes(_source.name);
    for (const auto& [name, tiles] : _files) out.name(name, static_cast<std::uint32_t>(tiles.size()));
    for (const auto& file : _files) {
        for (const Entry& tile : file.second) numbersOf(tile).pass(out);
    }
    out.checksum();
    if (!_stamps.empty()) {
        out.numbers(std::uint64_t{_stamps.size()});
        for (const auto& [name, stamp] : _stamps) {
            out.name(name);
            out.numbers(stamp.size, stamp.time, stamp.nanoseconds);
        }
        out.checksum();
    }
    return static_cast<bool>(stream);
}

bool BinIndex::write(const std::string& path, std::string& error) const {
    return writeWholeFile(
        path, [this](std::ostream& out) { return write(out); }, error);
}

}  // namespace osgAnalyticBin
