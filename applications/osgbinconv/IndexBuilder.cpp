// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Commands.h"
#include "Failure.h"
#include "Interruption.h"
#include "PartFile.h"
#include "Progress.h"

#include <fstream>
#include <iostream>
#include <string>
#include <utility>

namespace osgbinconv {

using osgAnalyticBin::BinIndex;
using osgAnalyticBin::support::Failure;

namespace {

/// The index is going to be replaced: it must be one.
void requireNothingForeign(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) return;
    std::string magic(BinIndex::kMagic.size(), '\0');
    in.read(magic.data(), static_cast<std::streamsize>(magic.size()));
    if (in && magic != BinIndex::kMagic) throw Failure("\"" + path + "\" is no index of bins; move it away");
}

class ReportedWalk final : public osgAnalyticBin::indexing::WalkObserver {
public:
    ReportedWalk(const std::function<void(const FileRecord&)>& keep, bool isQuiet)
        : _keep(keep), _progress("read", isQuiet) {}

    void beforeFile() override { osgAnalyticBin::support::throwIfStopRequested(); }
    void done(const FileRecord& record, bool isKnown, double share) override {
        if (!isKnown && _keep) _keep(record);
        isKnown ? _progress.addKnown(record.tiles.size(), share) : _progress.add(record.tiles.size(), share);
    }
    void finish() { _progress.finish(); }

private:
    const std::function<void(const FileRecord&)>& _keep;
    Progress _progress;
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
    FileRecords records =
        osgAnalyticBin::indexing::walkDatabase(files, std::move(known), walk, options.threads, options.images);
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
    if (keepsRecords) {
        part.keepOnly(built.records);
    } else {
        part.remove();
    }
}

}  // namespace osgbinconv
