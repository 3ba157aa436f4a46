// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "StandingDatabase.h"

#include "Failure.h"

#include <osgDB/ReadFile>

#include <algorithm>

namespace osgbindem {

using osgAnalyticBin::AnalyticBin;
using osgAnalyticBin::support::Failure;

namespace {

osg::ref_ptr<osg::Group> groupFrom(const std::string& file, unsigned int tiles) {
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    options->setObjectCacheHint(osgDB::Options::CACHE_NONE);
    const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file, options);
    osg::ref_ptr<osg::Group> group = node ? node->asGroup() : nullptr;
    if (!group || group->getNumChildren() != tiles) {
        throw Failure("\"" + file + "\" is not as osgbindem wrote it; build the database anew, without --update");
    }
    return group;
}

}  // namespace

const osg::Group& StandingDatabase::fileWith(const TileId& tile) {
    if (tile.level == 0) {
        if (!_root) _root = groupFrom(_rootFile, TileId::kStartColumns * TileId::kStartRows);
        return *_root;
    }
    const TileId parent = tile.ancestor(tile.level - 1);
    if (!_siblings || !(_parent == parent)) {
        _siblings = groupFrom(_files.pathOfChildren(parent), 4);
        _parent = parent;
    }
    return *_siblings;
}

AnalyticBin StandingDatabase::bin(const TileId& tile) {
    const osg::Group& file = fileWith(tile);
    unsigned int place = static_cast<unsigned int>(tile.y * TileId::kStartColumns + tile.x);
    if (tile.level > 0) {
        const auto siblings = tile.ancestor(tile.level - 1).children();
        place = static_cast<unsigned int>(std::find(siblings.begin(), siblings.end(), tile) - siblings.begin());
    }
    const AnalyticBin result = osgAnalyticBin::storedBin(*file.getChild(place));
    if (!result.valid()) throw Failure("tile " + tileName(tile) + " has no bin; build the database anew");
    return result;
}

}  // namespace osgbindem
