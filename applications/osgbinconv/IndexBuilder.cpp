// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Commands.h"
#include "Failure.h"
#include "ProgressLine.h"
#include "RecordStream.h"
#include "TextFile.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <utility>

namespace osgbinconv {

using osgAnalyticBin::BinIndex;
using osgAnalyticBin::support::Failure;

namespace {

// To be raised when a record's members or what they mean change.
constexpr const char* kHead = "osgBinsPart 6\n";

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
    try {
        FileRecord record;
        osgAnalyticBin::RecordReader reader(bytes);
        passRecord(reader, record);
        if (reader.isAtEnd()) return record;
    } catch (const std::out_of_range&) {
    }
    return std::nullopt;
}

/// The records of an index that is being made, "earth.ive.bins.part": appended one by one, each with its checksum, so
/// that a run that was killed goes on where it ended, or a later one reads only what has changed. Each record says of
/// which file it is; whether that has changed is the reader's to see. Locked against a second program. What cannot be
/// read or written throws Failure.
class PartFile final {
public:
    /// Opens the file and takes what is whole in it.
    explicit PartFile(const std::string& path) : _path(path), _lock(path, "osgbinconv", path, O_APPEND) {
        const off_t end = ::lseek(_lock.handle(), 0, SEEK_END);
        std::ifstream in(_path, std::ios::binary);
        std::string found(std::strlen(kHead), '\0');
        in.read(found.data(), static_cast<std::streamsize>(found.size()));
        if (!in || found != kHead) {
            clear();
            return;
        }
        off_t whole = in.tellg();
        while (auto record = readRecord(in, static_cast<std::uint64_t>(end - whole))) {
            _records.push_back(std::move(*record));
            whole = in.tellg();
        }
        if (::ftruncate(_lock.handle(), whole) != 0) fail();
    }

    /// What an earlier run has left; to be called once.
    [[nodiscard]] std::vector<FileRecord> takeRecords() { return std::move(_records); }

    /// Not to be called by two threads at once.
    void append(const FileRecord& record) {
        osgAnalyticBin::RecordWriter writer, out;
        passRecord(writer, record);
        out.list(writer.finish());
        write(out.bytes);
    }

    /// Deletes the file, which is no longer needed.
    void remove() { _lock.remove(); }

    /// Has just these records from here on.
    void keepOnly(const FileRecords& records) {
        clear();
        for (const auto& record : records) append(record.second);
    }

    /// Whether the records could not be written, for want of room.
    [[nodiscard]] bool hasFailed() const { return _hasFailed; }

private:
    void clear() {
        if (::ftruncate(_lock.handle(), 0) != 0) fail();
        write(kHead);
    }
    void write(const std::string& bytes) {
        for (std::size_t done = 0; done < bytes.size();) {
            const ssize_t count = ::write(_lock.handle(), bytes.data() + done, bytes.size() - done);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) fail();
            done += static_cast<std::size_t>(count);
        }
    }
    [[noreturn]] void fail() {
        _hasFailed = true;
        throw Failure("cannot write \"" + _path + "\": " + std::strerror(errno) +
                      "; make room, or make the folder writable");
    }

    const std::string _path;
    const osgAnalyticBin::support::LockedFile _lock;
    bool _hasFailed = false;
    std::vector<FileRecord> _records;
};

/// The index is going to be replaced: it must be one.
void requireNothingForeign(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) return;
    std::string magic(BinIndex::kMagic.size(), '\0');
    in.read(magic.data(), static_cast<std::streamsize>(magic.size()));
    if (in && magic != BinIndex::kMagic) throw Failure("\"" + path + "\" is no index of bins; move it away");
}

/// Says on stderr how far a pass over the files of a database is.
class ReportedWalk final : public osgAnalyticBin::indexing::WalkObserver {
public:
    ReportedWalk(const std::function<void(const FileRecord&)>& keep, bool isQuiet) : _keep(keep), _isQuiet(isQuiet) {}

    void beforeFile() override { osgAnalyticBin::support::throwIfStopRequested(); }
    void done(const FileRecord& record, bool isKnown, double share) override {
        if (!isKnown && _keep) _keep(record);
        ++_files;
        _tiles += record.tiles.size();
        _share += share;
        if (isKnown) {
            ++_known;
            _line.skip(share);
        }
        if (!_isQuiet && _line.isDue()) _line.show(_share, text());
    }
    void finish() {
        if (!_isQuiet) _line.finish(_share, text());
    }

private:
    [[nodiscard]] std::string text() const {
        const double seconds = _line.seconds();
        const double rate = seconds > 0.0 ? static_cast<double>(_tiles) / seconds : 0.0;
        const std::string known = _known > 0 ? " (" + std::to_string(_known) + " files from an earlier run)" : "";
        return "osgbinconv: read " + std::to_string(_files) + " files, " + std::to_string(_tiles) + " tiles, " +
               osgAnalyticBin::support::withDecimals(rate, 0) + " tiles/s" + known + ", ";
    }

    const std::function<void(const FileRecord&)>& _keep;
    const bool _isQuiet;
    osgAnalyticBin::support::ProgressLine _line{stderr};
    std::size_t _files = 0, _known = 0, _tiles = 0;
    double _share = 0.0;
};

/// A database of which no index can be made leaves no records behind.
MadeIndex builtWith(PartFile& part, const DatabaseFiles& files, const WalkOptions& options) {
    const auto giveUp = [&part] {
        if (!part.hasFailed()) part.remove();
    };
    try {
        return buildIndex(files, options, part.takeRecords(),
                          [&part](const FileRecord& record) { part.append(record); });
    } catch (const Failure&) {
        giveUp();
        throw;
    } catch (const osgAnalyticBin::indexing::Failure&) {
        giveUp();
        throw;
    }
}

}  // namespace

MadeIndex buildIndex(const DatabaseFiles& files, const WalkOptions& options, std::vector<FileRecord> known,
                     const std::function<void(const FileRecord&)>& keep) {
    ReportedWalk walk(keep, options.isQuiet);
    FileRecords records = osgAnalyticBin::indexing::walkDatabase(files, std::move(known), walk, options.threads);
    walk.finish();
    MadeIndex made = osgAnalyticBin::indexing::indexFrom(files, std::move(records));
    for (const std::string& warning : made.warnings) std::cerr << "osgbinconv: warning: " << warning << std::endl;
    return made;
}

void writeIndex(const DatabaseFiles& files, const WalkOptions& options, bool keepsRecords) {
    const std::string name = osgAnalyticBin::binIndexName(files.rootFile());
    requireNothingForeign(name);
    PartFile part(name + ".part");
    const MadeIndex built = builtWith(part, files, options);
    std::string error;
    if (!built.index->write(name, error)) throw Failure(error);
    if (keepsRecords)
        part.keepOnly(built.records);
    else
        part.remove();
}

}  // namespace osgbinconv
