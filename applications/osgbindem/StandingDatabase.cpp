// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "StandingDatabase.h"

#include "Failure.h"

#include <osg/Group>
#include <osgDB/ReadFile>

#include <algorithm>

namespace osgbindem {

using osgAnalyticBin::AnalyticBin;
using osgAnalyticBin::support::Failure;

namespace {

std::vector<AnalyticBin> binsFrom(const std::string& file, std::size_t tiles) {
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    options->setObjectCacheHint(osgDB::Options::CACHE_NONE);
    const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file, options);
    const osg::Group* group = node ? node->asGroup() : nullptr;
    if (group == nullptr || group->getNumChildren() != tiles) {
        throw Failure("\"" + file + "\" is not as osgbindem wrote it; build the database anew, without --update");
    }
    std::vector<AnalyticBin> bins;
    for (unsigned int i = 0; i < tiles; ++i) bins.push_back(osgAnalyticBin::storedBin(*group->getChild(i)));
    return bins;
}

}  // namespace

const StandingDatabase::Bins& StandingDatabase::Start::bins() {
    const std::lock_guard<std::mutex> guard(_mutex);
    if (_bins.empty()) _bins = binsFrom(_file, _layout.startTiles().size());
    return _bins;
}

const StandingDatabase::Bins& StandingDatabase::binsBeside(const TileId& tile) {
    if (tile.level == _layout.startLevel()) return _start->bins();
    const TileId parent = tile.ancestor(tile.level - 1);
    if (!(_parent == parent)) {
        _siblings = binsFrom(_files.pathOfChildren(parent), 4);
        _parent = parent;
    }
    return _siblings;
}

AnalyticBin StandingDatabase::bin(const TileId& tile) {
    const Bins& bins = binsBeside(tile);
    const auto placeIn = [&tile](const auto& tiles) {
        return static_cast<std::size_t>(std::find(tiles.begin(), tiles.end(), tile) - tiles.begin());
    };
    const std::size_t place = tile.level == _layout.startLevel() ? placeIn(_layout.startTiles())
                                                                 : placeIn(tile.ancestor(tile.level - 1).children());
    if (!bins[place].valid()) throw Failure("tile " + tileName(tile) + " has no bin; build the database anew");
    return bins[place];
}

}  // namespace osgbindem
