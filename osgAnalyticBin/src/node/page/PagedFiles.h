// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The files that PagedLODs request from the DatabasePager, and the read callbacks that handle them.

#pragma once

#include "Database.h"

#include <osgAnalyticBin/TileFrame.h>

#include <osg/Node>
#include <osg/PagedLOD>
#include <osgDB/Options>
#include <osgDB/ReadFile>

#include <string>
#include <vector>

namespace osgAnalyticBin {

class BinReadFileCallback;

struct PagedFile {
    std::string name;  ///< as the pager asks for it
    TileFrame frame;   ///< where its content stands
};

/// The files of a PagedLOD that stands in `frame`; `isTile`: and is a tile.
[[nodiscard]] std::vector<PagedFile> filesPagedBy(const osg::PagedLOD& node, const TileFrame& frame, bool isTile);

/// The read callback of options, or the one that ours among them hands on to. May be null.
[[nodiscard]] osgDB::ReadFileCallback* previousCallback(const osgDB::Options& options);

/// The read callback of ours that a PagedLOD's options have; null: none.
[[nodiscard]] BinReadFileCallback* readCallbackOf(osg::PagedLOD& node);

/// Options as they were before an installer replaced them. Both may be null.
[[nodiscard]] osgDB::Options* optionsWithoutBins(osgDB::Options* options);

/// The database that the node carries, or that the files paged below it belong to. Null where no installer ran.
[[nodiscard]] osg::ref_ptr<Database> databaseOf(osg::Node& node);

}  // namespace osgAnalyticBin
