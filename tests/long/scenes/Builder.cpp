// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Builder.h"

#include "Painter.h"
#include "Parts.h"

#include <osg/PositionAttitudeTransform>
#include <osg/ProxyNode>

namespace osgAnalyticBin::test {

namespace {

constexpr float kFar = 1e10f;
constexpr int kEmptyFile = 2;
constexpr const char* kMapProjection = "PROJCS[\"WGS 84 / UTM zone 33N\",GEOGCS[\"WGS 84\"]]";

std::string fileName(const TileKey& parent) {
    return "scene_" + parent.text() + ".osgb";
}

bool hasEqualNames(const Description& description, int database) {
    return std::any_of(description.parts.begin(), description.parts.end(), [&](const Part& part) {
        return part.kind == PartKind::EqualNames && part.tile.database == database;
    });
}

/// The content of a file whose name does not tell what it is.
class ContentOfTile : public osgDB::ReadFileCallback {
public:
    ContentOfTile(const Builder& builder, const TileKey& tile) : _builder(builder), _tile(tile) {}
    osgDB::ReaderWriter::ReadResult readNode(const std::string& /*name*/, const osgDB::Options* /*options*/) override {
        return osgDB::ReaderWriter::ReadResult(_builder.file(_tile).get());
    }

private:
    const Builder& _builder;
    const TileKey _tile;
};

void giveEqualName(osg::PagedLOD& paged, const Builder& builder, const TileKey& tile) {
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    options->setObjectCacheHint(osgDB::Options::CACHE_ALL);
    options->setReadFileCallback(new ContentOfTile(builder, tile));
    paged.setDatabaseOptions(options);
    paged.setFileName(1, "equal.osgb");
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
    const osg::ref_ptr<osgTerrain::Terrain> terrain =
        database.mesh == MeshKind::Terrain ? new osgTerrain::Terrain : nullptr;
    if (terrain) terrain->setVerticalScale(static_cast<float>(database.verticalScale));
    const osg::ref_ptr<osg::CoordinateSystemNode> globe = terrain ? terrain.get() : new osg::CoordinateSystemNode;
    globe->setName(nodeName(Hook::Globe, {number, 0, 0, 0}));
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
        above->setUpdateCallback(makeMover(here, step, 0));
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
    if (part.variant % 2 == 1) camera->setTransformOrder(osg::Camera::POST_MULTIPLY);
    const osg::Camera::RenderOrder order = kOrders[part.variant / 3 % 3];
    camera->setRenderOrder(order);
    camera->setViewMatrix(part.view);
    camera->setProjectionMatrix(part.projection);
    if (order != osg::Camera::NESTED_RENDER)
        camera->setViewport(kInnerPictureStart, 0, kInnerPictureSize, kInnerPictureSize);
    if (part.variant < kFixedCameras) camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    return camera;
}

osg::ref_ptr<osg::Group> makeGroup(int kind) {
    using Made = osg::ref_ptr<osg::Group>;
    const std::array<Made, kGroupClasses> classes{
        new osg::Group, new osg::MatrixTransform, new osg::PositionAttitudeTransform,
        new osg::Geode, new osg::Switch,          new CastingGroup};
    return classes[static_cast<std::size_t>(kind)];
}

// Each group is above four of the next level. Returns: the lowest above a tile.
osg::Group& groupAbove(const TileKey& tile, int depth, int kind, osg::Group& globe,
                       std::map<std::string, osg::ref_ptr<osg::Group>>& groups) {
    if (depth == 0) return globe;
    const TileKey above = tile.parent();
    const std::string name = nodeName(Hook::Above, above);
    osg::ref_ptr<osg::Group>& group = groups[name];
    if (!group) {
        group = makeGroup(kind);
        group->setName(name);
        groupAbove(above, depth - 1, kind, globe, groups).addChild(group);
    }
    return *group;
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
    const DatabaseSpec& database = _description.database(number);
    const osg::ref_ptr<osg::CoordinateSystemNode> globe = makeGlobe(database, number);
    addTiles(number, *globe);
    return placed(database, number, *globe);
}

void Builder::addTiles(int number, osg::Group& globe) const {
    const DatabaseSpec& database = _description.database(number);
    const auto isTree = [&](const Part& part) {
        return part.kind == PartKind::GroupTree && part.tile.database == number;
    };
    const auto tree = std::find_if(_description.parts.begin(), _description.parts.end(), isTree);
    const int depth = tree == _description.parts.end() ? 0 : tree->variant;
    const int kind = depth == 0 ? 0 : static_cast<int>(tree->amount);
    std::map<std::string, osg::ref_ptr<osg::Group>> groups;
    for (int row = 0; row < database.rows; ++row) {
        std::vector<osg::ref_ptr<osg::Node>> own;
        std::vector<osg::Node*> tiles;
        for (int column = 0; column < database.shownColumns; ++column) {
            own.push_back(wrappedTile({number, 0, column, row}));
            tiles.push_back(own.back());
        }
        for (int column = 0; column < database.shownColumns; ++column) {
            const TileKey tile{number, 0, column, row};
            groupAbove(tile, depth, kind, globe, groups).addChild(rootTile(tile, tiles));
        }
    }
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
    for (const Part& part : _description.parts)
        if (part.frame == 0 && part.tile == key) node = wrap(part, *node);
    return node;
}

osg::ref_ptr<osg::Node> Builder::tile(const TileKey& key) const {
    const DatabaseSpec& database = spec(key);
    const double turn = _description.turnOf(key);
    osg::ref_ptr<osg::Node> own = mesh(key, database.posts);
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
    paged->addChild(own, find(PartKind::Adding, key) ? 0.0f : cut, kFar);
    if (!hasFile) return node;
    paged->setFileName(1, fileName(key));
    if (hasEqualNames(_description, key.database)) giveEqualName(*paged, *this, key);
    paged->setRange(1, 0.0f, cut);
    if (database.isLoaded) paged->addChild(content(key));
    return node;
}

osg::ref_ptr<osg::Node> Builder::content(const TileKey& parent) const {
    const DatabaseSpec& database = spec(parent);
    const Part* const adding = find(PartKind::Adding, parent);
    if (adding && adding->variant > 0) return houses(*adding);
    if (database.fileShape == FileShape::Whole) return mesh(parent, 2 * database.posts - 1, "#fine ");
    const osg::ref_ptr<osg::Group> group = named<osg::Group>(nodeName(Hook::File, parent));
    for (int i = 0; i < 4; ++i) {
        const TileKey quarter = parent.quarter(i);
        osg::ref_ptr<osg::Group> slot = group;
        if (database.fileShape == FileShape::Slots)
            group->addChild(slot = named<osg::Group>(nodeName(Hook::Slot, quarter)));
        slot->addChild(wrappedTile(quarter));
    }
    return group;
}

osg::ref_ptr<osg::Node> Builder::file(const std::string& name) const {
    int number = 0;
    if (std::sscanf(name.c_str(), "houses_%d.osgb", &number) == 1) {
        for (const Part& part : _description.parts)
            if (part.id == number) return houses(part);
        return nullptr;
    }
    TileKey key;
    if (std::sscanf(name.c_str(), "scene_%d.%d.%d.%d.osgb", &key.database, &key.level, &key.column, &key.row) != 4)
        return nullptr;
    return file(key);
}

osg::ref_ptr<osg::Node> Builder::file(const TileKey& parent) const {
    const osg::ref_ptr<osg::Node> root = content(parent);
    decorate(*root);
    return root;
}

/// Another mesh of the same extents.
osg::ref_ptr<osg::Node> Builder::other(const TileKey& tile) const {
    return mesh(tile, spec(tile).posts, "#other ");
}

const Part* Builder::find(PartKind kind, const TileKey& tile) const {
    const auto isIt = [&](const Part& part) { return part.kind == kind && part.frame == 0 && part.tile == tile; };
    const auto found = std::find_if(_description.parts.begin(), _description.parts.end(), isIt);
    return found == _description.parts.end() ? nullptr : &*found;
}

// Parts change the tile's own mesh, or those that may stand in its place.
osg::ref_ptr<osg::Node> Builder::mesh(const TileKey& tile, int posts, const std::string& name) const {
    const bool isOwn = name == "#";
    MeshShape shape{posts, name};
    const auto isMeant = [&](const Part* part) { return part && (part->hook != Hook::File) == isOwn; };
    const Part* const narrow = find(PartKind::NarrowTile, tile);
    if (isMeant(narrow)) shape.narrower = narrow->amount;
    shape.drawsNothing = isMeant(find(PartKind::DrawsNothing, tile));
    const osg::ref_ptr<osg::Node> made = makeMesh(spec(tile), tile, _description.turnOf(tile), shape);
    osg::Node* const geode = findNode(*made, name + "geode " + tile.text());
    for (const PartKind kind : {PartKind::MeshHole, PartKind::ReversedFaces}) {
        const Part* const part = find(kind, tile);
        if (isMeant(part) && geode)
            alterMesh(*part, spec(tile), _description.turnOf(tile), *geode->asGeode()->getDrawable(0));
    }
    const Part* const caster = find(PartKind::Caster, tile);
    if (!isOwn || !caster || caster->hook != Hook::Mesh) return made;
    const osg::ref_ptr<osg::Group> above = new CastingGroup;
    above->setName("#caster " + std::to_string(caster->id));
    above->addChild(made);
    return above;
}

// Small towers in a row.
osg::ref_ptr<osg::Node> Builder::houses(const Part& part) const {
    const osg::ref_ptr<osg::Group> group = named<osg::Group>("#houses " + std::to_string(part.id));
    constexpr int kCount = 4;
    if (part.variant == kEmptyFile) return group;
    const Extents e = extentsOf(spec(part.tile), part.tile);
    const osg::Matrixd toDatabase = frameOfHouses(part, _description);
    for (int i = 0; i < kCount; ++i) {
        Part house = part;
        house.kind = PartKind::Tower;
        house.variant = 0;
        house.id = 1000 * (part.id + 1) + i;
        house.latitude += 0.1 * (i - 1.5) * (e.north - e.south);
        group->addChild(makeModel(spec(part.tile), house, toDatabase));
    }
    return group;
}

osg::ref_ptr<osg::Node> Builder::wrap(const Part& part, osg::Node& node) const {
    const auto below = [&](const osg::ref_ptr<osg::Group>& above, const char* word) {
        above->setName(std::string(word) + std::to_string(part.id));
        above->addChild(&node);
        return above;
    };
    switch (part.kind) {
        case PartKind::Switch: {
            const osg::ref_ptr<osg::Switch> above = named<osg::Switch>("#switch " + part.tile.text());
            above->addChild(&node, part.variant == 0);
            if (part.variant != 2) above->addChild(other(part.tile), part.variant != 0);
            return above;
        }
        case PartKind::Sequence: {
            const osg::ref_ptr<osg::Sequence> above = new osg::Sequence;
            (void)below(above, "#sequence ");
            above->addChild(other(part.tile));
            for (const unsigned int i : {0u, 1u}) above->setTime(i, 1.0);
            above->setInterval(osg::Sequence::LOOP, 0, -1);
            above->setDuration(1.0f, -1);
            above->setMode(osg::Sequence::START);
            return above;
        }
        case PartKind::Lod: {
            const osg::ref_ptr<osg::LOD> above = new osg::LOD;
            const auto cut = static_cast<float>(part.amount * radiusOf(spec(part.tile), part.tile.level));
            (void)below(above, "#lod ");
            above->setRange(0, 0.0f, cut);
            above->addChild(other(part.tile), cut, kFar);
            return above;
        }
        case PartKind::Paged: {
            const osg::ref_ptr<osg::PagedLOD> above = new osg::PagedLOD;
            (void)below(above, "#paged ");
            above->setRange(0, 0.0f, kFar);
            return above;
        }
        case PartKind::Proxy:
            return below(new osg::ProxyNode, "#proxy ");
        case PartKind::PlainGroup:
            return below(new osg::Group, "#group ");
        case PartKind::Turned:
            return below(transformed("", turned(spec(part.tile), part.amount), part.variant), "#turned ");
        case PartKind::Caster:
            return part.hook == Hook::Tile ? below(new CastingGroup, "#caster ").get() : &node;
        case PartKind::MovingTiles: {
            const osg::ref_ptr<osg::MatrixTransform> above = new osg::MatrixTransform;
            above->setDataVariance(osg::Object::DYNAMIC);
            above->setUpdateCallback(makeMover(osg::Matrixd(), osg::Vec3d(0.0, 0.0, part.amount), 0));
            return below(above, "#moving ");
        }
        default:
            return &node;
    }
}

void Builder::decorate(osg::Node& subgraph) const {
    for (const Part& part : _description.parts)
        if (part.frame == 0) applyPart(part, _description, subgraph);
}

}  // namespace osgAnalyticBin::test
