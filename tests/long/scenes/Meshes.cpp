// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Parts.h"

#include <osg/PrimitiveSetIndirect>
#include <osgTerrain/Locator>

#include <kit/TileFixture.h>
#include <support/GridMesh.h>

namespace osgAnalyticBin::test {

namespace {

// Skirts are as deep as this part of a tile's width.
constexpr double kSkirtRatio = 0.2;

double skirtOf(const DatabaseSpec& database, int level) {
    const double width = database.tileWidth(level) * (database.isMap ? 1.0 : database.equatorial);
    return kSkirtRatio * width;
}

/// A class of the application's that draws nothing, whatever its arrays say.
class EmptyGeometry : public osg::Geometry {
public:
    EmptyGeometry() = default;
    EmptyGeometry(const EmptyGeometry& other, const osg::CopyOp& copyop) : osg::Geometry(other, copyop) {}
    [[nodiscard]] osg::Object* cloneType() const override { return new EmptyGeometry; }
    [[nodiscard]] osg::Object* clone(const osg::CopyOp& copyop) const override {
        return new EmptyGeometry(*this, copyop);
    }
    void drawImplementation(osg::RenderInfo& /*info*/) const override {}
};

/// Fills a geometry with a grid of posts, and skirts below its border.
struct MeshMaker {
    const DatabaseSpec& database;
    const TileKey& tile;
    double turn;
    const MeshShape& shape;
    osg::Vec3d origin;
    const int posts = shape.posts;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec2Array> texCoords = new osg::Vec2Array;

    void add(double v, double u, double lower) {
        const Extents e = extentsOf(database, tile);
        const double latitude = e.south + v * (e.north - e.south);
        const double longitude = e.west + u * (1.0 - shape.narrower) * (e.east - e.west);
        const double height = surfaceHeight(database, latitude, longitude);
        vertices->push_back(osg::Vec3(place(database, latitude, longitude - turn, height - lower) - origin));
        texCoords->push_back(osg::Vec2(static_cast<float>(u), static_cast<float>(v)));
    }

    osg::ref_ptr<osg::Geometry> make() {
        const osg::ref_ptr<osg::Geometry> geometry = shape.drawsNothing ? new EmptyGeometry : new osg::Geometry;
        for (int j = 0; j < posts; ++j)
            for (int i = 0; i < posts; ++i) add(j / (posts - 1.0), i / (posts - 1.0), 0.0);
        geometry->setVertexArray(vertices);
        geometry->setTexCoordArray(0, texCoords);
        geometry->addPrimitiveSet(gridTriangles(static_cast<unsigned int>(posts)));
        if (database.hasSkirts) addSkirt(*geometry);
        return geometry;
    }

    void addSkirt(osg::Geometry& geometry) {
        const osg::ref_ptr<osg::DrawElementsUInt> skirt =
            new osg::DrawElementsUInt(database.hasQuads ? GL_QUAD_STRIP : GL_TRIANGLE_STRIP);
        const auto across = static_cast<unsigned int>(posts);
        const std::vector<unsigned int> border = gridBorder(across);
        const auto first = static_cast<unsigned int>(vertices->size());
        for (const unsigned int post : border)
            add((post / across) / (posts - 1.0), (post % across) / (posts - 1.0), skirtOf(database, tile.level));
        for (std::size_t i = 0; i <= border.size(); ++i) {
            const std::size_t at = i % border.size();
            skirt->push_back(border[at]);
            skirt->push_back(first + static_cast<unsigned int>(at));
        }
        geometry.addPrimitiveSet(skirt);
    }
};

osg::ref_ptr<osg::Node> makeTerrain(const DatabaseSpec& database, const TileKey& tile, double turn,
                                    const MeshShape& shape) {
    Extents e = extentsOf(database, tile);
    e.east -= shape.narrower * (e.east - e.west);
    const osg::ref_ptr<osgTerrain::Locator> locator = new osgTerrain::Locator;
    locator->setEllipsoidModel(new osg::EllipsoidModel(database.equatorial, database.polar));
    locator->setCoordinateSystemType(database.isMap ? osgTerrain::Locator::PROJECTED : osgTerrain::Locator::GEOCENTRIC);
    locator->setTransformAsExtents(e.west - turn, e.south, e.east - turn, e.north);
    const auto count = static_cast<unsigned int>(shape.posts);
    const auto node = makeTerrainTile(*locator, count, count, [&](unsigned int i, unsigned int j) {
        return static_cast<float>(surfaceHeight(database, e.south + j * (e.north - e.south) / (count - 1),
                                                e.west + i * (e.east - e.west) / (count - 1)));
    });
    if (database.hasSkirts) heightsOf(*node).setSkirtHeight(static_cast<float>(skirtOf(database, tile.level)));
    node->setLocator(locator);
    return node;
}

/// A tapered tower of several storeys, so that there are vertices all along it.
osg::ref_ptr<osg::Geometry> makeTower(double height, double width) {
    constexpr int kStoreys = 6;
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    const osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (int storey = 0; storey <= kStoreys; ++storey) {
        const double z = height * storey / kStoreys;
        for (const auto& [x, y] : {std::array{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
            vertices->push_back(osg::Vec3d(0.5 * x * width, 0.5 * y * width, z));
        if (storey == 0) continue;
        const auto below = static_cast<unsigned int>(4 * (storey - 1));
        for (unsigned int i = 0; i < 4; ++i) {
            const unsigned int a = below + i, b = below + (i + 1) % 4;
            for (const unsigned int k : {a, b, b + 4, a, b + 4, a + 4}) triangles->push_back(k);
        }
    }
    return makeGeometry(vertices, triangles);
}

// Gives a sign a state in which nearer terrain does not cover it. Its render bin is drawn last.
void ignoreDepth(int variant, osg::StateSet& states) {
    static constexpr std::array<const char*, 4> kNames{"depth test", "depth ALWAYS", "depth range in front",
                                                       "program that draws in front"};
    const bool isTest = variant % 4 == 0;
    setState(stateOf(kNames[static_cast<std::size_t>(variant % 4)]),
             isTest ? osg::StateAttribute::OFF : osg::StateAttribute::ON, states);
    constexpr int kLate = 20;
    states.setRenderBinDetails(kLate, "RenderBin");
}

// Turns a tower about its middle to the eye.
osg::ref_ptr<osg::Geode> makeBillboard(osg::Geometry& tower, double height, const Part& part) {
    const osg::Vec3 middle(0.0f, 0.0f, static_cast<float>(0.5 * height));
    for (osg::Vec3& vertex : static_cast<osg::Vec3Array&>(*tower.getVertexArray())) vertex -= middle;
    const osg::ref_ptr<osg::Billboard> billboard = new osg::Billboard;
    billboard->setMode(static_cast<osg::Billboard::Mode>(part.variant % 3));
    billboard->addDrawable(&tower, middle);
    return billboard;
}

/// The square that a triangle of a grid is in.
struct Cell {
    unsigned int column = 0, row = 0;
    bool isUpper = false;  // of its two triangles
};

bool isInHole(const Cell& cell, unsigned int cells, int variant) {
    const unsigned int middle = cells / 2;
    const auto isInner = [&](unsigned int i) { return i > 0 && i + 1 < cells; };
    switch (variant) {
        case 0:  // one triangle
            return cell.column == middle && cell.row == middle && cell.isUpper;
        case 1:  // a block
            return cell.column >= middle && cell.row >= middle && cell.column < middle + 2 && cell.row < middle + 2;
        case 2:  // half of the mesh
            return cell.column < (cells + 1) / 2;
        case 3:  // all but what is along the border
            return isInner(cell.column) && isInner(cell.row);
        default:  // a triangle at the border
            return cell.column == middle && cell.row == 0 && !cell.isUpper;
    }
}

// Nobody knows which triangles are drawn: the diagonals of quads are the driver's, and this command draws none.
constexpr int kQuads = 5, kByCommand = 6;

void drawOtherwise(osg::Geometry& geometry, const osg::DrawElementsUInt& triangles, unsigned int cells, int variant) {
    if (variant == kByCommand) {
        const osg::ref_ptr<osg::DrawElementsIndirectUInt> command = new osg::DrawElementsIndirectUInt(GL_TRIANGLES);
        command->assign(triangles.begin(), triangles.end());
        return static_cast<void>(geometry.setPrimitiveSet(0, command));
    }
    const osg::ref_ptr<osg::DrawElementsUInt> quads = new osg::DrawElementsUInt(GL_QUADS);
    const unsigned int posts = cells + 1;
    for (unsigned int i = 0; i + posts + 1 < posts * posts; ++i) {
        if (i % posts == cells) continue;
        for (const unsigned int corner : {i, i + 1, i + posts + 1, i + posts}) quads->push_back(corner);
    }
    geometry.setPrimitiveSet(0, quads);
}

// The grid's triangles are in the first primitive set; see gridTriangles().
void cutHole(osg::Geometry& geometry, int variant) {
    auto* const triangles = dynamic_cast<osg::DrawElementsUInt*>(geometry.getPrimitiveSet(0));
    if (!triangles || triangles->size() % 6 != 0) return;
    const auto cells = static_cast<unsigned int>(std::lround(std::sqrt(static_cast<double>(triangles->size() / 6))));
    if (variant == kQuads || variant == kByCommand) return drawOtherwise(geometry, *triangles, cells, variant);
    osg::ref_ptr<osg::DrawElementsUInt> kept = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (unsigned int i = 0; i + 2 < triangles->size(); i += 3) {
        const Cell cell{i / 6 % cells, i / 6 / cells, i % 6 != 0};
        if (!isInHole(cell, cells, variant))
            kept->insert(kept->end(), triangles->begin() + i, triangles->begin() + i + 3);
    }
    geometry.setPrimitiveSet(0, kept);
}

void reverseFaces(osg::Geometry& geometry) {
    auto* const triangles = dynamic_cast<osg::DrawElementsUInt*>(geometry.getPrimitiveSet(0));
    if (!triangles) return;
    for (std::size_t i = 0; i + 2 < triangles->size(); i += 3) std::swap((*triangles)[i + 1], (*triangles)[i + 2]);
    triangles->dirty();
}

// All in one direction, that of the tile's middle.
void raiseVertices(const Part& part, const DatabaseSpec& database, double turn, osg::Geometry& geometry) {
    auto* const vertices = dynamic_cast<osg::Vec3Array*>(geometry.getVertexArray());
    if (!vertices) return;
    const Extents e = extentsOf(database, part.tile);
    const double latitude = 0.5 * (e.south + e.north), longitude = 0.5 * (e.west + e.east) - turn;
    const osg::Vec3d up =
        osg::Matrixd::transform3x3(osg::Vec3d(0.0, 0.0, part.amount), localFrame(database, latitude, longitude, 0.0));
    for (osg::Vec3& vertex : *vertices) vertex += up;
    vertices->dirty();
}

}  // namespace

Extents extentsOf(const DatabaseSpec& database, const TileKey& tile) {
    const double width = database.tileWidth(tile.level);
    const double south = database.isMap ? 0.0 : -0.5 * osg::PI + database.firstRow * database.tileWidth(0);
    const double west = database.isMap ? 0.0 : -osg::PI;
    return {south + width * tile.row, south + width * (tile.row + 1), west + width * tile.column,
            west + width * (tile.column + 1)};
}

double surfaceHeight(const DatabaseSpec& database, double latitude, double longitude) {
    const double unit = database.waves / (database.isMap ? 5e4 : 1.0);
    return database.relief * std::sin(unit * latitude + 1.0) * std::cos(1.7 * unit * longitude);
}

osg::Vec3d place(const DatabaseSpec& database, double latitude, double longitude, double altitude) {
    if (database.isMap) return {longitude, latitude, altitude};
    osg::Vec3d result;
    const osg::EllipsoidModel model(database.equatorial, database.polar);
    model.convertLatLongHeightToXYZ(latitude, longitude, altitude, result.x(), result.y(), result.z());
    return result;
}

osg::Matrixd localFrame(const DatabaseSpec& database, double latitude, double longitude, double altitude) {
    const osg::Vec3d at = place(database, latitude, longitude, altitude);
    if (database.isMap) return osg::Matrixd::translate(at);
    const osg::Vec3d up(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                        std::sin(latitude));
    const osg::Vec3d east(-std::sin(longitude), std::cos(longitude), 0.0);
    const osg::Vec3d north = up ^ east;
    return {east.x(), east.y(), east.z(), 0.0, north.x(), north.y(), north.z(), 0.0,
            up.x(),   up.y(),   up.z(),   0.0, at.x(),    at.y(),    at.z(),    1.0};
}

osg::Matrixd turned(const DatabaseSpec& database, double amount) {
    return database.isMap ? osg::Matrixd::translate(amount, 0.0, 0.0)
                          : osg::Matrixd::rotate(amount, osg::Vec3d(0.0, 0.0, 1.0));
}

double sagOf(const DatabaseSpec& database, int level) {
    if (database.isMap) return 0.0;
    // the diagonal of a cell
    const double angle = 1.4143 * database.tileWidth(level) / (database.posts - 1);
    const double radius =
        std::max(database.equatorial, database.polar) * std::max(1.0, database.equatorial / database.polar);
    return 1.1 * radius * (1.0 - std::cos(std::min(0.5 * angle, 1.5)));
}

osg::ref_ptr<osg::Node> makeMesh(const DatabaseSpec& database, const TileKey& tile, double turn,
                                 const MeshShape& shape) {
    const std::string& name = shape.name;
    if (database.mesh == MeshKind::Terrain) {
        const osg::ref_ptr<osg::Node> terrain = makeTerrain(database, tile, turn, shape);
        terrain->setName(name + "mesh " + tile.text());
        return terrain;
    }
    const Extents e = extentsOf(database, tile);
    const bool isLocal = database.mesh == MeshKind::Local;
    const osg::Vec3d middle = place(database, 0.5 * (e.south + e.north), 0.5 * (e.west + e.east) - turn, 0.0);
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->setName(name + "geode " + tile.text());
    const osg::ref_ptr<osg::Geometry> geometry =
        MeshMaker{database, tile, turn, shape, isLocal ? middle : osg::Vec3d()}.make();
    geometry->setName(name + "drawable " + tile.text());
    geode->addDrawable(geometry);
    if (!isLocal) return geode;
    const osg::ref_ptr<osg::MatrixTransform> mesh = new osg::MatrixTransform(osg::Matrixd::translate(middle));
    mesh->setDataVariance(osg::Object::STATIC);
    mesh->setName(name + "mesh " + tile.text());
    mesh->addChild(geode);
    return mesh;
}

void alterMesh(const Part& part, const DatabaseSpec& database, double turn, osg::Drawable& drawable) {
    osg::Geometry* const geometry = drawable.asGeometry();
    if (!geometry || geometry->getNumPrimitiveSets() == 0) return;
    switch (part.kind) {
        case PartKind::MeshHole:
            cutHole(*geometry, part.variant);
            break;
        case PartKind::ReversedFaces:
            reverseFaces(*geometry);
            break;
        case PartKind::Raise:
            raiseVertices(part, database, turn, *geometry);
            break;
        default:
            return;
    }
    geometry->dirtyGLObjects();
    geometry->dirtyBound();
}

osg::ref_ptr<osg::Node> makeModel(const DatabaseSpec& database, const Part& part, const osg::Matrixd& toDatabase) {
    const double height = part.high - part.low;
    const bool isSign = part.kind == PartKind::Sign;
    const osg::ref_ptr<osg::Geometry> tower =
        makeTower(height, isSign ? part.amount : std::max(0.05 * height, 300.0 * database.scale()));
    tower->setName("#tower " + std::to_string(part.id));
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    if (part.variant != 0 && !isSign)
        geode = makeBillboard(*tower, height, part);
    else
        geode->addDrawable(tower);
    const osg::Matrixd here =
        localFrame(database, part.latitude, part.longitude, part.low) * osg::Matrixd::inverse(toDatabase);
    const osg::ref_ptr<osg::MatrixTransform> model = new osg::MatrixTransform(here);
    model->setName("#model " + std::to_string(part.id));
    model->addChild(geode);
    if (isSign) ignoreDepth(part.variant, *model->getOrCreateStateSet());
    if (part.kind == PartKind::Unculled) model->setCullingActive(false);
    const bool isMoving = part.kind == PartKind::Vehicle;
    model->setDataVariance(isMoving ? osg::Object::DYNAMIC : osg::Object::STATIC);
    if (isMoving) model->setUpdateCallback(makeMover(here, osg::Vec3d(part.amount, 0.0, 0.0), part.frame));
    return model;
}

}  // namespace osgAnalyticBin::test
