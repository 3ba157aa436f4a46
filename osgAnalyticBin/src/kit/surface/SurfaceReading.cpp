// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../../core/EarthScale.h"
#include "../../core/PerThread.h"
#include "../../core/mesh/KeyNumbers.h"
#include "../GlmBridge.h"
#include "SurfaceMesh.h"
#include "SurfaceWalk.h"
#include "TerrainLimits.h"
#include "TerrainTileSurface.h"

#include <osgAnalyticBin/TileFrame.h>
#include <osgAnalyticBin/TileSurface.h>

#include <glm/geometric.hpp>
#include <osg/Billboard>
#include <osg/BoundingBox>
#include <osg/BoundingSphere>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace osgAnalyticBin {

namespace {

// Of a vertex: whether it lies on the border, and whether it is the lower one of two at the same place.
enum Mark : std::uint8_t { kOnBorder = 1, kSkirtVertex = 2 };

// The skirts of a mesh, without its other triangles.
struct Skirts {
    SurfaceMesh mesh;
    double length = 0.0;  // metres, of the longest
};

constexpr float kBorder = 1e-6f;  // of texture coordinates
// Skirts of one tile are equally deep to this part of their depth and this many metres on the earth, in proportion
// elsewhere (float vertices of large tiles).
constexpr double kDepthTolerance = 0.02;
constexpr double kDepthRounding = 4.0;
constexpr double kShallowest = 1.0;  // metres on the earth
// How far from straight down a skirt may hang: the geocentric vertical is 0.2 degrees off.
constexpr double kPlumbCosine = 0.999;

std::uint8_t borderMark(const osg::Vec2& t) {
    const auto isAtEnd = [](float x) { return unsigned{x <= kBorder} | unsigned{x >= 1.0f - kBorder}; };
    return static_cast<std::uint8_t>((isAtEnd(t.x()) | isAtEnd(t.y())) * kOnBorder);
}

bool isInUnitSquare(const osg::Vec2& t) {
    constexpr float kLow = -kBorder;
    constexpr float kHigh = 1.0f + kBorder;
    return static_cast<int>(t.x() >= kLow) & static_cast<int>(t.x() <= kHigh) & static_cast<int>(t.y() >= kLow) &
           static_cast<int>(t.y() <= kHigh);
}

struct Pair {
    std::uint32_t upper;
    std::uint32_t lower;
};

// The squared distance of two vertices, one straight below the other; NaN when it is not.
class DepthMeasure {
public:
    explicit DepthMeasure(const core::Ellipsoid& ellipsoid)
        : _isPlane(ellipsoid.isPlane()),
          _equatorial(1.0 / (ellipsoid.equatorialRadius() * ellipsoid.equatorialRadius())),
          _polar(1.0 / (ellipsoid.polarRadius() * ellipsoid.polarRadius())),
          _shallowest2(kShallowest * kShallowest * core::earthScale(ellipsoid) * core::earthScale(ellipsoid)) {}

    [[nodiscard]] double depth2(const glm::dvec3& upper, const glm::dvec3& lower) const {
        const glm::dvec3 hanging = upper - lower;
        const glm::dvec3 up = _isPlane ? glm::dvec3(0.0, 0.0, 1.0)
                                       : glm::dvec3(upper.x * _equatorial, upper.y * _equatorial, upper.z * _polar);
        const double depth2 = glm::dot(hanging, hanging);
        const double along = glm::dot(hanging, up);
        const bool plumb = along > 0.0 && along * along >= kPlumbCosine * kPlumbCosine * depth2 * glm::dot(up, up);
        return plumb && depth2 >= _shallowest2 ? depth2 : std::numeric_limits<double>::quiet_NaN();
    }

    // Whether the first is the upper one of two, straight below each other.
    [[nodiscard]] bool isUpper(const glm::dvec3& a, const glm::dvec3& b) const {
        return _isPlane ? a.z > b.z : glm::dot(a, a) > glm::dot(b, b);
    }

private:
    bool _isPlane;
    double _equatorial, _polar, _shallowest2;
};

// Returns: no pairs unless every border vertex has exactly one partner.
std::vector<Pair> pairsOf(const SurfaceMesh& mesh, const std::vector<std::uint8_t>& marks,
                          const DepthMeasure& measure) {
    std::vector<std::uint32_t> border(mesh.size());
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < mesh.size(); ++i) {
        border[count] = i;
        count += marks[i] != 0;
    }
    core::KeyNumbers<std::array<std::uint64_t, 2>> places(count);
    std::vector<std::uint32_t> firstAt;  // by the number of the place
    std::vector<Pair> pairs;
    pairs.reserve(count / 2);
    std::vector<std::uint8_t> paired(mesh.size(), 0);
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t i = border[k];
        const osg::Vec2& at = mesh.texCoords[i];
        const std::uint32_t place = places.numberOf({core::bitsOf(at.x()), core::bitsOf(at.y())});
        if (place == firstAt.size()) {
            firstAt.push_back(i);
            continue;
        }
        const std::uint32_t other = firstAt[place];
        if (paired[other]) return {};
        paired[other] = 1;
        const bool otherIsUpper = measure.isUpper(mesh.vertex(other), mesh.vertex(i));
        pairs.push_back({otherIsUpper ? other : i, otherIsUpper ? i : other});
    }
    if (2 * pairs.size() != count) return {};
    return pairs;
}

// The triangles with a lower vertex. Returns: none when one of them has a vertex off the border.
std::vector<std::uint32_t> hangingTriangles(const SurfaceMesh& mesh, const std::vector<std::uint8_t>& marks) {
    std::vector<std::uint32_t> first(mesh.triangles.size() / 3 + 1);
    std::size_t count = 0;
    unsigned int bad = 0;
    // without branches, which would be mispredicted
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
        const unsigned int a = marks[mesh.triangles[i]];
        const unsigned int b = marks[mesh.triangles[i + 1]];
        const unsigned int c = marks[mesh.triangles[i + 2]];
        const unsigned int hangs = ((a | b | c) & kSkirtVertex) / kSkirtVertex;
        bad |= hangs & (unsigned{a == 0} | unsigned{b == 0} | unsigned{c == 0});
        first[count] = static_cast<std::uint32_t>(i);
        count += hangs;
    }
    std::vector<std::uint32_t> triangles;
    if (bad != 0) return triangles;
    triangles.reserve(3 * count);
    for (std::size_t k = 0; k < count; ++k) {
        const auto at = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first[k]);
        triangles.insert(triangles.end(), at, at + 3);
    }
    return triangles;
}

void fold(const std::vector<Pair>& pairs, SurfaceMesh& mesh) {
    for (const Pair& pair : pairs) {
        mesh.x[pair.lower] = mesh.x[pair.upper];
        mesh.y[pair.lower] = mesh.y[pair.upper];
        mesh.z[pair.lower] = mesh.z[pair.upper];
    }
}

// Finds skirts as VirtualPlanetBuilder makes them: texture coordinates that run from 0 to 1 over the tile, and at
// every vertex on its border a second one straight below, all equally deep, which only border vertices are joined to.
// Folds them up: the lower vertices go to the upper ones, and with them all of the skirts to the border.
// Returns: the skirts as they hang; none, and the mesh unchanged, when it differs from that in any way: skirts, if any,
// then count as surface.
Skirts foldSkirts(SurfaceMesh& mesh, const core::Ellipsoid& ellipsoid) {
    if (!mesh.texCoords) return {};
    std::vector<std::uint8_t> marks(mesh.size());
    bool inUnitSquare = true;
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        inUnitSquare &= isInUnitSquare(mesh.texCoords[i]);
        marks[i] = borderMark(mesh.texCoords[i]);
    }
    if (!inUnitSquare) return {};
    const DepthMeasure measure(ellipsoid);
    const std::vector<Pair> pairs = pairsOf(mesh, marks, measure);
    if (pairs.empty()) return {};

    double shallowest2 = std::numeric_limits<double>::infinity();
    double deepest2 = 0.0;
    bool plumb = true;
    for (const Pair& pair : pairs) {
        const double depth2 = measure.depth2(mesh.vertex(pair.upper), mesh.vertex(pair.lower));
        plumb &= depth2 > 0.0;
        shallowest2 = std::min(shallowest2, depth2);
        deepest2 = std::max(deepest2, depth2);
        marks[pair.lower] |= kSkirtVertex;
    }
    const double rounding = kDepthRounding * core::earthScale(ellipsoid);
    const bool equal = std::sqrt(deepest2) <= std::sqrt(shallowest2) * (1.0 + kDepthTolerance) + rounding;
    if (!plumb || !equal) return {};
    Skirts skirts{{}, std::sqrt(deepest2)};
    skirts.mesh.triangles = hangingTriangles(mesh, marks);
    if (skirts.mesh.triangles.empty()) return {};
    skirts.mesh.x = mesh.x;
    skirts.mesh.y = mesh.y;
    skirts.mesh.z = mesh.z;
    dropUnusedVertices(skirts.mesh);
    fold(pairs, mesh);
    return skirts;
}

// A billboard rotates each drawable about its position, so the drawable stays in a ball. This share of the radius is
// added for the rounding of rotations in single precision.
constexpr double kRoomOfTurning = 1e-5;

// What a node may draw anywhere in, as OSG takes it. Not valid: no bound is known.
osg::BoundingBoxd boundOf(const osg::Node& node) {
    osg::BoundingBoxd bound;
    if (const osg::Drawable* const drawable = node.asDrawable()) {
        bound.set(drawable->getBoundingBox()._min, drawable->getBoundingBox()._max);
    } else {
        bound.expandBy(osg::BoundingSphered(node.getBound().center(), node.getBound().radius()));
    }
    return bound;
}

// Whether its vertices are all that a drawable's bound has to hold. Applications give a bound to what shaders move.
bool isHeldByItsVertices(const osg::Drawable& drawable) {
    return isDrawnByItsVertices(drawable) && !drawable.getInitialBound().valid();
}

// The radius of the ball about the origin that holds a drawable; nullopt if that cannot be told.
std::optional<double> reachOf(const osg::Node* node, SurfaceMesh& mesh) {
    const osg::Drawable* const drawable = node ? node->asDrawable() : nullptr;
    if (!drawable || !readMesh(*drawable, osg::Matrixd(), mesh) || !isHeldByItsVertices(*drawable)) return std::nullopt;
    double reach = 0.0;
    for (const std::uint32_t i : mesh.triangles) reach = std::max(reach, glm::length(mesh.vertex(i)));
    return std::isfinite(reach) ? std::optional(reach * (1.0 + kRoomOfTurning)) : std::nullopt;
}

void addBox(const osg::BoundingBoxd& box, const osg::Matrixd& localToEcef, SurfaceMesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.size());
    for (unsigned int corner = 0; corner < 8; ++corner) {
        const osg::Vec3d v = box.corner(corner) * localToEcef;
        mesh.x.push_back(v.x());
        mesh.y.push_back(v.y());
        mesh.z.push_back(v.z());
    }
    // two triangles a face
    constexpr unsigned int kFaces[] = {0, 2, 3, 0, 3, 1, 4, 6, 7, 4, 7, 5, 0, 1, 5, 0, 5, 4,
                                       2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 3, 7, 1, 7, 5};
    for (const unsigned int corner : kFaces) mesh.triangles.push_back(first + corner);
}

// The rounding of what is drawn in a bin.
double drawingErrorIn(const core::GeodeticBin& bin, const SurfaceMesh& mesh, const osg::Matrixd& localToEcef,
                      const core::Ellipsoid& ellipsoid) {
    return ellipsoid.isPlane() ? drawingErrorOf(largestCoordinate(bin))
                               : std::max(drawingError(ellipsoid), drawingErrorOf(farthestVertex(mesh, localToEcef)));
}

// Adds the skirts of a drawable's mesh to its surface.
TileSurface withSkirts(const Skirts& skirts, const TileSurface& surface, const osg::Matrixd& localToEcef,
                       const core::Ellipsoid& ellipsoid) {
    thread_local PerThread<core::MeshBounds> kept;
    core::MeshBounds& bounds = *kept;
    bounds.find(ellipsoid, skirts.mesh);
    if (bounds.bin().empty()) return {};
    const core::Interval altitude = surface.bin.bin().altitude();
    TileSurface result = surface;
    result.skirt = std::max(skirts.length, altitude.lower - bounds.bin().altitude().lower);
    result.bin.expandBy(AnalyticBin(
        bounds.bin(), drawingErrorIn(bounds.bin(), skirts.mesh, localToEcef, ellipsoid) + bounds.axisError()));
    result.bin.setBin(result.bin.bin().withAltitude(altitude));
    return result;
}

// The surface of one drawable's mesh, whose skirts are folded up. Requires: at least one triangle, indices
// within the vertices.
TileSurface meshSurface(SurfaceMesh& mesh, const osg::Matrixd& localToEcef, const core::Ellipsoid& ellipsoid) {
    const Skirts skirts = foldSkirts(mesh, ellipsoid);
    dropUnusedVertices(mesh);
    // keeps its memory: fresh pages from the system for every tile cost a third of the work
    thread_local PerThread<core::MeshBounds> kept;
    core::MeshBounds& bounds = *kept;
    bounds.find(ellipsoid, mesh);
    const core::Interval& altitude = bounds.bin().altitude();
    const bool isTerrain = altitude.lower > lowestMesh(ellipsoid) && altitude.upper < highestTerrain(ellipsoid);
    if (bounds.bin().empty() || !isTerrain) return {};

    TileSurface result;
    result.bin =
        AnalyticBin(bounds.bin(), drawingErrorIn(bounds.bin(), mesh, localToEcef, ellipsoid) + bounds.axisError());
    result.bin.setSag(bounds.sag());
    return skirts.mesh.triangles.empty() ? result : withSkirts(skirts, result, localToEcef, ellipsoid);
}

// Unites the surfaces of the parts of a tile. A part that cannot be told makes the whole so.
class SurfaceUnion final : public SurfaceWalk {
public:
    SurfaceUnion(const osg::EllipsoidModel& ellipsoid, const osg::Matrixd& localToEcef, double sampleRatio,
                 bool withAnyTechnique)
        : SurfaceWalk(localToEcef),
          _model(ellipsoid),
          _ellipsoid(toCore(ellipsoid)),
          _sampleRatio(sampleRatio),
          _withAnyTechnique(withAnyTechnique) {}

    [[nodiscard]] TileSurface result() const {
        if (!isKnown()) return {};
        TileSurface surface = _result;
        surface.isEmpty = !surface.bin.valid();
        surface.isInMap = _ellipsoid.isPlane();
        return surface;
    }

private:
    void visit(osgTerrain::TerrainTile& tile) override {
        // its vertices are ECEF in the tile's own frame
        if (!localToEcef().isIdentity() || !(_withAnyTechnique || isDrawnByOsg(tile))) return giveUp();
        unite(terrainTileSurface(tile, _model, _sampleRatio));
    }

    void visit(osg::Drawable& drawable) override {
        thread_local PerThread<SurfaceMesh> kept;  // keeps its memory from tile to tile
        SurfaceMesh& mesh = *kept;
        if (!readMesh(drawable, localToEcef(), mesh, true)) return giveUp();
        if (!mesh.triangles.empty()) unite(meshSurface(mesh, localToEcef(), _ellipsoid));
        // after the vertices: OSG crashes on indices beyond them
        if (!isHeldByItsVertices(drawable)) visitUnknown(drawable);
    }

    void visitUnknown(osg::Node& node) override {
        const osg::BoundingBoxd bound = boundOf(node);
        if (!bound.valid()) return giveUp();
        SurfaceMesh box;
        addBox(bound, localToEcef(), box);
        unite(meshSurface(box, localToEcef(), _ellipsoid));
    }

    void visitBillboard(osg::Billboard& node) override {
        SurfaceMesh cubes, turned;
        const osg::Billboard::PositionList& positions = node.getPositionList();
        if (positions.size() != node.getNumChildren()) return giveUp();
        for (unsigned int i = 0; i < node.getNumChildren(); ++i) {
            const std::optional<double> reach = reachOf(node.getChild(i), turned);
            if (!reach) return giveUp();
            const osg::Vec3d middle(positions[i]), toCorner(*reach, *reach, *reach);
            addBox({middle - toCorner, middle + toCorner}, localToEcef(), cubes);
        }
        if (!cubes.triangles.empty()) unite(meshSurface(cubes, localToEcef(), _ellipsoid));
    }

    void unite(const TileSurface& part) {
        if (!part.bin.valid()) return giveUp();
        if (!_result.bin.valid()) {
            _result = part;
            return;
        }
        // heights that follow the vertical scale and such that do not have no bin in common
        if (part.isScalable != _result.isScalable) return giveUp();
        _result.bin.expandBy(part.bin);
        _result.skirt = std::max(_result.skirt, part.skirt);
    }

    const osg::EllipsoidModel& _model;
    core::Ellipsoid _ellipsoid;
    double _sampleRatio;
    bool _withAnyTechnique;
    TileSurface _result;
};

}  // namespace

TileSurface tileSurface(osg::Node& node, const osg::EllipsoidModel& ellipsoid, const osg::Matrixd& localToEcef,
                        double sampleRatio, bool withAnyTechnique) {
    if (!hasValidRadii(ellipsoid) && !isMapPlane(ellipsoid)) return {};
    SurfaceUnion surface(ellipsoid, localToEcef, sampleRatio, withAnyTechnique);
    node.accept(surface);
    return surface.result();
}

}  // namespace osgAnalyticBin
