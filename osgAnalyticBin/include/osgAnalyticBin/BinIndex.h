// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/Export.h>

#include <osg/Object>
#include <osg/ref_ptr>

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace osgDB {
class Options;
}

namespace osgAnalyticBin {

struct FoundTile;

/// The bins of a whole database, made once by `osgbinconv --index` and kept in one file beside it:
/// "earth.ive" -> "earth.ive.bins". The database itself is not touched.
/// Threads: reading members are const and may be called by any number of threads at once.
class OSGANALYTICBIN_EXPORT BinIndex : public osg::Object {
public:
    /// The first bytes of an index in a file.
    static constexpr std::string_view kMagic{"\x89osgBins", 8};

    /// What the index knows of a tile.
    struct Entry {
        /// The bin for culling: it holds all that the tile and its descendants draw, skirts included. Not valid: the
        /// tile is never culled.
        AnalyticBin bin;
        /// Lowest altitude of the tile's own surface, chords between posts included, metres.
        double ownLow = 0.0;
        /// tileFingerprint() of the tile; 0: unknown.
        std::uint64_t fingerprint = 0;
    };

    /// The root file of the database that the index was made from.
    struct Source {
        /// Name of the root file, without its folder.
        std::string name;
        /// Bytes of the root file; 0: it may have any content.
        std::uint64_t size = 0;
        /// When the root file was changed last, in seconds since 1970; a hint only, since copies often lose it.
        std::int64_t time = 0;
    };

    /// Tells whether a file has changed since it was read. All numbers are 0 for a missing file.
    struct Stamp {
        std::uint64_t size = 0;        ///< bytes
        std::int64_t time = 0;         ///< seconds since 1970, when the file was changed last
        std::int64_t nanoseconds = 0;  ///< of the same time

        /// Whether all numbers are the same.
        [[nodiscard]] bool operator==(const Stamp& other) const {
            return size == other.size && time == other.time && nanoseconds == other.nanoseconds;
        }
    };
    /// By file, named as in find().
    using Stamps = std::map<std::string, Stamp>;

    BinIndex() = default;
    /// A copy of all entries.
    BinIndex(const BinIndex& other, const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);

    META_Object(osgAnalyticBin, BinIndex)

        /// The entry of a tile. `file`: path relative to the root file's folder, as by pagedFilePath(), "" for the
        /// root file itself; `ordinal`: the tile's position among the tiles of the file, in preorder.
        /// Returns: nullptr for a tile that the index does not know.
        /// Cost: one search in a sorted map of the files.
        [[nodiscard]] const Entry* find(const std::string& file, std::size_t ordinal) const;

    /// All entries of a file, by ordinal. Returns: nullptr for a file that the index does not know.
    [[nodiscard]] const std::vector<Entry>* tilesOf(const std::string& file) const;

    /// Sets the entries of a file. Numbers that the index file cannot hold exactly are rounded outward at once, so that
    /// written entries are read back unchanged.
    void setTiles(const std::string& file, std::vector<Entry> tiles);

    /// All files with tiles, by name.
    [[nodiscard]] const std::map<std::string, std::vector<Entry>>& files() const { return _files; }

    /// Number of files with tiles.
    [[nodiscard]] std::size_t fileCount() const { return _files.size(); }
    /// Number of tiles in all files.
    [[nodiscard]] std::size_t tileCount() const;

    /// What the index was made from.
    [[nodiscard]] const Source& source() const { return _source; }
    /// Sets what the index was made from.
    void setSource(const Source& source) { _source = source; }

    /// Size and time of each file that the index was made from. An index of osgbinconv has none: it is used even when
    /// the times differ, because it may have been copied together with its database. An index made in the background
    /// (IndexUse::Auto) has them.
    [[nodiscard]] const Stamps& stamps() const { return _stamps; }
    /// See stamps().
    void setStamps(Stamps stamps) { _stamps = std::move(stamps); }

    /// Reads to the end of the stream. Memory is allocated only for data that has been read.
    /// Returns: null, with one line in `error`, for what is broken, truncated, foreign or of a newer version.
    [[nodiscard]] static osg::ref_ptr<BinIndex> read(std::istream& in, std::string& error);
    /// The same from a local file.
    [[nodiscard]] static osg::ref_ptr<BinIndex> read(const std::string& path, std::string& error);

    /// The same index gives the same bytes, on every machine. Returns: false when the stream fails.
    bool write(std::ostream& out) const;

    /// Writes a file under a temporary name, and renames it when it is complete.
    /// Returns: false, with one line in `error`, when that fails.
    bool write(const std::string& path, std::string& error) const;

protected:
    ~BinIndex() override;

private:
    Source _source;
    std::map<std::string, std::vector<Entry>> _files;
    Stamps _stamps;
};

/// The surfaceFingerprint() of a tile's own mesh. For several meshes: one number computed from all fingerprints. 0: no
/// mesh.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::uint64_t tileFingerprint(const FoundTile& tile);

/// Name of a database's index: "earth.ive" -> "earth.ive.bins".
[[nodiscard]] OSGANALYTICBIN_EXPORT std::string binIndexName(const std::string& databaseFileName);

/// Reads the index beside a database: a local file, or whatever OSG reads of that name from archives and servers.
/// Returns: null with an empty `error` when there is none; null with one line in `error` when it cannot be used,
/// because it is broken or because the size of the local root file has changed since.
[[nodiscard]] OSGANALYTICBIN_EXPORT osg::ref_ptr<BinIndex> readBinIndex(const std::string& databaseFileName,
                                                                        const osgDB::Options* options,
                                                                        std::string& error);

}  // namespace osgAnalyticBin
