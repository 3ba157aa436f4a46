// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Parts.h"

#include <osgAnalyticBin/HiddenByTerrainCallback.h>

#include <osgTerrain/GeometryTechnique>
#include <osgTerrain/ValidDataOperator>

#include <support/AnyScene.h>

namespace osgAnalyticBin::test {

namespace {

/// From the frame of a hook's children to the database's own.
osg::Matrixd frameOf(const Part& part, const Description& description, const osg::Node& node) {
    const DatabaseSpec& database = description.database(part.tile.database);
    const osg::Matrixd turn = turned(database, description.turnOf(part.tile));
    switch (part.hook) {
        case Hook::Root:
            return osg::Matrixd::inverse(database.toWorld(part.frame));
        case Hook::Globe:
            return {};
        case Hook::Mesh:
        case Hook::Geode: {
            const osg::Transform* mesh = node.asTransform();
            if (!mesh && node.getNumParents() > 0) mesh = node.getParent(0)->asTransform();
            const osg::MatrixTransform* transform = mesh ? mesh->asMatrixTransform() : nullptr;
            return transform ? transform->getMatrix() * turn : turn;
        }
        case Hook::File:
            return turned(database, description.turnOf(part.tile));
        case Hook::Slot:
            return turned(database, description.turnOf(part.tile.parent()));
        default:
            return turn;
    }
}

void addModel(const Part& part, const Description& description, osg::Node& node) {
    osg::Group* group = node.asGroup();
    if (!group) return;
    const DatabaseSpec& database = description.database(part.tile.database);
    const osg::ref_ptr<osg::Node> model = makeModel(database, part, frameOf(part, description, node));
    if (part.asks) model->addCullCallback(new HiddenByTerrainCallback);
    group->addChild(model);
}

// Towers on hills and in valleys, a few of which are drawn in front of all.
void addTraffic(const Part& part, const Description& description, osg::Node& node) {
    osg::Group* const group = node.asGroup();
    if (!group) return;
    const DatabaseSpec& database = description.database(part.tile.database);
    const osg::Matrixd frame = frameOf(part, description, node);
    const osg::ref_ptr<osg::Group> traffic = new osg::Group;
    traffic->setName("#model " + std::to_string(part.id));
    Random random(static_cast<std::uint64_t>(part.variant), static_cast<std::uint64_t>(part.id));
    constexpr int kModels = 24;
    for (int i = 0; i < kModels; ++i) {
        Part model = part;
        model.kind = random.chance(0.1) ? PartKind::Sign : random.chance(0.2) ? PartKind::Vehicle : PartKind::Tower;
        model.id = 1000 * (part.id + 1) + i;
        model.variant = random.chance(0.1) ? random.integer(1, 3) : 0;
        const Extents e = extentsOf(database, {part.tile.database, 0, random.integer(0, database.shownColumns - 1),
                                               database.firstRow + random.integer(0, database.rows - 1)});
        model.latitude = random.uniform(e.south, e.north);
        model.longitude = random.uniform(e.west, e.east);
        const double ground = surfaceHeight(database, model.latitude, model.longitude);
        model.low = ground + database.relief * random.uniform(-0.05, 0.3);
        model.high = model.low + part.amount * random.logUniform(0.1, 1.0);
        model.amount = random.uniform(0.0, 1.0) * part.amount;
        const osg::ref_ptr<osg::Node> made = makeModel(database, model, frame);
        made->addCullCallback(new HiddenByTerrainCallback);
        traffic->addChild(made);
    }
    group->addChild(traffic);
}

// Variants: masked; taken away; a plain group in its place; levels that are shown only from nearby; no mask any more.
void vanish(int variant, osg::Node& node) {
    if (variant % 4 == 0) return node.setNodeMask(variant == 0 ? 0 : ~0u);
    auto* const levels = dynamic_cast<osg::LOD*>(&node);
    for (unsigned int i = 0; variant == 3 && levels && i < levels->getNumRanges(); ++i) levels->setRange(i, 0.0f, 1.0f);
    if (variant == 3) return;
    const osg::ref_ptr<osg::Node> gone = &node;
    for (osg::Group* const parent : node.getParents())
        variant == 1 ? parent->removeChild(gone) : parent->replaceChild(gone, new osg::Group);
}

void alterDrawable(const Part& part, const Description& description, osg::Node& node) {
    osg::Drawable* const drawable = node.asDrawable();
    const DatabaseSpec& database = description.database(part.tile.database);
    if (drawable) alterMesh(part, database, description.turnOf(part.tile), *drawable);
}

// Shown from near.
void addHouses(const Part& part, const Description& description, osg::Node& node) {
    osg::Group* const group = node.asGroup();
    if (!group) return;
    const DatabaseSpec& database = description.database(part.tile.database);
    const Extents e = extentsOf(database, part.tile);
    const double unit = database.isMap ? 1.0 : std::max(database.equatorial, database.polar);
    const osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
    paged->setName("#objects " + std::to_string(part.id));
    paged->setCenter(place(database, part.latitude, part.longitude, part.high) *
                     osg::Matrixd::inverse(frameOfHouses(part, description)));
    paged->setRadius(static_cast<float>(2.0 * part.high + 0.5 * (e.north - e.south) * unit));
    paged->setFileName(0, "houses_" + std::to_string(part.id) + ".osgb");
    paged->setRange(0, 0.0f, static_cast<float>(part.amount));
    group->addChild(paged);
}

void storeBinOnDrawable(const Part& part, const Description& description, osg::Node& node) {
    osg::Geode* geode = node.asGeode();
    if (!geode || geode->getNumDrawables() == 0) return;
    const DatabaseSpec& database = description.database(part.tile.database);
    const Extents e = extentsOf(database, part.tile);
    const double depth = database.relief + sagOf(database, part.tile.level);
    setStoredBin(*geode->getDrawable(0),
                 AnalyticBin(core::GeodeticBin({e.south, e.north}, {e.west, e.east}, {-depth, database.relief})));
}

// Variants: mode and faces, and whether states below may say otherwise.
void setPolygonMode(const Part& part, osg::Node& node) {
    const bool isFill = part.kind == PartKind::Fill;
    const osg::PolygonMode::Mode mode = isFill                  ? osg::PolygonMode::FILL
                                        : part.variant % 4 == 3 ? osg::PolygonMode::POINT
                                                                : osg::PolygonMode::LINE;
    const bool isFrontOnly = !isFill && part.variant % 4 == 2;
    constexpr osg::StateAttribute::GLModeValue kValues[] = {osg::StateAttribute::ON,
                                                            osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE,
                                                            osg::StateAttribute::ON | osg::StateAttribute::PROTECTED};
    node.getOrCreateStateSet()->setAttribute(
        new osg::PolygonMode(isFrontOnly ? osg::PolygonMode::FRONT : osg::PolygonMode::FRONT_AND_BACK, mode),
        kValues[part.variant / 4 % 3]);
}

void expire(osg::Node& node) {
    auto* paged = dynamic_cast<osg::PagedLOD*>(&node);
    osg::NodeList removed;
    constexpr double kLate = 1e10;
    constexpr unsigned int kLateFrame = 1000000;
    if (paged) paged->removeExpiredChildren(kLate, kLateFrame, removed);
}

// The transform that a node is, or that is next above it in its database.
void shove(osg::Node& node, double angle) {
    osg::Node* at = &node;
    while (!at->asTransform() && at->getNumParents() > 0) at = at->getParent(0);
    auto* const transform = dynamic_cast<osg::MatrixTransform*>(at);
    if (!transform || transform->getName().rfind("#place", 0) == 0) return;
    transform->setMatrix(transform->getMatrix() * osg::Matrixd::rotate(angle, osg::Vec3d(0.0, 0.0, 1.0)));
}

void toggle(osg::Node& node) {
    auto* above = dynamic_cast<osg::Switch*>(&node);
    if (!above) return;
    for (unsigned int i = 0; i < above->getNumChildren(); ++i) above->setValue(i, !above->getValue(i));
}

class OtherTechnique : public osgTerrain::GeometryTechnique {};

// A layer of one height.
osg::ref_ptr<osgTerrain::Layer> layerOf(const osgTerrain::HeightFieldLayer& other, double height) {
    const osg::ref_ptr<osg::HeightField> field = new osg::HeightField(*other.getHeightField());
    std::fill(field->getHeightList().begin(), field->getHeightList().end(), static_cast<float>(height));
    const osg::ref_ptr<osgTerrain::Layer> layer = new osgTerrain::HeightFieldLayer(field);
    layer->setLocator(const_cast<osgTerrain::Locator*>(other.getLocator()));
    return layer;
}

osg::ref_ptr<osgTerrain::Layer> translucentImage(osgTerrain::Locator* locator) {
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(2, 2, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    std::fill_n(image->data(), image->getTotalSizeInBytes(), static_cast<unsigned char>(127));
    const osg::ref_ptr<osgTerrain::Layer> layer = new osgTerrain::ImageLayer(image);
    layer->setLocator(locator);
    return layer;
}

// Variants: without a technique; another technique; blended; other heights; a layer of them; a post without a height;
// an image that is seen through; a new technique of OSG's.
void setTileData(const Part& part, osgTerrain::TerrainTile& tile) {
    auto* const heights = dynamic_cast<osgTerrain::HeightFieldLayer*>(tile.getElevationLayer());
    if (!heights) return;
    osg::HeightField& field = *heights->getHeightField();
    constexpr float kNone = -9999.0f;
    switch (part.variant) {
        case 0:
            return tile.setTerrainTechnique(nullptr);
        case 1:
            return tile.setTerrainTechnique(new OtherTechnique);
        case 2:
            tile.setBlendingPolicy(osgTerrain::TerrainTile::ENABLE_BLENDING);
            break;
        case 3:
            std::fill(field.getHeightList().begin(), field.getHeightList().end(), static_cast<float>(part.amount));
            break;
        case 4:
            tile.setElevationLayer(layerOf(*heights, part.amount));
            break;
        case 5:
            field.setHeight(field.getNumColumns() / 2, field.getNumRows() / 2, kNone);
            heights->setValidDataOperator(new osgTerrain::NoDataValue(kNone));
            break;
        case 7:
            return tile.setTerrainTechnique(new osgTerrain::GeometryTechnique);
        default:
            tile.setColorLayer(0, translucentImage(heights->getLocator()));
    }
    tile.setDirty(true);
    tile.dirtyBound();
}

// Variants: blended; equal boundaries; fewer posts; another technique.
void setTileData(const Part& part, osgTerrain::Terrain& terrain) {
    switch (part.variant) {
        case 0:
            return terrain.setBlendingPolicy(osgTerrain::TerrainTile::ENABLE_BLENDING);
        case 1:
            return terrain.setEqualizeBoundaries(true);
        case 2:
            return terrain.setSampleRatio(0.5f);
        default:
            return terrain.setTerrainTechniquePrototype(new OtherTechnique);
    }
}

std::string targetOf(const Part& part) {
    if (part.kind == PartKind::Toggle) return "#switch " + part.tile.text();
    if (part.kind == PartKind::Move) return "#place " + std::to_string(part.tile.database);
    return nodeName(part.hook, part.tile);
}

// OSG does not store that a camera computes no near and far planes. Those that it computes follow from what is
// delivered: where a nested camera draws into the depths of the view, other culling shows another picture.
void keepNearAndFar(const osg::Group& scene, osg::Group& loaded) {
    for (unsigned int i = 0; i < scene.getNumChildren(); ++i) {
        const osg::Camera* const from = scene.getChild(i)->asCamera();
        osg::Camera* const to = loaded.getChild(i)->asCamera();
        const bool isOwn = from && !(from->getInheritanceMask() & osg::CullSettings::COMPUTE_NEAR_FAR_MODE);
        if (isOwn && to) to->setComputeNearFarMode(from->getComputeNearFarMode());
    }
}

}  // namespace

osg::Matrixd frameOfHouses(const Part& part, const Description& description) {
    if (part.hook == Hook::Globe) return {};
    const TileKey tile = part.hook == Hook::Slot ? part.tile.parent() : part.tile;
    return turned(description.database(part.tile.database), description.turnOf(tile));
}

osg::Node* findNode(osg::Node& subgraph, const std::string& name) {
    osg::Node* found = nullptr;
    walk(subgraph, [&](osg::Node& node) {
        if (!found && node.getName() == name) found = &node;
        return !found;
    });
    return found;
}

void applyPart(const Part& part, const Description& description, osg::Node& subgraph) {
    osg::Node* const node = findNode(subgraph, targetOf(part));
    if (!node) return;
    switch (part.kind) {
        case PartKind::CullingOff:
            return node->setCullingActive(false);
        case PartKind::DrawableBin:
            return storeBinOnDrawable(part, description, *node);
        case PartKind::Outline:
        case PartKind::Fill:
            return setPolygonMode(part, *node);
        case PartKind::State:
            return setState(part.variant, part.value, *node->getOrCreateStateSet());
        case PartKind::Vanish:
            return vanish(part.variant, *node);
        case PartKind::MeshHole:
        case PartKind::ReversedFaces:
        case PartKind::Raise:
            if (part.frame > 0) alterDrawable(part, description, *node);
            return;
        case PartKind::Objects:
            return addHouses(part, description, *node);
        case PartKind::Tower:
        case PartKind::Vehicle:
        case PartKind::Sign:
        case PartKind::Unculled:
            return addModel(part, description, *node);
        case PartKind::Traffic:
            return addTraffic(part, description, *node);
        case PartKind::Toggle:
            return toggle(*node);
        case PartKind::SetScale:
            if (auto* terrain = dynamic_cast<osgTerrain::Terrain*>(node))
                terrain->setVerticalScale(static_cast<float>(part.amount));
            return;
        case PartKind::TileData:
            if (auto* tile = dynamic_cast<osgTerrain::TerrainTile*>(node)) setTileData(part, *tile);
            if (auto* terrain = dynamic_cast<osgTerrain::Terrain*>(node)) setTileData(part, *terrain);
            return;
        case PartKind::Expire:
            return expire(*node);
        case PartKind::Shove:
            return shove(*node, part.amount);
        case PartKind::Move:
            if (auto* above = dynamic_cast<osg::MatrixTransform*>(node))
                above->setMatrix(above->getMatrix() * osg::Matrixd::translate(part.amount, 0.0, 0.0));
            return;
        default:
            return addCallback(part, *node);
    }
}

void removePart(const Part& part, osg::Node& scene) {
    osg::Node* const found = findNode(scene, "#model " + std::to_string(part.id));
    if (!found) return;
    const osg::ref_ptr<osg::Node> model = found;
    while (model->getNumParents() > 0) model->getParent(0)->removeChild(model.get());
}

osg::ref_ptr<osg::Group> savedAndLoaded(const osg::Group& scene, bool asText) {
    const osg::ref_ptr<osg::Node> loaded = writtenAndRead(scene, asText);
    if (!loaded || !loaded->asGroup()) throw std::runtime_error("the scene cannot be saved and loaded");
    keepNearAndFar(scene, *loaded->asGroup());
    return loaded->asGroup();
}

osg::ref_ptr<osg::Group> clonedScene(const osg::Group& scene, int variant) {
    constexpr osg::CopyOp::CopyFlags kFlags[] = {osg::CopyOp::DEEP_COPY_NODES | osg::CopyOp::DEEP_COPY_CALLBACKS,
                                                 osg::CopyOp::SHALLOW_COPY, osg::CopyOp::DEEP_COPY_ALL,
                                                 osg::CopyOp::DEEP_COPY_NODES};
    return osg::clone(&scene, osg::CopyOp(kFlags[variant % 4]));
}

}  // namespace osgAnalyticBin::test
