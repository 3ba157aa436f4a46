// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Description.h"

#include <osg/Math>

namespace osgAnalyticBin::test {

bool TileKey::operator==(const TileKey& other) const {
    return database == other.database && level == other.level && column == other.column && row == other.row;
}

std::string TileKey::text() const {
    return std::to_string(database) + '.' + std::to_string(level) + '.' + std::to_string(column) + '.' +
           std::to_string(row);
}

bool TileKey::holds(const TileKey& other) const {
    const int finer = other.level - level;
    return database == other.database && finer >= 0 && other.column >> finer == column && other.row >> finer == row;
}

double DatabaseSpec::tileWidth(int level) const {
    return (isMap ? size() : 2.0 * osg::PI) / columns / (1 << level);
}

osg::Matrixd DatabaseSpec::toWorld(int frame) const {
    return osg::Matrixd::rotate(turn, osg::Vec3d(0, 0, 1)) * osg::Matrixd::translate(position + drift * frame);
}

double Description::turnOf(const TileKey& tile) const {
    double turn = 0.0;
    for (const Part& part : parts)
        if (part.kind == PartKind::Turned && part.tile.holds(tile)) turn += part.amount;
    return turn;
}

const std::vector<const char*>& hookWords() {
    static const std::vector<const char*> words{"root", "globe",    "tile",  "own",   "mesh", "geode", "file",
                                                "slot", "drawable", "above", "place", "view", "model", "tower"};
    return words;
}

std::string nodeName(Hook hook, const TileKey& tile) {
    const std::string name = std::string("#") + hookWords()[static_cast<std::size_t>(hook)];
    if (hook == Hook::Root || hook == Hook::View) return name;
    if (hook == Hook::Model || hook == Hook::Tower) return name + " 0";
    return name + ' ' + (hook == Hook::Globe || hook == Hook::Place ? std::to_string(tile.database) : tile.text());
}

bool hasScaledTerrain(const Description& description) {
    const auto isScaled = [](const DatabaseSpec& d) { return d.mesh == MeshKind::Terrain && d.verticalScale != 1.0; };
    const auto scales = [](const Part& part) { return part.kind == PartKind::SetScale; };
    return std::any_of(description.databases.begin(), description.databases.end(), isScaled) ||
           std::any_of(description.parts.begin(), description.parts.end(), scales);
}

bool hasTerrain(const Description& description) {
    return std::any_of(description.databases.begin(), description.databases.end(),
                       [](const DatabaseSpec& database) { return database.mesh == MeshKind::Terrain; });
}

bool isModel(PartKind kind) {
    return kind == PartKind::Tower || kind == PartKind::Vehicle || kind == PartKind::Sign || kind == PartKind::Unculled;
}

bool altersDrawing(PartKind kind) {
    switch (kind) {
        case PartKind::MeshHole:
        case PartKind::ReversedFaces:
        case PartKind::NarrowTile:
        case PartKind::DrawsNothing:
        case PartKind::State:
        case PartKind::LeavesOut:
        case PartKind::PushesState:
        case PartKind::Masks:
        case PartKind::Meddles:
        case PartKind::Vanish:
        case PartKind::DrawableCull:
        case PartKind::DrawableDraw:
        case PartKind::TileData:
            return true;
        default:
            return false;
    }
}

}  // namespace osgAnalyticBin::test
