// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Files of a database as no builder makes them, from the bytes of an input.

#pragma once

#include "Bytes.h"

#include <osg/CoordinateSystemNode>
#include <osg/LOD>
#include <osg/PagedLOD>
#include <osg/PositionAttitudeTransform>
#include <osg/Switch>
#include <osg/ValueObject>
#include <osgTerrain/Layer>
#include <osgTerrain/TerrainTile>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <kit/DatabaseFixture.h>
#include <support/GridMesh.h>

namespace osgAnalyticBin::test {

/// Where a tile claims to stand: degrees, and metres.
struct ScenePlace {
    double south = -90.0, north = 90.0, west = -180.0, east = 180.0, height = 0.0;
};

/// Whether nothing in the scene makes OSG itself read where there is no memory, or number that its text cannot hold.
struct SceneTraits {
    bool hasWildIndices = false;
    bool hasOddNumbers = false;
    bool hasTerrainTiles = false;
};

inline constexpr int kDeepest = 5;
inline constexpr int kMostNodes = 40;

inline osg::ref_ptr<osg::PrimitiveSet> makePrimitives(Bytes& bytes, int posts) {
    const int count = posts * posts;
    const auto wild = [&bytes] { return static_cast<int>(bytes.byte()) << (8 * bytes.below(4)); };
    const auto mode = [&bytes] { return static_cast<GLenum>(bytes.below(14)); };
    // numbers in braces are taken in order, whatever the compiler
    switch (bytes.below(8)) {
        case 0:
            return new osg::DrawArrays(GL_POINTS, 0, count);
        case 1:
            return new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, count);
        case 2:
            return new osg::DrawArrays{mode(), wild(), wild(), bytes.below(3)};
        case 3: {
            const osg::ref_ptr<osg::DrawArrayLengths> lengths = new osg::DrawArrayLengths(GL_QUAD_STRIP, 0);
            for (int i = bytes.below(4); i > 0; --i) lengths->push_back(bytes.flag() ? wild() : posts);
            return lengths;
        }
        case 4: {
            const osg::ref_ptr<osg::DrawElementsUByte> elements = new osg::DrawElementsUByte(mode());
            for (int i = bytes.below(32); i > 0; --i) elements->push_back(bytes.byte());
            return elements;
        }
        default:
            break;
    }
    const auto elements = gridTriangles(static_cast<unsigned int>(posts));
    if (bytes.below(16) == 15) elements->push_back(static_cast<unsigned int>(wild()));
    return elements;
}

inline osg::ref_ptr<osg::Array> makeVertices(Bytes& bytes, const ScenePlace& place, int posts,
                                             const osg::Vec3d& origin) {
    const osg::ref_ptr<osg::Vec3dArray> vertices = new osg::Vec3dArray;
    const double cells = std::max(1.0, posts - 1.0);
    for (int i = 0; i < posts * posts; ++i) {
        const double latitude = place.south + i / posts / cells * (place.north - place.south);
        const double longitude = place.west + i % posts / cells * (place.east - place.west);
        vertices->push_back(ecefDeg(latitude, longitude, place.height) - origin);
    }
    const int odd = bytes.byte();
    if (odd >= 240) (*vertices)[static_cast<std::size_t>(bytes.byte()) % vertices->size()][odd % 3] = bytes.number();
    if (odd % 8 == 1) return vertices;
    const osg::ref_ptr<osg::Vec3Array> floats = new osg::Vec3Array;
    for (const osg::Vec3d& vertex : *vertices) floats->push_back(osg::Vec3(vertex));
    return floats;
}

inline osg::ref_ptr<osg::Geometry> makeGeometry(Bytes& bytes, const ScenePlace& place, const osg::Vec3d& origin) {
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    const int kind = bytes.below(16);
    if (kind == 15) return geometry;
    const int posts = kind == 14 ? 1 : 2 + kind % 4;
    if (kind != 13) geometry->setVertexArray(makeVertices(bytes, place, posts, origin));
    for (int i = kind == 12 ? 2 : 1; i > 0; --i) geometry->addPrimitiveSet(makePrimitives(bytes, posts));
    if (kind == 11) {
        const osg::ref_ptr<osg::Vec2Array> coordinates = new osg::Vec2Array;
        for (int i = 0; i < posts * posts; ++i)
            coordinates->push_back(osg::Vec2{static_cast<float>(bytes.byte()) / 255.0f, bytes.flag() ? 0.0f : 1.0f});
        geometry->setTexCoordArray(0, coordinates);
    }
    return geometry;
}

inline osg::Matrixd makeMatrix(Bytes& bytes, const osg::Vec3d& origin) {
    osg::Matrixd matrix = osg::Matrixd::translate(origin);
    const int kind = bytes.below(12);
    if (kind == 8) matrix.ptr()[bytes.below(16)] = bytes.number();
    if (kind == 9) matrix.preMultScale(osg::Vec3d(bytes.number(), 1.0, 0.0));
    if (kind == 10) matrix.makeScale(osg::Vec3d(0.0, 0.0, 0.0));
    if (kind == 11) matrix.preMultRotate(osg::Quat(bytes.between(-4.0, 4.0), osg::Vec3d(0.0, 0.6, 0.8)));
    return matrix;
}

inline osg::ref_ptr<osg::Node> makeMesh(Bytes& bytes, const ScenePlace& place) {
    const bool isCentred = bytes.below(4) != 3;
    const osg::Vec3d middle = ecefDeg(0.5 * (place.south + place.north), 0.5 * (place.west + place.east), place.height);
    const osg::Vec3d origin = isCentred ? middle : osg::Vec3d();
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(makeGeometry(bytes, place, origin));
    if (!isCentred) return geode;
    const osg::ref_ptr<osg::MatrixTransform> mesh = new osg::MatrixTransform(makeMatrix(bytes, origin));
    if (bytes.byte() == 255) mesh->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    if (bytes.byte() == 255) mesh->setDataVariance(osg::Object::DYNAMIC);
    mesh->addChild(geode);
    return mesh;
}

inline osg::ref_ptr<osg::Node> makeTerrainTile(Bytes& bytes, const ScenePlace& place) {
    const osg::ref_ptr<osgTerrain::Locator> locator = new osgTerrain::Locator;
    locator->setCoordinateSystemType(static_cast<osgTerrain::Locator::CoordinateSystemType>(bytes.below(3)));
    locator->setTransformAsExtents(osg::DegreesToRadians(place.west), osg::DegreesToRadians(place.south),
                                   osg::DegreesToRadians(place.east), osg::DegreesToRadians(place.north));
    if (bytes.byte() >= 240) locator->setTransform(makeMatrix(bytes, osg::Vec3d{bytes.number(), bytes.number(), 0.0}));
    const osg::ref_ptr<osg::HeightField> field = new osg::HeightField;
    const auto columns = static_cast<unsigned int>(bytes.below(5));
    field->allocate(columns, static_cast<unsigned int>(bytes.below(5)));
    for (float& height : *field->getFloatArray()) height = static_cast<float>(bytes.number());
    field->setSkirtHeight(static_cast<float>(bytes.number()));
    const osg::ref_ptr<osgTerrain::HeightFieldLayer> layer = new osgTerrain::HeightFieldLayer(field);
    if (bytes.byte() != 255) layer->setLocator(locator);
    const osg::ref_ptr<osgTerrain::TerrainTile> tile = new osgTerrain::TerrainTile;
    if (bytes.byte() != 255) tile->setElevationLayer(layer);
    return tile;
}

/// A part of the place, or anywhere.
ScenePlace placeInside(Bytes& bytes, const ScenePlace& place) {
    const int kind = bytes.byte();
    if (kind == 255) return {bytes.number(), bytes.number(), bytes.number(), bytes.number(), bytes.number()};
    ScenePlace inside = place;
    const double latitude = 0.5 * (place.south + place.north);
    const double longitude = 0.5 * (place.west + place.east);
    (kind & 1 ? inside.south : inside.north) = latitude;
    (kind & 2 ? inside.west : inside.east) = longitude;
    inside.height = kind & 4 ? bytes.between(-9000.0, 9000.0) : place.height;
    return inside;
}

/// What is stored with a node: of its place, with numbers that are wrong, or anything.
inline void addStored(Bytes& bytes, const ScenePlace& place, osg::Node& node) {
    const int kind = bytes.byte();
    if (kind < 96) return;
    std::array<double, 8> numbers{
        place.south, place.west, place.height - 40000.0, place.north, place.east, place.height + 100.0, 1.0, 0.0};
    for (int i = kind < 176 ? 0 : 1 + kind % 4; i > 0; --i) {
        const auto which = static_cast<std::size_t>(bytes.below(8));
        numbers[which] = bytes.flag() ? bytes.number() : numbers[which] * bytes.between(-2.0, 2.0);
    }
    std::string text;
    for (const double number : numbers) {
        char word[40];
        std::snprintf(word, sizeof word, "%.17g ", number);
        text += word;
    }
    if (kind >= 252)
        node.setUserValue("osgAnalyticBin", static_cast<int>(bytes.byte()));
    else
        node.setUserValue("osgAnalyticBin", text.substr(0, kind >= 240 ? bytes.byte() : text.size()));
    if (kind % 16 == 15) node.setUserValue("osgAnalyticBin.surfaceLow", std::to_string(bytes.number()));
}

struct Maker {
    Bytes& bytes;
    int nodes = 0;

    osg::ref_ptr<osg::Node> make(const ScenePlace& place, int depth) {
        const osg::ref_ptr<osg::Node> node = makeNode(placeInside(bytes, place), depth);
        if (bytes.byte() == 255) node->setNodeMask(bytes.byte());
        return node;
    }

private:
    osg::ref_ptr<osg::Node> makeNode(const ScenePlace& place, int depth) {
        const int kind = ++nodes >= kMostNodes || depth >= kDeepest || bytes.empty() ? 0 : bytes.below(16);
        const osg::ref_ptr<osg::Node> node = kind < 4 ? makeMesh(bytes, place) : makeInner(kind, place, depth);
        addStored(bytes, place, *node);
        return node;
    }

    osg::ref_ptr<osg::Node> makeInner(int kind, const ScenePlace& place, int depth) {
        if (kind < 8) return makePaged(place);
        if (kind == 8) return makeTerrainTile(bytes, place);
        const osg::ref_ptr<osg::Group> group = makeGroup(kind, place);
        for (int i = 1 + bytes.below(4); i > 0; --i) group->addChild(make(place, depth + 1));
        if (auto* lod = dynamic_cast<osg::LOD*>(group.get()))
            for (unsigned int i = 0; i < lod->getNumChildren(); ++i) lod->setRange(i, 0.0f, 1e10f);
        return group;
    }

    osg::ref_ptr<osg::Group> makeGroup(int kind, const ScenePlace& place) {
        switch (kind) {
            case 9:
                return new osg::Switch;
            case 10:
                return new osg::LOD;
            case 11:
                return new osg::MatrixTransform(makeMatrix(bytes, osg::Vec3d(0, 0, bytes.between(-100.0, 100.0))));
            case 12: {
                const osg::ref_ptr<osg::PositionAttitudeTransform> moved = new osg::PositionAttitudeTransform;
                moved->setScale(osg::Vec3d(1.0, 1.0, bytes.flag() ? 1.0 : bytes.number()));
                return moved;
            }
            case 13: {
                if (place.height < 1000.0) return new osg::Group;
                const osg::ref_ptr<osg::CoordinateSystemNode> globe = new osg::CoordinateSystemNode;
                const double equatorial = bytes.flag() ? 1.7e6 : bytes.number();
                globe->setEllipsoidModel(new osg::EllipsoidModel(equatorial, bytes.flag() ? 1.6e6 : bytes.number()));
                return globe;
            }
            default:
                return new osg::Group;
        }
    }

    osg::ref_ptr<osg::Node> makePaged(const ScenePlace& place) {
        const osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
        paged->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
        paged->addChild(makeMesh(bytes, place), 0.0f, 1e10f);
        if (bytes.below(8) == 7) paged->addChild(makeMesh(bytes, placeInside(bytes, place)), 0.0f, 1e10f);
        const unsigned int next = paged->getNumChildren();
        paged->setFileName(next, std::to_string(bytes.below(4)) + ".osgb");
        paged->setRange(next, 0.0f, 1e10f);
        return paged;
    }
};

class TraitsFinder : public osg::NodeVisitor {
public:
    TraitsFinder() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0u); }

    void apply(osg::Node& node) override {
        // traversed, it makes its mesh, and OSG does not look whether there are heights
        if (dynamic_cast<osgTerrain::TerrainTile*>(&node))
            traits.hasTerrainTiles = true;
        else
            traverse(node);
    }
    void apply(osg::Transform& node) override {
        osg::Matrixd matrix;
        node.computeLocalToWorldMatrix(matrix, nullptr);
        for (int i = 0; i < 16; ++i) note(matrix.ptr()[i]);
        traverse(node);
    }
    void apply(osg::Geometry& geometry) override {
        const osg::Array* vertices = geometry.getVertexArray();
        const std::int64_t count = vertices ? vertices->getNumElements() : 0;
        for (const auto& primitives : geometry.getPrimitiveSetList()) notePrimitives(*primitives, count);
        if (const auto* floats = dynamic_cast<const osg::Vec3Array*>(vertices))
            for (const osg::Vec3& v : *floats) note(static_cast<double>(v.x()) + static_cast<double>(v.y() + v.z()));
        if (const auto* doubles = dynamic_cast<const osg::Vec3dArray*>(vertices))
            for (const osg::Vec3d& v : *doubles) note(v.x() + v.y() + v.z());
    }

    SceneTraits traits;

private:
    void note(double number) { traits.hasOddNumbers = traits.hasOddNumbers || !(std::abs(number) < 1e30); }

    void notePrimitives(const osg::PrimitiveSet& primitives, std::int64_t count) {
        if (const auto* arrays = dynamic_cast<const osg::DrawArrays*>(&primitives)) {
            const std::int64_t end = std::int64_t{arrays->getFirst()} + arrays->getCount();
            return noteRange(arrays->getFirst(), arrays->getCount(), end, count);
        }
        if (const auto* lengths = dynamic_cast<const osg::DrawArrayLengths*>(&primitives)) {
            std::int64_t end = lengths->getFirst();
            for (const GLsizei length : *lengths) noteRange(end, length, end + length, count), end += length;
            return;
        }
        for (unsigned int i = 0; i < primitives.getNumIndices(); ++i)
            noteRange(primitives.index(i), 0, primitives.index(i) + 1, count);
    }
    void noteRange(std::int64_t first, std::int64_t length, std::int64_t end, std::int64_t count) {
        if (first < 0 || length < 0 || end > count) traits.hasWildIndices = true;
    }
};

/// What the file of a database holds. `isRoot`: below a CoordinateSystemNode. Files name each other "0.osgb", "1.osgb"
/// and so on, themselves too.
[[nodiscard]] inline osg::ref_ptr<osg::Node> makeFile(Bytes& bytes, const ScenePlace& place, bool isRoot) {
    Maker maker{bytes};
    if (!isRoot) return maker.make(place, 0);
    const osg::ref_ptr<osg::Group> root =
        bytes.byte() == 255 ? new osg::Group : static_cast<osg::Group*>(new osg::CoordinateSystemNode);
    if (auto* globe = dynamic_cast<osg::CoordinateSystemNode*>(root.get()))
        globe->setEllipsoidModel(new osg::EllipsoidModel);
    for (int i = 1 + bytes.below(3); i > 0; --i) root->addChild(maker.make(place, 0));
    return root;
}

[[nodiscard]] inline SceneTraits traitsOf(osg::Node& scene) {
    TraitsFinder finder;
    scene.accept(finder);
    return finder.traits;
}

}  // namespace osgAnalyticBin::test
