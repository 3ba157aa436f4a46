// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osg/Billboard>
#include <osg/CoordinateSystemNode>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/LOD>
#include <osg/LightSource>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osg/Switch>
#include <osgDB/WriteFile>

#include <cfloat>
#include <cmath>
#include <support/GridMesh.h>
#include <support/SceneryDatabase.h>
#include <utility>
#include <vector>

namespace osgAnalyticBin::test {

namespace {

constexpr int kTileColumns = 8, kTileRows = 6;
constexpr double kWidthDeg = 0.25, kHeightDeg = 0.125;
constexpr int kNearPosts = 17, kFarPosts = 5;
constexpr float kTileRange = 60000.0f, kWoodRange = 25000.0f, kTreeRange = 8000.0f, kHouseRange = 10000.0f;
const double kDegree = osg::PI / 180.0;

// Places within a tile, as shares of its width and height from the south-west.
struct Place {
    double east, north;
};

double groundAt(double latitude, double longitude) {
    return 150.0 + 150.0 * std::sin(latitude * 900.0 * kDegree) * std::cos(longitude * 700.0 * kDegree);
}

class Tile {
public:
    Tile(int row, int column)
        : _south(row * kHeightDeg), _west(column * kWidthDeg), _number(row * kTileColumns + column) {
        const double latitude = (_south + 0.5 * kHeightDeg) * kDegree;
        const double longitude = (_west + 0.5 * kWidthDeg) * kDegree;
        _ellipsoid->computeLocalToWorldTransformFromLatLongHeight(latitude, longitude, 0.0, _toEcef);
        _toLocal.invert(_toEcef);
    }

    // The content of the tile's file.
    [[nodiscard]] osg::ref_ptr<osg::Node> make() const {
        const osg::ref_ptr<osg::MatrixTransform> tile = new osg::MatrixTransform(_toEcef);
        tile->addChild(land(kNearPosts));
        tile->addChild(wood());
        for (int i = 0; i < 6; ++i) tile->addChild(house({0.1 + 0.15 * i, 0.15 + 0.12 * ((i * 5) % 7)}));
        if (_number % 4 == 0) tile->addChild(airfield());
        tile->addChild(sign());
        tile->addChild(bushes());
        if (_number % 5 == 0) tile->addChild(mill());
        return tile;
    }

    // What is drawn from afar.
    [[nodiscard]] osg::ref_ptr<osg::Node> makeFar() const {
        const osg::ref_ptr<osg::MatrixTransform> tile = new osg::MatrixTransform(_toEcef);
        tile->addChild(land(kFarPosts));
        return tile;
    }

    // Around all that the tile may hold.
    [[nodiscard]] osg::BoundingSphere sphere() const {
        return {_toEcef.getTrans(), static_cast<float>(0.75 * kWidthDeg * 111320.0)};
    }

private:
    // In the tile's frame.
    [[nodiscard]] osg::Vec3d at(const Place& place, double above = 0.0) const {
        const double latitude = _south + place.north * kHeightDeg, longitude = _west + place.east * kWidthDeg;
        osg::Vec3d ecef;
        _ellipsoid->convertLatLongHeightToXYZ(latitude * kDegree, longitude * kDegree,
                                              groundAt(latitude, longitude) + above, ecef.x(), ecef.y(), ecef.z());
        return ecef * _toLocal;
    }

    [[nodiscard]] static osg::ref_ptr<osg::Geode> geodeOf(const osg::ref_ptr<osg::Vec3Array>& vertices,
                                                          osg::PrimitiveSet* primitives, const osg::Vec4& colour) {
        const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
        geometry->setVertexArray(vertices);
        const osg::ref_ptr<osg::Vec4Array> colours = new osg::Vec4Array(osg::Array::BIND_OVERALL);
        colours->push_back(colour);
        geometry->setColorArray(colours);
        geometry->addPrimitiveSet(primitives);
        const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
        geode->addDrawable(geometry);
        geode->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
        return geode;
    }

    // Quads that stand upright, as crosses.
    static void addCross(osg::Vec3Array& vertices, const osg::Vec3d& foot, float width, float height) {
        for (const auto& [x, y] : {std::pair(width, 0.0f), {0.0f, width}}) {
            for (const auto& [side, up] : {std::pair(-0.5f, 0.0f), {0.5f, 0.0f}, {0.5f, height}, {-0.5f, height}})
                vertices.push_back(osg::Vec3(foot) + osg::Vec3(side * x, side * y, up));
        }
    }

    [[nodiscard]] static osg::PrimitiveSet* quads(const osg::Vec3Array& vertices) {
        return new osg::DrawArrays(GL_QUADS, 0, static_cast<GLsizei>(vertices.size()));
    }

    [[nodiscard]] osg::ref_ptr<osg::Node> land(int posts) const {
        const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
        for (int j = 0; j < posts; ++j)
            for (int i = 0; i < posts; ++i) vertices->push_back(at({i / (posts - 1.0), j / (posts - 1.0)}));
        const auto triangles = gridTriangles<osg::DrawElementsUShort>(static_cast<unsigned int>(posts));
        const float shade = 0.4f + 0.3f * static_cast<float>(_number % 3);
        return geodeOf(vertices, triangles, {0.3f, shade, 0.2f, 1.0f});
    }

    // Quarters of the tile, and in each of them clumps of trees that are drawn from near alone.
    [[nodiscard]] osg::ref_ptr<osg::Node> wood() const {
        const osg::ref_ptr<osg::Group> all = new osg::Group;
        for (int quarter = 0; quarter < 4; ++quarter) {
            const osg::ref_ptr<osg::Group> clumps = new osg::Group;
            for (int i = 0; i < 4; ++i) {
                const Place corner{0.5 * (quarter % 2) + 0.04 + 0.2 * (i % 2),
                                   0.5 * (quarter / 2) + 0.05 + 0.2 * (i / 2)};
                const osg::ref_ptr<osg::Vec3Array> trees = new osg::Vec3Array;
                for (int tree = 0; tree < 25; ++tree)
                    addCross(*trees, at({corner.east + 0.03 * (tree % 5), corner.north + 0.03 * (tree / 5)}), 40.0f,
                             30.0f);
                const osg::ref_ptr<osg::LOD> near = new osg::LOD;
                near->addChild(geodeOf(trees, quads(*trees), {0.1f, 0.3f, 0.1f, 1.0f}), 0.0f, kTreeRange);
                clumps->addChild(near);
            }
            const osg::ref_ptr<osg::LOD> far = new osg::LOD;
            far->addChild(clumps, 0.0f, kWoodRange);
            all->addChild(far);
        }
        return all;
    }

    // A tower or a hall.
    [[nodiscard]] osg::ref_ptr<osg::Node> house(const Place& place) const {
        const osg::ref_ptr<osg::Vec3Array> walls = new osg::Vec3Array;
        addCross(*walls, {0.0, 0.0, 0.0}, 60.0f, _number % 2 ? 120.0f : 40.0f);
        const osg::ref_ptr<osg::MatrixTransform> stands = new osg::MatrixTransform(osg::Matrixd::translate(at(place)));
        stands->addChild(geodeOf(walls, quads(*walls), {0.7f, 0.2f, 0.2f, 1.0f}));
        const osg::ref_ptr<osg::LOD> near = new osg::LOD;
        near->addChild(stands, 0.0f, kHouseRange);
        return near;
    }

    [[nodiscard]] osg::ref_ptr<osg::Node> airfield() const {
        const osg::ref_ptr<osg::Group> all = new osg::Group;
        const osg::ref_ptr<osg::Vec3Array> runway = new osg::Vec3Array;
        for (const Place& corner : {Place{0.3, 0.5}, {0.7, 0.5}, {0.7, 0.503}, {0.3, 0.503}})
            runway->push_back(at(corner, 160.0));
        all->addChild(geodeOf(runway, quads(*runway), {0.3f, 0.3f, 0.3f, 1.0f}));
        const osg::ref_ptr<osg::Vec3Array> lamps = new osg::Vec3Array;
        for (int i = 0; i <= 40; ++i) lamps->push_back(at({0.3 + 0.01 * i, 0.504}, 165.0));
        all->addChild(geodeOf(lamps, new osg::DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(lamps->size())),
                              {1.0f, 1.0f, 0.6f, 1.0f}));
        const osg::ref_ptr<osg::LightSource> beacon = new osg::LightSource;
        beacon->getLight()->setLightNum(1);
        beacon->getLight()->setPosition(osg::Vec4(at({0.5, 0.5}, 200.0), 1.0));
        all->addChild(beacon);
        return all;
    }

    // One of two boards.
    [[nodiscard]] osg::ref_ptr<osg::Node> sign() const {
        const osg::ref_ptr<osg::Switch> choice = new osg::Switch;
        for (int i = 0; i < 2; ++i) {
            const osg::ref_ptr<osg::Vec3Array> board = new osg::Vec3Array;
            addCross(*board, at({0.5, 0.9}), 30.0f + 30.0f * static_cast<float>(i), 25.0f);
            choice->addChild(geodeOf(board, quads(*board), {1.0f, 0.9f, 0.1f, 1.0f}), i == 0);
        }
        return choice;
    }

    [[nodiscard]] osg::ref_ptr<osg::Node> bushes() const {
        const osg::ref_ptr<osg::Billboard> all = new osg::Billboard;
        all->setMode(osg::Billboard::POINT_ROT_EYE);
        for (int i = 0; i < 5; ++i) {
            const osg::ref_ptr<osg::Vec3Array> bush = new osg::Vec3Array;
            for (const auto& [x, z] : {std::pair(-20.0f, 0.0f), {20.0f, 0.0f}, {20.0f, 30.0f}, {-20.0f, 30.0f}})
                bush->push_back({x, 0.0f, z});
            const osg::ref_ptr<osg::Geode> shape = geodeOf(bush, quads(*bush), {0.6f, 0.5f, 0.1f, 1.0f});
            all->addDrawable(shape->getDrawable(0), osg::Vec3(at({0.85, 0.2 + 0.1 * i})));
        }
        all->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
        return all;
    }

    // An application may turn it.
    [[nodiscard]] osg::ref_ptr<osg::Node> mill() const {
        const osg::ref_ptr<osg::Vec3Array> sails = new osg::Vec3Array;
        addCross(*sails, {0.0, 0.0, 0.0}, 50.0f, 70.0f);
        const osg::ref_ptr<osg::MatrixTransform> turns =
            new osg::MatrixTransform(osg::Matrixd::translate(at({0.2, 0.8})));
        turns->setName("mill");
        turns->setDataVariance(osg::Object::DYNAMIC);
        turns->addChild(geodeOf(sails, quads(*sails), {0.9f, 0.9f, 0.9f, 1.0f}));
        return turns;
    }

    double _south, _west;
    int _number;
    osg::ref_ptr<osg::EllipsoidModel> _ellipsoid = new osg::EllipsoidModel;
    osg::Matrixd _toEcef, _toLocal;
};

}  // namespace

std::string writeSceneryDatabase(const std::string& folder) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode("WKT", "");
    root->setEllipsoidModel(new osg::EllipsoidModel);
    for (int row = 0; row < kTileRows; ++row) {
        for (int column = 0; column < kTileColumns; ++column) {
            const Tile tile(row, column);
            const std::string file = "tile_" + std::to_string(row) + "_" + std::to_string(column) + ".osgb";
            if (!osgDB::writeNodeFile(*tile.make(), folder + "/" + file)) return {};
            const osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
            paged->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
            paged->setCenter(tile.sphere().center());
            paged->setRadius(tile.sphere().radius());
            paged->addChild(tile.makeFar(), kTileRange, FLT_MAX);
            paged->setFileName(1, file);
            paged->setRange(1, 0.0f, kTileRange);
            root->addChild(paged);
        }
    }
    const std::string file = folder + "/scenery.osgb";
    return osgDB::writeNodeFile(*root, file) ? file : std::string();
}

}  // namespace osgAnalyticBin::test
