// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../../core/FloatRounding.h"

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/TileFrame.h>
#include <osgAnalyticBin/TileSurface.h>

#include <cmath>
#include <utility>

namespace osgAnalyticBin {

namespace {

// The smallest float that is not below the value.
double notBelow(double value) {
    return -static_cast<double>(core::roundedDown(-value));
}

// Whether the longitudes are such as a file of an index may hold: two turns, as AnalyticBin's text allows them.
bool isInRange(const core::Interval& longitude) {
    return std::abs(longitude.lower) <= 12.5 && std::abs(longitude.upper) <= 12.5;
}

// What a file of the index can hold: angles in double, metres in float; a bin that it cannot hold is not valid.
BinIndex::Entry rounded(const BinIndex::Entry& entry) {
    BinIndex::Entry result;
    result.fingerprint = entry.fingerprint;
    const double ownLow = core::roundedDown(entry.ownLow);
    if (!entry.bin.valid() || !std::isfinite(ownLow) || !isInRange(entry.bin.bin().longitude())) return result;
    const core::Interval& altitude = entry.bin.bin().altitude();
    AnalyticBin bin(entry.bin.bin().withAltitude({core::roundedDown(altitude.lower), notBelow(altitude.upper)}),
                    notBelow(entry.bin.margin()));
    bin.setSag(notBelow(entry.bin.sag()));
    if (!std::isfinite(bin.margin()) || !std::isfinite(bin.sag()) || !bin.valid()) return result;
    result.bin = bin;
    result.ownLow = ownLow;
    return result;
}

}  // namespace

BinIndex::BinIndex(const BinIndex& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop), _source(other._source), _files(other._files), _stamps(other._stamps) {}

BinIndex::~BinIndex() = default;

const BinIndex::Entry* BinIndex::find(const std::string& file, std::size_t ordinal) const {
    const std::vector<Entry>* tiles = tilesOf(file);
    return tiles && ordinal < tiles->size() ? &(*tiles)[ordinal] : nullptr;
}

const std::vector<BinIndex::Entry>* BinIndex::tilesOf(const std::string& file) const {
    const auto found = _files.find(file);
    return found == _files.end() ? nullptr : &found->second;
}

void BinIndex::setTiles(const std::string& file, std::vector<Entry> tiles) {
    for (Entry& tile : tiles) tile = rounded(tile);
    _files[file] = std::move(tiles);
}

std::size_t BinIndex::tileCount() const {
    std::size_t count = 0;
    for (const auto& file : _files) count += file.second.size();
    return count;
}

std::uint64_t tileFingerprint(const FoundTile& tile) {
    // the same mesh on a globe is another tile
    std::uint64_t result = tile.frame.ellipsoid && isMapPlane(*tile.frame.ellipsoid) ? 1 : 0;
    for (const auto& mesh : tile.meshes) {
        // of a single mesh its own number; the factor is odd, so that nothing gets lost
        result = result * 31 + surfaceFingerprint(*mesh, tile.frame.localToEcef);
    }
    return result;
}

}  // namespace osgAnalyticBin
