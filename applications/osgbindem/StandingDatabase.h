// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileFiles.h"
#include "TileLayout.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/Group>
#include <osg/ref_ptr>

#include <optional>
#include <string>

namespace osgbindem {

/// A finished database that is to be updated. Not for use by several threads: each has its own.
class StandingDatabase final {
public:
    StandingDatabase(std::string rootFile, TileFiles files)
        : _rootFile(std::move(rootFile)), _files(std::move(files)) {}

    [[nodiscard]] bool hasChildren(const TileId& tile) const { return _files.hasChildren(tile); }

    /// The bin that is stored with a tile. Throws Failure when the tile is not there.
    [[nodiscard]] osgAnalyticBin::AnalyticBin bin(const TileId& tile);

private:
    /// Of the file with the tile.
    [[nodiscard]] const osg::Group& fileWith(const TileId& tile);

    std::string _rootFile;
    TileFiles _files;
    osg::ref_ptr<osg::Group> _root;
    std::optional<TileId> _parent;
    osg::ref_ptr<osg::Group> _siblings;
};

}  // namespace osgbindem
