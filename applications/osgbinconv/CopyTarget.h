// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Commands.h"
#include "DiskFile.h"

#include <osg/Node>

#include <mutex>
#include <string>
#include <vector>

namespace osgbinconv {

/// A name with another extension: "../a/b.ive" -> "../a/b.osgb".
[[nodiscard]] std::string withExtension(const std::string& name, const std::string& extension);

/// What a copy's name must be, as far as it can be told before the database is read.
/// Throws Failure when OpenSceneGraph cannot write such files with bins in them, when there is no such folder, or when
/// the file is there already and `overwrite` is not given.
void requireCopyName(const std::string& rootFile, const std::string& sourceFile, bool overwrite);

/// The files of a copy, beside its root file as the originals are beside theirs. Each is written under a temporary name
/// and renamed, the root file last; what was written is removed again unless the copy is complete. While a copy is
/// made, "earth.osgb.copying" stands beside it, locked against a second program; a copy of the same database may
/// replace what the one has left that was killed.
class CopyTarget final {
public:
    /// Requires: requireCopyName(). Throws Failure when a file would replace one of the original or take the name of
    /// another one, or when one is there already and `overwrite` is not given.
    CopyTarget(const std::string& rootFile, const DatabaseFiles& source, const FileRecords& records, bool overwrite);
    CopyTarget(const CopyTarget&) = delete;
    CopyTarget& operator=(const CopyTarget&) = delete;
    ~CopyTarget();

    /// Without the point.
    [[nodiscard]] const std::string& extension() const { return _extension; }

    /// `file`: as the original is named. May be called by several threads. Throws Failure.
    void write(const std::string& file, const osg::Node& scene);

    /// Writes the root file, when all others are there. Throws Failure.
    void complete(const osg::Node& root);

private:
    [[nodiscard]] std::string pathOf(const std::string& file) const;
    void mark(const std::string& sourceFile);
    void removeMarker();
    void requireFree(const DatabaseFiles& source, const FileRecords& records, bool overwrite) const;

    std::string _rootFile;
    std::string _folder;
    std::string _extension;
    std::string _marker;
    const osgAnalyticBin::support::LockedFile _lock;
    /// Whether an earlier copy of the same database was killed.
    bool _goesOn = false;
    /// Whether files of an earlier copy may be left.
    bool _keepsMarker = false;
    std::mutex _mutex;
    std::vector<std::string> _written;
};

}  // namespace osgbinconv
