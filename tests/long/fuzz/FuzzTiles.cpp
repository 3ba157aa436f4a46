// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// A database of hostile files that no builder makes. OSG writes and reads them, bins are installed as for the pager,
// and the database is paged, updated and culled. tests/long/scenes looks whether something visible is culled.

#include "Fuzz.h"

#include <osgAnalyticBin/InstallBins.h>

#include <osg/Notify>
#include <osg/Switch>
#include <osg/ValueObject>
#include <osgUtil/UpdateVisitor>

#include <algorithm>
#include <kit/DatabaseFixture.h>
#include <support/AnyScene.h>

using namespace osgAnalyticBin;
using namespace osgAnalyticBin::test;

namespace {

constexpr int kFiles = 4;
constexpr int kMostLoads = 8;
constexpr std::size_t kMostBytes = 2048;
constexpr int kDeepest = 5;
constexpr int kMostNodes = 40;

/// Where a tile claims to stand: degrees, and metres.
struct Place {
    double south, north, west, east, height;
};

/// Makes files from the bytes of an input. Files name each other "0.osgb", "1.osgb" and so on, themselves too. Those to
/// be drawn have no terrain tiles: OSG does not look whether they have heights when it makes their meshes.
class Maker {
public:
    Maker(Bytes& bytes, bool isDrawn) : _bytes(bytes), _isDrawn(isDrawn) {}

    osg::ref_ptr<osg::Node> makeFile(const Place& place) {
        _nodes = 0;
        return make(place, 0);
    }
    osg::ref_ptr<osg::Node> makeRoot(const Place& place) {
        const osg::ref_ptr<osg::Group> root = _bytes.byte() == 255 ? new osg::Group : makeGlobe();
        _nodes = 0;
        for (int i = 1 + _bytes.below(3); i > 0; --i) root->addChild(make(place, 0));
        return root;
    }

private:
    /// Of any mode. No index leads out of the vertices: OSG's bounds would read there. The kit does not, as
    /// MeshTileSurfaceTest.cpp shows.
    osg::ref_ptr<osg::PrimitiveSet> makePrimitives(int posts) {
        const auto mode = static_cast<GLenum>(_bytes.below(14));
        const int count = posts * posts;
        const int kind = _bytes.below(16);
        if (kind == 0) return new osg::DrawArrays(mode, 0, count);
        // numbers in braces are taken in order, whatever the compiler
        if (kind == 1) return new osg::DrawArrays{mode, 1, _bytes.below(count), _bytes.below(3)};
        if (kind == 2) {
            const osg::ref_ptr<osg::DrawArrayLengths> lengths = new osg::DrawArrayLengths(mode, 0);
            for (int i = _bytes.below(posts); i > 0; --i) lengths->push_back(_bytes.flag() ? 0 : posts);
            return lengths;
        }
        if (kind > 3) return gridTriangles(static_cast<unsigned int>(posts));
        const osg::ref_ptr<osg::DrawElementsUByte> elements = new osg::DrawElementsUByte(mode);
        for (int i = _bytes.below(32); i > 0; --i) elements->push_back(static_cast<GLubyte>(_bytes.below(count)));
        return elements;
    }

    osg::ref_ptr<osg::Array> makeVertices(const Place& place, int posts, const osg::Vec3d& origin) {
        const osg::ref_ptr<osg::Vec3dArray> vertices = new osg::Vec3dArray;
        const double cells = std::max(1.0, posts - 1.0);
        for (int i = 0; i < posts * posts; ++i) {
            const double latitude = place.south + i / posts / cells * (place.north - place.south);
            const double longitude = place.west + i % posts / cells * (place.east - place.west);
            vertices->push_back(ecefDeg(latitude, longitude, place.height) - origin);
        }
        const int odd = _bytes.byte();
        if (odd >= 240)
            (*vertices)[static_cast<std::size_t>(_bytes.byte()) % vertices->size()][odd % 3] = _bytes.number();
        if (odd % 8 == 1) return vertices;
        return new osg::Vec3Array(vertices->begin(), vertices->end());
    }

    osg::ref_ptr<osg::Geometry> makeGeometry(const Place& place, const osg::Vec3d& origin) {
        const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
        const int kind = _bytes.below(16);
        if (kind == 15) return geometry;
        const int posts = kind == 14 ? 1 : 2 + kind % 4;
        if (kind != 13) geometry->setVertexArray(makeVertices(place, posts, origin));
        for (int i = kind == 12 ? 2 : 1; i > 0; --i) geometry->addPrimitiveSet(makePrimitives(posts));
        if (kind != 11) return geometry;
        const osg::ref_ptr<osg::Vec2Array> coordinates = new osg::Vec2Array;
        for (int i = 0; i < posts * posts; ++i)
            coordinates->push_back(osg::Vec2d(_bytes.between(0.0, 1.0), _bytes.flag() ? 0.0 : 1.0));
        geometry->setTexCoordArray(0, coordinates);
        return geometry;
    }

    osg::Matrixd makeMatrix(const osg::Vec3d& origin) {
        osg::Matrixd matrix = osg::Matrixd::translate(origin);
        const int kind = _bytes.below(12);
        if (kind == 8) matrix.ptr()[_bytes.below(16)] = _bytes.number();
        if (kind == 9) matrix.preMultScale(osg::Vec3d(_bytes.number(), 1.0, 0.0));
        if (kind == 10) matrix.makeScale(osg::Vec3d(0.0, 0.0, 0.0));
        if (kind == 11) matrix.preMultRotate(osg::Quat(_bytes.between(-4.0, 4.0), osg::Vec3d(0.0, 0.6, 0.8)));
        return matrix;
    }

    osg::ref_ptr<osg::Node> makeMesh(const Place& place) {
        const bool isCentred = _bytes.below(4) != 3;
        const osg::Vec3d middle =
            ecefDeg(0.5 * (place.south + place.north), 0.5 * (place.west + place.east), place.height);
        const osg::Vec3d origin = isCentred ? middle : osg::Vec3d();
        const osg::ref_ptr<osg::Geometry> geometry = makeGeometry(place, origin);
        if (isCentred) return placed(geometry, makeMatrix(origin));
        return placed(geometry, {})->getChild(0);
    }

    osg::ref_ptr<osg::Node> makeTerrainTile(const Place& place) {
        const osg::ref_ptr<osgTerrain::Locator> locator = new osgTerrain::Locator;
        locator->setCoordinateSystemType(static_cast<osgTerrain::Locator::CoordinateSystemType>(_bytes.below(3)));
        locator->setTransformAsExtents(osg::DegreesToRadians(place.west), osg::DegreesToRadians(place.south),
                                       osg::DegreesToRadians(place.east), osg::DegreesToRadians(place.north));
        if (_bytes.byte() >= 240) locator->setTransform(makeMatrix(osg::Vec3d{_bytes.number(), _bytes.number(), 0.0}));
        const osg::ref_ptr<osg::HeightField> field = new osg::HeightField;
        const auto columns = static_cast<unsigned int>(_bytes.below(5));
        field->allocate(columns, static_cast<unsigned int>(_bytes.below(5)));
        for (float& height : *field->getFloatArray()) height = static_cast<float>(_bytes.number());
        field->setSkirtHeight(static_cast<float>(_bytes.number()));
        const osg::ref_ptr<osgTerrain::HeightFieldLayer> layer = new osgTerrain::HeightFieldLayer(field);
        if (_bytes.byte() != 255) layer->setLocator(locator);
        const osg::ref_ptr<osgTerrain::TerrainTile> tile = new osgTerrain::TerrainTile;
        if (_bytes.byte() != 255) tile->setElevationLayer(layer);
        return tile;
    }

    /// A part of the place, or anywhere.
    Place placeInside(const Place& place) {
        const int kind = _bytes.byte();
        if (kind == 255) return {_bytes.number(), _bytes.number(), _bytes.number(), _bytes.number(), _bytes.number()};
        Place inside = place;
        (kind & 1 ? inside.south : inside.north) = 0.5 * (place.south + place.north);
        (kind & 2 ? inside.west : inside.east) = 0.5 * (place.west + place.east);
        inside.height = kind & 4 ? _bytes.between(-9000.0, 9000.0) : place.height;
        return inside;
    }

    /// What is stored with a node: of its place, or with numbers that are wrong. Other text: FuzzStoredText.cpp.
    void addStored(const Place& place, osg::Node& node) {
        const int kind = _bytes.byte();
        if (kind < 96) return;
        std::array<double, 8> numbers{
            place.south, place.west, place.height - 40000.0, place.north, place.east, place.height + 100.0, 1.0, 0.0};
        for (int i = kind < 176 ? 0 : 1 + kind % 4; i > 0; --i) {
            double& number = numbers[static_cast<std::size_t>(_bytes.below(8))];
            number = _bytes.flag() ? _bytes.number() : number * _bytes.between(-2.0, 2.0);
        }
        std::ostringstream text;
        text.precision(17);
        for (const double number : numbers) text << number << ' ';
        node.setUserValue("osgAnalyticBin", text.str());
        if (kind % 16 == 15) node.setUserValue("osgAnalyticBin.surfaceLow", std::to_string(_bytes.number()));
    }

    osg::ref_ptr<osg::Node> make(const Place& above, int depth) {
        const Place place = placeInside(above);
        const int kind = ++_nodes >= kMostNodes || depth >= kDeepest || _bytes.empty() ? 0 : _bytes.below(16);
        const osg::ref_ptr<osg::Node> node = kind < 4 ? makeMesh(place) : makeInner(kind, place, depth);
        addStored(place, *node);
        return node;
    }

    osg::ref_ptr<osg::Node> makeInner(int kind, const Place& place, int depth) {
        if (kind < 8) return makePagedTile(place);
        if (kind == 8 && !_isDrawn) return makeTerrainTile(place);
        const osg::ref_ptr<osg::Group> group = makeGroup(kind, place);
        for (int i = 1 + _bytes.below(4); i > 0; --i) group->addChild(make(place, depth + 1));
        return group;
    }

    osg::ref_ptr<osg::Group> makeGroup(int kind, const Place& place) {
        if (kind == 9) return new osg::Switch;
        if (kind == 11) return new osg::MatrixTransform(makeMatrix(osg::Vec3d(0, 0, _bytes.between(-100.0, 100.0))));
        if (kind != 13 || place.height < 1000.0) return new osg::Group;
        const double equatorial = _bytes.flag() ? 1.7e6 : _bytes.number();
        return makeGlobe({}, equatorial, _bytes.flag() ? 1.6e6 : _bytes.number());
    }

    osg::ref_ptr<osg::Node> makePagedTile(const Place& place) {
        const osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
        paged->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
        paged->addChild(makeMesh(place), 0.0f, 1e10f);
        if (_bytes.below(8) == 7) paged->addChild(makeMesh(placeInside(place)), 0.0f, 1e10f);
        const unsigned int next = paged->getNumChildren();
        paged->setFileName(next, std::to_string(_bytes.below(kFiles)) + ".osgb");
        paged->setRange(next, 0.0f, 1e10f);
        return paged;
    }

    Bytes& _bytes;
    const bool _isDrawn;
    int _nodes = 0;
};

/// The files of the present input, instead of those of a folder.
class FilesInMemory : public osgDB::ReadFileCallback {
public:
    osgDB::ReaderWriter::ReadResult readNode(const std::string& name, const osgDB::Options*) override {
        const auto number = static_cast<std::size_t>(name[0] - '0');
        if (number >= files.size() || !files[number]) return osgDB::ReaderWriter::ReadResult::FILE_NOT_FOUND;
        return writtenAndRead(*files[number], false).get();
    }
    std::array<osg::ref_ptr<osg::Node>, kFiles> files;
};

/// Loads what PagedLODs name the way the pager does, a level in each traversal, as far as there is patience.
class Pager : public osg::NodeVisitor {
public:
    Pager() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0u); }
    void apply(osg::Node& node) override {
        // traversed, it makes its mesh
        if (!dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
    }
    void apply(osg::PagedLOD& paged) override {
        traverse(paged);
        const unsigned int next = paged.getNumChildren();
        if (next == 0 || paged.getNumFileNames() != next + 1 || ++_loads > kMostLoads) return;
        const osg::ref_ptr<osg::Node> content =
            osgDB::readRefNodeFile(paged.getFileName(next), dynamic_cast<osgDB::Options*>(paged.getDatabaseOptions()));
        if (content) paged.addChild(content);
    }

private:
    int _loads = 0;
};

/// Views of what is there, from near and far.
void look(Bytes& bytes, osg::Node& scene) {
    const osg::BoundingSphere bound = scene.getBound();
    const osg::Vec3d target = bound.valid() ? osg::Vec3d(bound.center()) : osg::Vec3d();
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    for (unsigned int frame = 3; frame < 7; ++frame) {
        const osg::Vec3d aside{bytes.between(-1.0, 1.0), bytes.between(-1.0, 1.0), bytes.between(-1.0, 1.0)};
        const osg::Vec3d eye = target * bytes.between(1.0, 2.0) + aside * std::pow(10.0, bytes.between(2.0, 7.0));
        (void)cull(scene, CullView::lookAt(eye, target, osg::Vec3d(0.1, 0.2, 1.0), bytes.between(0.5, 60.0)), *visitor,
                   frame);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2 || size > kMostBytes) return 0;
    osg::setNotifyLevel(osg::ALWAYS);
    Bytes bytes(data, size);
    const CullOptions options = by(bytes.pick(std::array{Method::Quadratic, Method::Exact, Method::None}));
    const int spare = bytes.byte();
    const Place place{-90.0 + 30 * (spare % 5), -60.0 + 30 * (spare % 5), -170.0 + spare, -140.0 + spare, 0.0};
    const bool isDrawn = spare % 4 != 0;
    Maker maker(bytes, isDrawn);
    const osg::ref_ptr<osg::Node> made = maker.makeRoot(place);
    static const osg::ref_ptr<FilesInMemory> memory = new FilesInMemory;
    osgDB::Registry::instance()->setReadFileCallback(memory);
    for (osg::ref_ptr<osg::Node>& file : memory->files) file = bytes.empty() ? nullptr : maker.makeFile(place);
    const osg::ref_ptr<osg::Node> scene = writtenAndRead(*made, false);
    if (!scene) return 0;
    (void)installBins(*scene, options);
    Pager pager;
    for (int level = 0; level < 3; ++level) scene->accept(pager);
    if (!isDrawn) return 0;
    for (unsigned int frame = 1; frame < 3; ++frame) {
        const osg::ref_ptr<osgUtil::UpdateVisitor> update = new osgUtil::UpdateVisitor;
        update->setTraversalNumber(frame);
        scene->accept(*update);
    }
    look(bytes, *scene);
    return 0;
}
