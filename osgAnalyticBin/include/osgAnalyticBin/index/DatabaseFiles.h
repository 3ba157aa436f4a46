// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/index/FileRecord.h>

#include <osg/Node>
#include <osg/ref_ptr>

#include <stdexcept>
#include <string>

namespace osgAnalyticBin::indexing {

/// Why no index of a database can be made; its text is one line: what, where, what to do.
class OSGANALYTICBIN_EXPORT Failure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
    ~Failure() override;
};

/// Size and time of a file; 0 for a missing file.
[[nodiscard]] FileStamp stampOfPath(const std::string& path);

/// The files of a database, named by their paths relative to the root file's folder; "" is the root file.
class OSGANALYTICBIN_EXPORT DatabaseFiles final {
public:
    /// Throws Failure when there is no such local file.
    explicit DatabaseFiles(const std::string& rootFile);

    /// The root file, as the constructor got it.
    [[nodiscard]] const std::string& rootFile() const { return _rootFile; }
    /// The name of the root file without its folder.
    [[nodiscard]] const std::string& rootName() const { return _rootName; }
    /// The path of a file that is named as above.
    [[nodiscard]] std::string pathOf(const std::string& file) const;
    /// stampOfPath() of a file that is named as above.
    [[nodiscard]] FileStamp stampOf(const std::string& file) const { return stampOfPath(pathOf(file)); }

    /// The scene of a file, as the pager would get it, but with stand-ins for images, shaders and fonts in files of
    /// their own, whatever their names are. May be called by several threads. Returns: null, with the reason in
    /// `error`, for a file that is missing or broken. Throws Failure when something that has to be read with it is
    /// outside of the folder.
    [[nodiscard]] osg::ref_ptr<osg::Node> read(const std::string& file, std::string& error) const;

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

/// Applies the rules of a read also to files that OpenSceneGraph reads without options (fonts, and others in its older
/// formats) while DatabaseFiles::read() runs. It replaces the read callback of osgDB::Registry, so call it only in
/// programs that read nothing else.
OSGANALYTICBIN_EXPORT void checkAllReads();

}  // namespace osgAnalyticBin::indexing
