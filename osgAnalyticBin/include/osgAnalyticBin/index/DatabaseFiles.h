// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/index/FileRecord.h>

#include <osg/Node>
#include <osg/ref_ptr>

#include <string>

namespace osgAnalyticBin::indexing {

/// What becomes of images, shaders and fonts that are files of their own: stand-ins, whatever they are called; the
/// same, but names that lead out of the folder are refused; read, or refused.
enum class Images { Left, Checked, Read };

/// The files of a database, named by their paths relative to the root file's folder; "" is the root file.
class OSGANALYTICBIN_EXPORT DatabaseFiles final {
public:
    /// Throws Failure when there is no such local file.
    explicit DatabaseFiles(const std::string& rootFile);

    /// As it was named.
    [[nodiscard]] const std::string& rootFile() const { return _rootFile; }
    /// Without its folder.
    [[nodiscard]] const std::string& rootName() const { return _rootName; }
    /// Of a file that is named as above.
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

/// Loads what OpenSceneGraph's readers load on first use, so that threads find it loaded.
OSGANALYTICBIN_EXPORT void loadSerializers();

/// Has what OpenSceneGraph reads without options (fonts, and more in its older formats) follow the rules of Images,
/// too, while DatabaseFiles::read() runs. Replaces the read callback of osgDB::Registry: for programs that read nothing
/// else.
OSGANALYTICBIN_EXPORT void checkAllReads();

}  // namespace osgAnalyticBin::indexing
