// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PartFile.h"

#include "DiskFile.h"
#include "Failure.h"
#include "RecordBytes.h"

#include <boost/crc.hpp>
#include <boost/endian/conversion.hpp>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <unistd.h>

namespace osgbinconv {

using osgAnalyticBin::support::Failure;

namespace {

constexpr std::size_t kNumberBytes = 4;
// Of one file's record; more is damage.
constexpr std::uint32_t kMostBytes = std::uint32_t{1} << 28;

std::string numberBytes(std::uint32_t number) {
    unsigned char bytes[kNumberBytes];
    boost::endian::store_little_u32(bytes, number);
    return {reinterpret_cast<const char*>(bytes), sizeof bytes};
}

std::uint32_t checksumOf(const std::string& bytes) {
    boost::crc_32_type crc;
    crc.process_bytes(bytes.data(), bytes.size());
    return crc.checksum();
}

constexpr const char* kHead = "osgBinsPart 3\n";

/// Returns: nullopt at the end of what is whole.
std::optional<std::uint32_t> readNumber(std::istream& in) {
    unsigned char bytes[kNumberBytes];
    if (!in.read(reinterpret_cast<char*>(bytes), sizeof bytes)) return std::nullopt;
    return boost::endian::load_little_u32(bytes);
}

std::optional<FileRecord> readRecord(std::istream& in, std::uint64_t most) {
    const auto size = readNumber(in);
    if (!size || *size > most || *size > kMostBytes) return std::nullopt;
    std::string bytes(*size, '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    const auto checksum = readNumber(in);
    if (!checksum || *checksum != checksumOf(bytes)) return std::nullopt;
    return recordFrom(bytes);
}

}  // namespace

PartFile::PartFile(const std::string& path) : _path(path) {
    _handle = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (_handle < 0) fail("write");
    if (!osgAnalyticBin::support::lockFile(_handle, path)) {
        ::close(_handle);
        throw Failure("another osgbinconv is writing \"" + path + "\"; wait for it");
    }
    try {
        load();
    } catch (...) {
        ::close(_handle);
        throw;
    }
}

PartFile::~PartFile() {
    if (_handle >= 0) ::close(_handle);
}

void PartFile::load() {
    const off_t end = ::lseek(_handle, 0, SEEK_END);
    std::ifstream in(_path, std::ios::binary);
    std::string found(std::strlen(kHead), '\0');
    in.read(found.data(), static_cast<std::streamsize>(found.size()));
    if (!in || found != kHead) return clear();
    off_t whole = in.tellg();
    while (auto record = readRecord(in, static_cast<std::uint64_t>(end - whole))) {
        _records.push_back(std::move(*record));
        whole = in.tellg();
    }
    if (::ftruncate(_handle, whole) != 0) fail("write");
}

void PartFile::append(const FileRecord& record) {
    const std::string bytes = bytesOf(record);
    write(numberBytes(static_cast<std::uint32_t>(bytes.size())) + bytes + numberBytes(checksumOf(bytes)));
}

void PartFile::clear() {
    if (::ftruncate(_handle, 0) != 0) fail("write");
    write(kHead);
}

void PartFile::keepOnly(const std::map<std::string, FileRecord>& records) {
    clear();
    for (const auto& record : records) append(record.second);
}

void PartFile::remove() {
    ::unlink(_path.c_str());
}

void PartFile::write(const std::string& bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t count = ::write(_handle, bytes.data() + done, bytes.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) fail("write");
        done += static_cast<std::size_t>(count);
    }
}

void PartFile::fail(const std::string& what) {
    _hasFailed = true;
    throw Failure("cannot " + what + " \"" + _path + "\": " + std::strerror(errno) +
                  "; make room, or make the folder writable");
}

}  // namespace osgbinconv
