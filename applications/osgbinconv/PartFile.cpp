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
#include <unistd.h>
#include <utility>

namespace osgbinconv {

using osgAnalyticBin::support::Failure;

namespace {

// To be raised when a record's members change.
constexpr const char* kHead = "osgBinsPart 5\n";

/// One description of the bytes for both directions.
template <class Stream, class Record>
void passRecord(Stream& s, Record& record) {
    s.list(record.file);
    s.value(record.stamp);
    s.value(record.place);
    s.value(record.isRead);
    s.value(record.hasOtherContent);
    s.list(record.tiles);
    s.count(record.links);
    for (auto& link : record.links) {
        s.list(link.file);
        s.value(link.tile);
        s.value(link.place);
    }
}

/// Returns: nullopt at the end of what is whole.
std::optional<FileRecord> readRecord(std::istream& in, std::uint64_t most) {
    std::uint32_t size = 0;
    if (!in.read(reinterpret_cast<char*>(&size), sizeof size) || size > most) return std::nullopt;
    std::string bytes(size, '\0');
    if (!in.read(bytes.data(), size)) return std::nullopt;
    const auto whole = osgAnalyticBin::support::wholeBytes(bytes);
    if (!whole) return std::nullopt;
    try {
        FileRecord record;
        osgAnalyticBin::RecordReader reader(*whole);
        passRecord(reader, record);
        if (reader.isAtEnd()) return record;
    } catch (const std::out_of_range&) {
    }
    return std::nullopt;
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
    osgAnalyticBin::RecordWriter writer, out;
    passRecord(writer, record);
    out.list(osgAnalyticBin::support::withChecksum(std::move(writer.bytes)));
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
