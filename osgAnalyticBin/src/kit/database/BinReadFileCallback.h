// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Database.h"
#include "FailedReads.h"

#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/TileFrame.h>

#include <osg/Node>
#include <osg/PagedLOD>
#include <osgDB/Options>
#include <osgDB/ReadFile>

#include <map>
#include <string>

namespace osgAnalyticBin {

/// Installs bins on what the DatabasePager reads, in the thread that reads it. Reading itself is left to the callback
/// that was there before, if any, else to the Registry's, else to OSG. A file that could not be read is not tried again
/// for a while (FailedReads); the pager then gets nothing at once, and asks again.
/// OSG's object caches neither get nor give tiles (osgDB::Options::CACHE_NODES), and a node that a read callback keeps
/// gets no bins: others may draw it.
class BinReadFileCallback : public osgDB::ReadFileCallback {
public:
    /// `frame` is that of files of which expect() says nothing.
    BinReadFileCallback(Database* database, const TileFrame& frame, osgDB::ReadFileCallback* previous);

    /// Announces a file: the name by which it will be requested, the frame of its content, and the tile that pages it
    /// (null: none). Do not call once the pager may read.
    void expect(const std::string& fileName, const TileFrame& frame, InstalledTile* parent);

    /// Whether the file is expected in another frame or below another tile: it then needs another callback.
    [[nodiscard]] bool expectsOtherwise(const std::string& fileName, const TileFrame& frame,
                                        InstalledTile* parent) const;

    osgDB::ReaderWriter::ReadResult readNode(const std::string& fileName, const osgDB::Options* options) override;

    [[nodiscard]] osgDB::ReadFileCallback* previous() { return _previous.get(); }
    [[nodiscard]] Database* database() { return _database.get(); }

    /// The options that the PagedLOD came with; null: none.
    void setReplaced(osgDB::Options* options) { _replaced = options; }
    [[nodiscard]] osgDB::Options* replaced() const { return _replaced.get(); }

protected:
    ~BinReadFileCallback() override;

private:
    using ReadResult = osgDB::ReaderWriter::ReadResult;

    // Sets `isAdded` if the file holds tiles and the node that pages it is no tile.
    [[nodiscard]] ReadResult readAndInstall(const std::string& fileName, const osgDB::Options* options, bool& isAdded);
    struct Expected {
        TileFrame frame;
        osg::ref_ptr<InstalledTile> parent;
    };

    [[nodiscard]] const Expected& expected(const std::string& fileName, const osgDB::Options* options) const;

    const osg::ref_ptr<Database> _database;
    const Expected _unexpected;
    std::map<std::string, Expected> _expected;
    const osg::ref_ptr<osgDB::ReadFileCallback> _previous;
    osg::ref_ptr<osgDB::Options> _replaced;
    FailedReads _failures;
};

/// The database options that replace those which PagedLODs came with (or none), so that bins are installed on what they
/// read.
class PagedReads final {
public:
    /// Has the files of a PagedLOD, which stands in `frame`, read by a callback of ours. `parent`: the tile that pages
    /// them, null: none; `isTile`: it is this node.
    void follow(osg::PagedLOD& node, const TileFrame& frame, Database& database, InstalledTile* parent, bool isTile);
    [[nodiscard]] bool empty() const { return _replacing.empty(); }

private:
    struct Replacing {
        osg::ref_ptr<osgDB::Options> options;
        BinReadFileCallback* callback = nullptr;  // owned by the options
    };
    std::map<osg::ref_ptr<osgDB::Options>, Replacing> _replacing;
};

/// The read callback of ours that a PagedLOD's options have; null: none.
[[nodiscard]] BinReadFileCallback* readCallbackOf(osg::PagedLOD& node);

/// The database that the node carries, or that the files paged below it belong to. Null where no installer ran.
[[nodiscard]] osg::ref_ptr<Database> databaseOf(osg::Node& node);

}  // namespace osgAnalyticBin
