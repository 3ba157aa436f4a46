// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/Export.h>

#include <osg/BoundingBox>
#include <osg/Referenced>
#include <osg/ref_ptr>

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace osgAnalyticBin {

/// The boxes of a whole photogrammetry set, made once by `osgbinconv --index` or in the background, and kept beside its
/// metadata: "metadata.xml" -> "metadata.xml.boxes". Each osg::LOD of the set has one; it holds the vertices of the
/// node and of all that is paged below it, in the coordinates of the files. Threads: reading members are const and may
/// be called by any number of threads at once.
class OSGANALYTICBIN_EXPORT BoxIndex final : public osg::Referenced {
public:
    /// The boxes of a file's LODs, in preorder. Not valid: not known, the node is never culled.
    using Boxes = std::vector<osg::BoundingBoxf>;

    /// What a file of an index begins with.
    static constexpr std::string_view kMagic{"osgAnalyticBin boxes 1"};

    /// `file`: path relative to the folder of the metadata, as by pagedFilePath().
    void add(const std::string& file, Boxes boxes) { _files[file] = std::move(boxes); }

    /// Returns: nullptr when the index does not know the file, or the file has no such node.
    [[nodiscard]] const osg::BoundingBoxf* find(const std::string& file, std::size_t ordinal) const;

    /// Number of files that it knows.
    [[nodiscard]] std::size_t numFiles() const { return _files.size(); }
    /// Number of LODs in these files.
    [[nodiscard]] std::size_t numBoxes() const;
    /// All files by name.
    [[nodiscard]] const std::map<std::string, Boxes>& files() const { return _files; }

    /// Files that the index was made from, as BinIndex::stamps(). Empty: the index holds whatever their times are.
    [[nodiscard]] const BinIndex::Stamps& stamps() const { return _stamps; }
    /// See stamps().
    void setStamps(BinIndex::Stamps stamps) { _stamps = std::move(stamps); }

    /// Writes the index; a file of that name is replaced when the new one is complete. Returns: whether it was written;
    /// otherwise `error` says why not.
    [[nodiscard]] bool write(const std::string& path, std::string& error) const;
    /// Writes the index to a stream. Returns: false when the stream fails.
    [[nodiscard]] bool write(std::ostream& out) const;

    /// Returns: nullptr when it cannot be read; then `error` says why.
    [[nodiscard]] static osg::ref_ptr<BoxIndex> read(const std::string& path, std::string& error);
    /// Reads an index from a stream. Returns: nullptr for anything else, a truncated or a damaged index; `error` says
    /// which.
    [[nodiscard]] static osg::ref_ptr<BoxIndex> read(std::istream& in, std::string& error);

protected:
    ~BoxIndex() override = default;

private:
    std::map<std::string, Boxes> _files;
    BinIndex::Stamps _stamps;
};

/// "set/metadata.xml" -> "set/metadata.xml.boxes".
[[nodiscard]] OSGANALYTICBIN_EXPORT std::string boxIndexPath(const std::string& metadataFile);

/// Callbacks of makeBoxIndex(). Never two of them run at the same time.
struct BoxIndexProgress {
    /// A file is done; `share` of the whole set, the sum is 1.
    std::function<void(std::size_t boxes, double share)> fileDone;
    /// A file cannot be read; `line` names the file and the reason.
    std::function<void(const std::string& line)> unreadable;
    /// Called after each file. Returns: false to stop; then no index is made.
    std::function<bool()> goesOn;
};

/// Makes the index of a set: reads every file of it once, in several threads. Files that are missing or cannot be read
/// draw nothing, and count as empty.
/// Returns: nullptr when the set has no tiles, or when it was stopped; then `error` says why.
[[nodiscard]] OSGANALYTICBIN_EXPORT osg::ref_ptr<BoxIndex> makeBoxIndex(const std::string& metadataFile, int threads,
                                                                        const BoxIndexProgress& progress,
                                                                        std::string& error);

}  // namespace osgAnalyticBin
