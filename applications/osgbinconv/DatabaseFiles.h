// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "FileRecord.h"

#include <osg/Node>
#include <osg/ref_ptr>

#include <string>

namespace osgbinconv {

/// What becomes of images, shaders and fonts that are files of their own: stand-ins, whatever they are called; the
/// same, but names that lead out of the folder are refused; read, or refused.
enum class Images { Left, Checked, Read };

/// Whether a name, made relative to the root file's folder already, leads elsewhere.
[[nodiscard]] bool leavesFolder(const std::string& file);

/// What is said of such a file, and what to do.
constexpr const char* kIsOutside =
    "which is outside of the database's folder; name its files by paths below that folder";

/// The files of a database, named by their paths relative to the root file's folder; "" is the root file.
class DatabaseFiles final {
public:
    /// Throws Failure when there is no such local file.
    explicit DatabaseFiles(const std::string& rootFile);

    [[nodiscard]] const std::string& rootFile() const { return _rootFile; }
    /// Without its folder.
    [[nodiscard]] const std::string& rootName() const { return _rootName; }
    [[nodiscard]] std::string pathOf(const std::string& file) const;
    /// 0 and 0 for a file that is not there.
    [[nodiscard]] FileStamp stampOf(const std::string& file) const;

    /// The scene of a file, as the pager would get it. May be called by several threads.
    /// Returns: null, with the reason in `error`, for a file that is missing or broken.
    /// Throws Failure when something that has to be read with it is outside of the folder.
    [[nodiscard]] osg::ref_ptr<osg::Node> read(const std::string& file, Images images, std::string& error) const;

    /// The name of a paged file, made relative to the root file's folder already. The root file becomes "".
    /// Throws Failure when it is outside of that folder.
    [[nodiscard]] std::string checked(const std::string& file, const std::string& namedBy) const;

private:
    std::string _rootFile;
    std::string _rootName;
    std::string _folder;
};

/// Makes ready what OpenSceneGraph loads on first use, so that threads find everything loaded.
void prepareReaders();

}  // namespace osgbinconv
