// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PartFile.h"

#include "Checksum.h"
#include "Failure.h"
#include "RecordStream.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace osgbinconv {

using osgAnalyticBin::support::Failure;

namespace {

// Of one file's record; more is damage.
constexpr std::uint32_t kMostBytes = std::uint32_t{1} << 28;

constexpr const char* kHead = "osgBinsPart 5\n";

/// One description of the bytes for both directions.
template <class Stream, class Surface>
void passSurface(Stream& s, Surface& surface) {
    s.bin(surface.bin);
    for (auto& low : surface.edgeLow) s.number(low);
    s.number(surface.skirt);
    s.flag(surface.isEmpty);
    s.flag(surface.isScalable);
    s.flag(surface.isInMap);
}

template <class Stream, class Tile>
void passTile(Stream& s, Tile& tile) {
    passSurface(s, tile.surface);
    s.number(tile.fingerprint);
    s.number(tile.parent);
}

template <class Stream, class Place>
void passPlace(Stream& s, Place& place) {
    s.number(place.equatorialRadius);
    s.number(place.polarRadius);
    s.flag(place.isProjected);
    for (auto& number : place.localToEcef) s.number(number);
    s.flag(place.isBelowTile);
    s.number(place.sampleRatio);
}

template <class Stream, class Link>
void passLink(Stream& s, Link& link) {
    s.text(link.file);
    s.number(link.tile);
    passPlace(s, link.place);
}

template <class Stream, class Record>
void passRecord(Stream& s, Record& record) {
    s.text(record.file);
    s.number(record.stamp.size);
    s.number(record.stamp.time);
    s.number(record.stamp.nanoseconds);
    passPlace(s, record.place);
    s.flag(record.isRead);
    s.flag(record.hasOtherContent);
    s.count(record.tiles);
    for (auto& tile : record.tiles) passTile(s, tile);
    passSurface(s, record.beside);
    s.count(record.links);
    for (auto& link : record.links) passLink(s, link);
}

bool isConsistent(const FileRecord& record) {
    const auto tiles = static_cast<std::int32_t>(record.tiles.size());
    for (std::int32_t i = 0; i < tiles; ++i) {
        const std::int32_t parent = record.tiles[static_cast<std::size_t>(i)].parent;
        if (parent < -1 || parent >= i) return false;
    }
    for (const FileLink& link : record.links) {
        if (link.tile < -1 || link.tile >= tiles) return false;
    }
    return true;
}

/// A record as bytes, little endian, bit for bit the same when read back.
std::string bytesOf(const FileRecord& record) {
    osgAnalyticBin::RecordWriter writer;
    passRecord(writer, record);
    return std::move(writer.bytes);
}

/// Returns: nullopt when the bytes are no record.
std::optional<FileRecord> recordFrom(std::string_view bytes) {
    try {
        osgAnalyticBin::RecordReader reader(bytes);
        FileRecord record;
        passRecord(reader, record);
        if (reader.isAtEnd() && isConsistent(record)) return record;
    } catch (const std::out_of_range&) {
    }
    return std::nullopt;
}

// Returns: false at the end of what is there.
bool readBytes(std::istream& in, std::string& bytes) {
    return static_cast<bool>(in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())));
}

/// Returns: nullopt at the end of what is whole.
std::optional<FileRecord> readRecord(std::istream& in, std::uint64_t most) {
    std::uint32_t size = 0;
    std::string bytes(sizeof size, '\0');
    if (!readBytes(in, bytes)) return std::nullopt;
    osgAnalyticBin::RecordReader(bytes).number(size);
    if (size > most || size > kMostBytes) return std::nullopt;
    bytes.resize(size);
    if (!readBytes(in, bytes)) return std::nullopt;
    const auto whole = osgAnalyticBin::support::wholeBytes(bytes);
    return whole ? recordFrom(*whole) : std::nullopt;
}

}  // namespace

PartFile::PartFile(const std::string& path) : _path(path), _lock(path, "osgbinconv", path, O_APPEND) {
    load();
}

void PartFile::load() {
    const off_t end = ::lseek(_lock.handle(), 0, SEEK_END);
    std::ifstream in(_path, std::ios::binary);
    std::string found(std::strlen(kHead), '\0');
    in.read(found.data(), static_cast<std::streamsize>(found.size()));
    if (!in || found != kHead) return clear();
    off_t whole = in.tellg();
    while (auto record = readRecord(in, static_cast<std::uint64_t>(end - whole))) {
        _records.push_back(std::move(*record));
        whole = in.tellg();
    }
    if (::ftruncate(_lock.handle(), whole) != 0) fail();
}

void PartFile::append(const FileRecord& record) {
    osgAnalyticBin::RecordWriter out;
    out.text(osgAnalyticBin::support::withChecksum(bytesOf(record)));
    write(out.bytes);
}

void PartFile::clear() {
    if (::ftruncate(_lock.handle(), 0) != 0) fail();
    write(kHead);
}

void PartFile::keepOnly(const std::map<std::string, FileRecord>& records) {
    clear();
    for (const auto& record : records) append(record.second);
}

void PartFile::remove() {
    _lock.remove();
}

void PartFile::write(const std::string& bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t count = ::write(_lock.handle(), bytes.data() + done, bytes.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) fail();
        done += static_cast<std::size_t>(count);
    }
}

void PartFile::fail() {
    _hasFailed = true;
    throw Failure("cannot write \"" + _path + "\": " + std::strerror(errno) +
                  "; make room, or make the folder writable");
}

}  // namespace osgbinconv
