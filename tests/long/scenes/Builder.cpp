// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Builder.h"

#include "Callbacks.h"
#include "Meshes.h"
#include "Painter.h"
#include "Parts.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/Camera>
#include <osg/CoordinateSystemNode>
#include <osg/LOD>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osg/PositionAttitudeTransform>
#include <osg/ProxyNode>
#include <osg/Sequence>
#include <osg/Switch>
#include <osgTerrain/Terrain>

#include <algorithm>
#include <cstdio>

namespace osgAnalyticBin::test {

namespace {

constexpr float kFar = 1e10f;
constexpr const char* kMapProjection = "PROJCS[\"WGS 84 / UTM zone 33N\",GEOGCS[\"WGS 84\"]]";

std::string fileName(const TileKey& parent) {
    return "scene_" + parent.text() + ".osgb";
}

template <class NodeType>
osg::ref_ptr<NodeType> named(const std::string& name) {
    const osg::ref_ptr<NodeType> node = new NodeType;
    node->setName(name);
    return node;
}

double radiusOf(const DatabaseSpec& database, int level) {
    return 0.75 * database.tileWidth(level) * (database.isMap ? 1.0 : database.equatorial);
}

// In the frame of the globe, whatever transforms are between it and the tile.
AnalyticBin binOf(const DatabaseSpec& database, const TileKey& tile) {
    const Extents e = extentsOf(database, tile);
    const double sag = sagOf(database, tile.level);
    AnalyticBin bin(core::GeodeticBin({e.south, e.north}, {e.west, e.east}, {-database.relief - sag, database.relief}));
    bin.setMargin(2.0 * database.scale());
    bin.setSag(sag);
    return bin;
}

osg::ref_ptr<osg::CoordinateSystemNode> makeGlobe(const DatabaseSpec& database, int number) {
    osg::ref_ptr<osg::CoordinateSystemNode> globe;
    if (database.mesh == MeshKind::Terrain) {
        const osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
        terrain->setVerticalScale(static_cast<float>(database.verticalScale));
        globe = terrain;
    } else {
        globe = new osg::CoordinateSystemNode;
    }
    globe->setName("#globe " + std::to_string(number));
    if (database.isMap) {
        globe->setFormat("WKT");
        globe->setCoordinateSystem(kMapProjection);
    } else {
        globe->setEllipsoidModel(new osg::EllipsoidModel(database.equatorial, database.polar));
    }
    return globe;
}

osg::ref_ptr<osg::Group> transformed(const std::string& name, const osg::Matrixd& matrix, int variant) {
    if (variant % 2 == 0) {
        const osg::ref_ptr<osg::MatrixTransform> transform = named<osg::MatrixTransform>(name);
        transform->setMatrix(matrix);
        transform->setDataVariance(osg::Object::STATIC);
        return transform;
    }
    const osg::ref_ptr<osg::PositionAttitudeTransform> transform = named<osg::PositionAttitudeTransform>(name);
    transform->setPosition(matrix.getTrans());
    transform->setAttitude(matrix.getRotate());
    return transform;
}

osg::ref_ptr<osg::Node> placed(const DatabaseSpec& database, int number, osg::Node& globe) {
    const osg::Matrixd here = database.toWorld(0);
    if (here.isIdentity() && database.drift.length2() == 0.0) return &globe;
    const osg::ref_ptr<osg::MatrixTransform> above = named<osg::MatrixTransform>("#place " + std::to_string(number));
    above->setMatrix(here);
    above->addChild(&globe);
    if (database.drift.length2() > 0.0) {
        above->setDataVariance(osg::Object::DYNAMIC);
        // its step is in its own frame
        const osg::Vec3d step = osg::Matrixd::transform3x3(database.drift, osg::Matrixd::inverse(here));
        above->setUpdateCallback(new Mover(here, step, 0));
    }
    return above;
}

osg::ref_ptr<osg::Group> makeCamera(const Part& part) {
    const osg::ref_ptr<osg::Camera> camera = named<osg::Camera>("#camera " + std::to_string(part.id));
    constexpr osg::Transform::ReferenceFrame kFrames[] = {osg::Transform::RELATIVE_RF, osg::Transform::ABSOLUTE_RF,
                                                          osg::Transform::ABSOLUTE_RF_INHERIT_VIEWPOINT};
    constexpr osg::Camera::RenderOrder kOrders[] = {osg::Camera::NESTED_RENDER, osg::Camera::PRE_RENDER,
                                                    osg::Camera::POST_RENDER};
    camera->setReferenceFrame(kFrames[part.variant % 3]);
    const osg::Camera::RenderOrder order = kOrders[part.variant / 3 % 3];
    camera->setRenderOrder(order);
    camera->setViewMatrix(part.view);
    camera->setProjectionMatrix(part.projection);
    if (order != osg::Camera::NESTED_RENDER)
        camera->setViewport(kInnerPictureStart, 0, kInnerPictureSize, kInnerPictureSize);
    camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    return camera;
}

}  // namespace

osg::ref_ptr<osg::Group> Builder::scene() const {
    osg::ref_ptr<osg::Group> root = named<osg::Group>("#root");
    std::vector<osg::ref_ptr<osg::Node>> databases;
    for (std::size_t i = 0; i < _description.databases.size(); ++i) {
        databases.push_back(database(static_cast<int>(i)));
        root->addChild(databases.back());
    }
    for (const Part& part : _description.parts) {
        osg::ref_ptr<osg::Group> above;
        if (part.kind == PartKind::Again) above = transformed("#again " + std::to_string(part.id), part.view, 0);
        if (part.kind == PartKind::Camera) above = makeCamera(part);
        if (!above) continue;
        above->addChild(databases[static_cast<std::size_t>(part.tile.database)]);
        root->addChild(above);
    }
    decorate(*root);
    return root;
}

osg::ref_ptr<osg::Node> Builder::database(int number) const {
    const DatabaseSpec& database = _description.databases[static_cast<std::size_t>(number)];
    const osg::ref_ptr<osg::CoordinateSystemNode> globe = makeGlobe(database, number);
    for (int row = 0; row < database.rows; ++row) {
        std::vector<osg::ref_ptr<osg::Node>> own;
        std::vector<osg::Node*> tiles;
        for (int column = 0; column < database.shownColumns; ++column) {
            own.push_back(wrappedTile({number, 0, column, row}));
            tiles.push_back(own.back());
        }
        for (int column = 0; column < database.shownColumns; ++column)
            globe->addChild(rootTile({number, 0, column, row}, tiles));
    }
    return placed(database, number, *globe);
}

// What stands in the place of a tile of level 0.
osg::ref_ptr<osg::Node> Builder::rootTile(const TileKey& tile, const std::vector<osg::Node*>& row) const {
    for (const Part& part : _description.parts) {
        if (part.kind != PartKind::Instance || !(part.tile == tile)) continue;
        const int columns = tile.column - part.variant;
        const osg::Matrixd matrix = turned(spec(tile), columns * spec(tile).tileWidth(0));
        const osg::ref_ptr<osg::Group> copy = transformed("#copy " + std::to_string(part.id), matrix, part.id);
        copy->addChild(row[static_cast<std::size_t>(part.variant)]);
        return copy;
    }
    return row[static_cast<std::size_t>(tile.column)];
}

osg::ref_ptr<osg::Node> Builder::wrappedTile(const TileKey& key) const {
    osg::ref_ptr<osg::Node> node = tile(key);
    for (const Part& part : _description.parts) {
        if (part.frame == 0 && part.tile == key) node = wrap(part, *node);
    }
    return node;
}

osg::ref_ptr<osg::Node> Builder::tile(const TileKey& key) const {
    const DatabaseSpec& database = spec(key);
    const double turn = _description.turnOf(key);
    osg::ref_ptr<osg::Node> own = makeMesh(database, key, turn, database.posts);
    const bool hasFile = key.level < database.levels;
    const bool isTerrain = database.mesh == MeshKind::Terrain;
    const bool isPaged = hasFile || database.leavesArePaged || (key.level == 0 && !database.storesBins && !isTerrain);
    if (!isPaged && database.storesBins && !database.groupsLeaves) setStoredBin(*own, binOf(database, key));
    if (!isPaged && (!database.storesBins || !database.groupsLeaves)) return own;
    if (!isTerrain) {
        const osg::ref_ptr<osg::Group> group = named<osg::Group>(nodeName(Hook::Own, key));
        group->addChild(own);
        own = group;
    }
    const osg::ref_ptr<osg::Group> node = isPaged ? new osg::PagedLOD : new osg::Group;
    node->setName(nodeName(Hook::Tile, key));
    if (database.storesBins) setStoredBin(*node, binOf(database, key));
    auto* paged = dynamic_cast<osg::PagedLOD*>(node.get());
    if (!paged) {
        node->addChild(own);
        return node;
    }
    const Extents e = extentsOf(database, key);
    paged->setCenter(place(database, 0.5 * (e.south + e.north), 0.5 * (e.west + e.east) - turn, 0.0));
    const auto cut = static_cast<float>(hasFile ? database.range * radiusOf(database, key.level) : 0.0);
    paged->addChild(own, cut, kFar);
    if (!hasFile) return node;
    paged->setFileName(1, fileName(key));
    paged->setRange(1, 0.0f, cut);
    if (database.isLoaded) paged->addChild(content(key));
    return node;
}

osg::ref_ptr<osg::Node> Builder::content(const TileKey& parent) const {
    const DatabaseSpec& database = spec(parent);
    osg::ref_ptr<osg::Node> root;
    if (database.fileShape == FileShape::Whole) {
        root = makeMesh(database, parent, _description.turnOf(parent), 2 * database.posts - 1, "#fine ");
    } else {
        const osg::ref_ptr<osg::Group> group = named<osg::Group>(nodeName(Hook::File, parent));
        for (int i = 0; i < 4; ++i) {
            const TileKey quarter = parent.quarter(i);
            const osg::ref_ptr<osg::Node> tile = wrappedTile(quarter);
            if (database.fileShape == FileShape::Slots) {
                const osg::ref_ptr<osg::Group> slot = named<osg::Group>(nodeName(Hook::Slot, quarter));
                slot->addChild(tile);
                group->addChild(slot);
            } else {
                group->addChild(tile);
            }
        }
        root = group;
    }
    return root;
}

osg::ref_ptr<osg::Node> Builder::file(const std::string& name) const {
    TileKey key;
    if (std::sscanf(name.c_str(), "scene_%d.%d.%d.%d.osgb", &key.database, &key.level, &key.column, &key.row) != 4)
        return nullptr;
    const osg::ref_ptr<osg::Node> root = content(key);
    decorate(*root);
    return root;
}

/// Another mesh of the same extents.
osg::ref_ptr<osg::Node> Builder::other(const TileKey& tile) const {
    return makeMesh(spec(tile), tile, _description.turnOf(tile), spec(tile).posts, "#other ");
}

osg::ref_ptr<osg::Node> Builder::wrap(const Part& part, osg::Node& node) const {
    const DatabaseSpec& database = spec(part.tile);
    const std::string name = ' ' + std::to_string(part.id);
    switch (part.kind) {
        case PartKind::Switch: {
            const osg::ref_ptr<osg::Switch> above = named<osg::Switch>("#switch " + part.tile.text());
            above->addChild(&node, part.variant == 0);
            if (part.variant != 2) above->addChild(other(part.tile), part.variant != 0);
            return above;
        }
        case PartKind::Sequence: {
            const osg::ref_ptr<osg::Sequence> above = named<osg::Sequence>("#sequence" + name);
            above->addChild(&node, 1.0);
            above->addChild(other(part.tile), 1.0);
            above->setInterval(osg::Sequence::LOOP, 0, -1);
            above->setDuration(1.0f, -1);
            above->setMode(osg::Sequence::START);
            return above;
        }
        case PartKind::Lod: {
            const osg::ref_ptr<osg::LOD> above = named<osg::LOD>("#lod" + name);
            const auto cut = static_cast<float>(part.amount * radiusOf(database, part.tile.level));
            above->addChild(&node, 0.0f, cut);
            above->addChild(other(part.tile), cut, kFar);
            return above;
        }
        case PartKind::Paged: {
            const osg::ref_ptr<osg::PagedLOD> above = named<osg::PagedLOD>("#paged" + name);
            above->addChild(&node, 0.0f, kFar);
            return above;
        }
        case PartKind::Proxy: {
            const osg::ref_ptr<osg::ProxyNode> above = named<osg::ProxyNode>("#proxy" + name);
            above->addChild(&node);
            return above;
        }
        case PartKind::PlainGroup: {
            const osg::ref_ptr<osg::Group> above = named<osg::Group>("#group" + name);
            above->addChild(&node);
            return above;
        }
        case PartKind::Turned: {
            const osg::ref_ptr<osg::Group> above =
                transformed("#turned" + name, turned(database, part.amount), part.variant);
            above->addChild(&node);
            return above;
        }
        case PartKind::MovingTiles: {
            const osg::ref_ptr<osg::MatrixTransform> above = named<osg::MatrixTransform>("#moving" + name);
            above->setDataVariance(osg::Object::DYNAMIC);
            above->setUpdateCallback(new Mover(osg::Matrixd(), osg::Vec3d(0.0, 0.0, part.amount), 0));
            above->addChild(&node);
            return above;
        }
        default:
            return &node;
    }
}

void Builder::decorate(osg::Node& subgraph) const {
    for (const Part& part : _description.parts) {
        if (part.frame == 0) applyPart(part, _description, subgraph);
    }
}

}  // namespace osgAnalyticBin::test
