// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/index/DatabaseFiles.h>

#include <osg/ref_ptr>
#include <osgDB/Callbacks>
#include <osgDB/ReaderWriter>

#include <functional>
#include <string>
#include <vector>

namespace osgAnalyticBin::indexing {

/// Whether a name that is relative to the root file's folder leads out of it.
[[nodiscard]] bool leavesFolder(const std::string& file);

/// The message about such a file, and what to do.
constexpr const char* kIsOutside =
    "which is outside of the database's folder; name its files by paths below that folder";

/// While it exists, files that OSG reads in this thread because a file of a database names them (the content of
/// proxies, height fields, images, shaders, fonts) are searched for only below the database's folder and on OSG's data
/// path, and no server is contacted. Names that end in a pseudo-loader's extension, except .gdal, do not count as
/// files. Files that plugins of other formats than OSG's open by themselves are not noticed.
class NestedReads final {
public:
    /// `file`: the one that is read, as DatabaseFiles names it. Requires: no other in this thread.
    NestedReads(const DatabaseFiles& files, const std::string& file, Images images);
    ~NestedReads();
    NestedReads(const NestedReads&) = delete;
    NestedReads& operator=(const NestedReads&) = delete;

    /// Why the file must not be used, in one line: the first name that leads elsewhere; empty: nothing is wrong.
    [[nodiscard]] const std::string& refusal() const { return _refusal; }

    /// The read callback that has to be set in the options of a read, or in the registry, for this to work.
    [[nodiscard]] static osg::ref_ptr<osgDB::ReadFileCallback> callback();

    using Result = osgDB::ReaderWriter::ReadResult;
    using Reader = std::function<Result(const std::string& path)>;
    /// What bins depend on: a name that leads elsewhere is refused.
    [[nodiscard]] Result readScene(const std::string& name, const Reader& reader);
    /// What only a copy needs. Images::Left: `standIn`, whatever the name; Images::Checked: the same, or refused.
    [[nodiscard]] Result readPart(const std::string& name, const Result& standIn, const Reader& reader);
    /// As readPart(); found among the system's fonts, too.
    [[nodiscard]] Result readFont(const std::string& path, const Reader& reader);

private:
    /// The file that a name means, where another one names it. Absolute paths may lead into the folder.
    [[nodiscard]] std::string fileFrom(const std::string& referring, const std::string& name) const;
    [[nodiscard]] bool leaves(const std::string& name) const;
    /// A file of the database, "" none.
    [[nodiscard]] std::string fileCalled(const std::string& name) const;

    struct Found {
        /// As DatabaseFiles names it; a path when it is on OSG's data path.
        std::string file;
        /// Empty: there is none.
        std::string path;
    };
    [[nodiscard]] Found find(const std::string& name) const;
    void refuse(const std::string& name, const std::string& why);

    const DatabaseFiles& _files;
    const Images _images;
    /// The files that are being read, each named by the one before.
    std::vector<std::string> _stack;
    std::string _refusal;
};

}  // namespace osgAnalyticBin::indexing
