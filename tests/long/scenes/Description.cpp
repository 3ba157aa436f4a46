// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Description.h"

#include "States.h"

#include <osg/Math>
#include <osg/StateAttribute>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace osgAnalyticBin::test {

namespace {

const char* kindName(PartKind kind) {
    switch (kind) {
        case PartKind::Switch:
            return "a Switch above";
        case PartKind::Sequence:
            return "a Sequence above";
        case PartKind::Lod:
            return "a LOD above";
        case PartKind::Paged:
            return "a PagedLOD without a mesh of its own above";
        case PartKind::Proxy:
            return "a ProxyNode above";
        case PartKind::PlainGroup:
            return "a plain group above";
        case PartKind::Turned:
            return "a static transform above";
        case PartKind::Instance:
            return "instead of its own, the tile of another column under a static transform at";
        case PartKind::Again:
            return "the database a second time";
        case PartKind::MovingTiles:
            return "a moving transform above";
        case PartKind::Caster:
            return "a group that casts visitors above";
        case PartKind::GroupTree:
            return "plain groups above all tiles";
        case PartKind::MeshHole:
            return "a hole in";
        case PartKind::ReversedFaces:
            return "reversed faces in";
        case PartKind::NarrowTile:
            return "too narrow a mesh in";
        case PartKind::DrawsNothing:
            return "a Geometry that draws nothing in";
        case PartKind::Adding:
            return "a file that adds to";
        case PartKind::Objects:
            return "houses in a file of their own in";
        case PartKind::EqualNames:
            return "files of equal names";
        case PartKind::CullingOff:
            return "setCullingActive(false) on";
        case PartKind::UserCull:
            return "the application's cull callback on";
        case PartKind::UserUpdate:
            return "the application's update callback on";
        case PartKind::DrawableBin:
            return "a stored bin on the drawable of";
        case PartKind::Outline:
            return "polygon mode LINE or POINT on";
        case PartKind::Fill:
            return "polygon mode FILL on";
        case PartKind::State:
            return "a state on";
        case PartKind::LeavesOut:
            return "a cull callback that leaves out a child of";
        case PartKind::PushesState:
            return "a cull callback that pushes state on";
        case PartKind::Masks:
            return "a cull callback that sets the traversal mask on";
        case PartKind::OneShot:
            return "an update callback that takes itself off on";
        case PartKind::BoundCallback:
            return "the application's bounding sphere callback on";
        case PartKind::NoBoundCallback:
            return "setComputeBoundingSphereCallback(nullptr) on";
        case PartKind::DrawableCull:
            return "a drawable's cull callback on";
        case PartKind::DrawableDraw:
            return "a drawable's draw callback on";
        case PartKind::DrawableUpdate:
            return "a drawable's update callback on";
        case PartKind::DrawableBound:
            return "a drawable's bounding box callback on";
        case PartKind::Raise:
            return "vertices are raised in";
        case PartKind::Tower:
            return "a static tower in";
        case PartKind::Vehicle:
            return "a moving vehicle in";
        case PartKind::Sign:
            return "a sign that ignores depth in";
        case PartKind::Unculled:
            return "a model that stands elsewhere and is never culled in";
        case PartKind::Traffic:
            return "models that ask for terrain in";
        case PartKind::Camera:
            return "a camera in the scene";
        case PartKind::VisitorLeavesOut:
            return "a subclass of CullVisitor that leaves out";
        case PartKind::Pick:
            return "a pick";
        case PartKind::Toggle:
            return "the Switch is toggled above";
        case PartKind::SetOptions:
            return "setCullOptions()";
        case PartKind::Install:
            return "installBins() again";
        case PartKind::Uninstall:
            return "removeBins()";
        case PartKind::SetScale:
            return "setVerticalScale()";
        case PartKind::Clone:
            return "the scene is replaced by a clone";
        case PartKind::SaveAndLoad:
            return "the scene is saved and loaded";
        case PartKind::Expire:
            return "what is paged expires below";
        case PartKind::Move:
            return "the database is moved";
        case PartKind::Shove:
            return "the next transform is turned, at or above";
    }
    return "";
}

std::string inWordsOfValue(unsigned int value) {
    std::string text = value & osg::StateAttribute::ON ? "ON" : "OFF";
    if (value & osg::StateAttribute::OVERRIDE) text += " OVERRIDE";
    if (value & osg::StateAttribute::PROTECTED) text += " PROTECTED";
    return text;
}

bool isSomewhere(PartKind kind) {
    switch (kind) {
        case PartKind::GroupTree:
        case PartKind::EqualNames:
        case PartKind::Pick:
        case PartKind::Again:
        case PartKind::Camera:
        case PartKind::SetOptions:
        case PartKind::Install:
        case PartKind::Uninstall:
        case PartKind::Clone:
        case PartKind::SaveAndLoad:
            return false;
        default:
            return true;
    }
}

void describe(const DatabaseSpec& d, std::ostream& out) {
    static constexpr const char* kMeshes[] = {"meshes below transforms", "meshes in ECEF", "osgTerrain tiles"};
    static constexpr const char* kShapes[] = {"groups of four tiles", "groups of groups with one tile",
                                              "one tile each"};
    out << (d.isMap ? "a map of " : "a globe of ") << d.shownColumns << " of " << d.columns << " x " << d.rows
        << " from row " << d.firstRow << " tiles and " << d.levels << " finer levels "
        << (d.isLoaded ? "(loaded), " : "(paged), ") << kMeshes[static_cast<int>(d.mesh)] << " of " << d.posts
        << " posts, relief " << d.relief << " m in " << d.waves << " waves";
    if (d.levels > 0) out << ", files are " << kShapes[static_cast<int>(d.fileShape)];
    if (!d.isMap) out << ", radii " << d.equatorial << " " << d.polar;
    if (d.storesBins) out << ", stored bins" << (d.groupsLeaves ? " (groups above leaves)" : "");
    if (!d.hasSkirts) out << ", no skirts";
    if (d.hasSkirts && !d.hasQuads) out << ", skirts of triangles";
    if (d.leavesArePaged) out << ", leaves are PagedLODs";
    if (d.requestsBins) out << ", InstallBinsCallback";
    if (d.verticalScale != 1.0) out << ", vertical scale " << d.verticalScale;
    if (d.position.length() > 0.0)
        out << ", centre at " << d.position.x() << " " << d.position.y() << " " << d.position.z();
    if (d.drift.length() > 0.0) out << ", moves";
    out << ", range " << d.range << "; options \"" << toText(d.options) << "\"";
}

void describe(const ViewSpec& v, std::ostream& out) {
    osg::Vec3d eye, center, up;
    v.view.getLookAt(eye, center, up, 1.0);
    const osg::Vec3d along = center - eye;
    out << "eye " << eye.x() << " " << eye.y() << " " << eye.z() << " along " << along.x() << " " << along.y() << " "
        << along.z();
    if (v.projection(3, 3) != 0.0) {
        out << ", orthographic, half width " << 1.0 / v.projection(0, 0);
    } else {
        out << ", fov " << osg::RadiansToDegrees(2.0 * std::atan(1.0 / v.projection(1, 1)));
        if (v.projection(2, 0) != 0.0 || v.projection(2, 1) != 0.0) out << ", off axis";
    }
    out << ", culling mode " << v.cullingMode;
    if (v.computeNearFar != osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR) out << ", near and far computed";
}

}  // namespace

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
    for (const Part& part : parts) {
        if (part.kind == PartKind::Turned && part.tile.holds(tile)) turn += part.amount;
    }
    return turn;
}

std::string nodeName(Hook hook, const TileKey& tile) {
    switch (hook) {
        case Hook::Root:
            return "#root";
        case Hook::Globe:
            return "#globe " + std::to_string(tile.database);
        case Hook::Tile:
            return "#tile " + tile.text();
        case Hook::Own:
            return "#own " + tile.text();
        case Hook::Mesh:
            return "#mesh " + tile.text();
        case Hook::Geode:
            return "#geode " + tile.text();
        case Hook::File:
            return "#file " + tile.text();
        case Hook::Slot:
            return "#slot " + tile.text();
        case Hook::Drawable:
            return "#drawable " + tile.text();
        case Hook::Above:
            return "#above " + tile.text();
        case Hook::Place:
            return "#place " + std::to_string(tile.database);
        case Hook::View:
            return "#view";
    }
    return {};
}

bool hasScaledTerrain(const Description& description) {
    const auto isScaled = [](const DatabaseSpec& d) { return d.mesh == MeshKind::Terrain && d.verticalScale != 1.0; };
    const auto scales = [](const Part& part) { return part.kind == PartKind::SetScale; };
    return std::any_of(description.databases.begin(), description.databases.end(), isScaled) ||
           std::any_of(description.parts.begin(), description.parts.end(), scales);
}

bool isStateWithinMesh(const Part& part) {
    const bool isWithin = part.hook == Hook::Mesh || part.hook == Hook::Geode || part.hook == Hook::Drawable;
    return part.kind == PartKind::State && isWithin;
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
        case PartKind::DrawableCull:
        case PartKind::DrawableDraw:
        case PartKind::VisitorLeavesOut:
            return true;
        default:
            return false;
    }
}

std::string inWords(const Part& part) {
    std::ostringstream out;
    out.precision(9);
    out << "#" << part.id << ": ";
    if (isStateWithinMesh(part) && part.frame > 0)
        out << "a state, set late within a mesh, on";
    else if (part.kind == PartKind::DrawableDraw && part.frame > 0)
        out << "a drawable's draw callback, set late, on";
    else
        out << kindName(part.kind);
    if (isSomewhere(part.kind)) out << " " << nodeName(part.hook, part.tile);
    if (isModel(part.kind))
        out << " at " << osg::RadiansToDegrees(part.latitude) << " " << osg::RadiansToDegrees(part.longitude) << ", "
            << part.low << " to " << part.high << " m";
    if (part.kind == PartKind::SetOptions || part.kind == PartKind::Install)
        out << " \"" << toText(part.options) << "\"";
    if (part.kind == PartKind::State || part.kind == PartKind::PushesState)
        out << ": " << stateName(part.variant) << " " << inWordsOfValue(part.value);
    else if (part.variant != 0)
        out << ", variant " << part.variant;
    if (part.amount != 0.0) out << ", amount " << part.amount;
    if (part.frame > 0) out << ", in frame " << part.frame;
    if (part.until > 0) out << ", until frame " << part.until;
    return out.str();
}

std::string inWords(const Description& description) {
    std::ostringstream out;
    out.precision(9);
    for (const DatabaseSpec& database : description.databases) {
        out << "  ";
        describe(database, out);
        out << "\n";
    }
    for (const Part& part : description.parts) out << "  " << inWords(part) << "\n";
    for (std::size_t i = 0; i < description.views.size(); ++i) {
        if (!description.views[i].isActive) continue;
        out << "  frame " << i + 1 << ": ";
        describe(description.views[i], out);
        out << "\n";
    }
    return out.str();
}

}  // namespace osgAnalyticBin::test
