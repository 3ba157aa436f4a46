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

// Edges of a mesh, in the order of TileSurface::edgeLow, as bits of MeshSkirts::edges.
enum EdgeBit : std::uint8_t { kSouthEdge = 1, kEastEdge = 2, kNorthEdge = 4, kWestEdge = 8, kSkirtVertex = 16 };

// The skirts of a mesh.
struct MeshSkirts {
    // For each vertex: the edges on which it lies, and whether it is the lower one of two at the same place.
    std::vector<std::uint8_t> marks;
    // Metres, of the deepest.
    double depth = 0.0;
    // Square metres, of the longest chord of the border that a skirt hangs from.
    double borderChord2 = 0.0;
};

constexpr float kBorder = 1e-6f;  // of texture coordinates
// Skirts of one tile are equally deep to this part of their depth and this many metres on the earth, in proportion
// elsewhere (float vertices of large tiles).
constexpr double kDepthTolerance = 0.02;
constexpr double kDepthRounding = 4.0;
constexpr double kShallowest = 1.0;  // metres on the earth
// How far from straight down a skirt may hang: the geocentric vertical is 0.2 degrees off.
constexpr double kPlumbCosine = 0.999;

std::uint8_t edgesAt(const osg::Vec2& t) {
    const unsigned int south = unsigned{t.y() <= kBorder} * kSouthEdge;
    const unsigned int east = unsigned{t.x() >= 1.0f - kBorder} * kEastEdge;
    const unsigned int north = unsigned{t.y() >= 1.0f - kBorder} * kNorthEdge;
    const unsigned int west = unsigned{t.x() <= kBorder} * kWestEdge;
    return static_cast<std::uint8_t>(south | east | north | west);
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

// The triangles with a lower vertex, by their first index; `areSkirts` is false when one has a vertex off the border.
struct HangingTriangles {
    std::vector<std::uint32_t> first;
    bool areSkirts = true;
};

HangingTriangles hangingTriangles(const SurfaceMesh& mesh, const std::vector<std::uint8_t>& marks) {
    HangingTriangles hanging;
    hanging.first.resize(mesh.triangles.size() / 3 + 1);
    std::size_t count = 0;
    unsigned int bad = 0;
    // without branches, which would be mispredicted
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
        const unsigned int a = marks[mesh.triangles[i]];
        const unsigned int b = marks[mesh.triangles[i + 1]];
        const unsigned int c = marks[mesh.triangles[i + 2]];
        const unsigned int hangs = ((a | b | c) & kSkirtVertex) / kSkirtVertex;
        bad |= hangs & (unsigned{a == 0} | unsigned{b == 0} | unsigned{c == 0});
        hanging.first[count] = static_cast<std::uint32_t>(i);
        count += hangs;
    }
    hanging.first.resize(count);
    hanging.areSkirts = bad == 0;
    return hanging;
}

void fold(const std::vector<Pair>& pairs, SurfaceMesh& mesh) {
    for (const Pair& pair : pairs) {
        mesh.x[pair.lower] = mesh.x[pair.upper];
        mesh.y[pair.lower] = mesh.y[pair.upper];
        mesh.z[pair.lower] = mesh.z[pair.upper];
    }
}

// Two sides of a folded triangle are chords of the border, or all are points.
double longestChord2(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& folded) {
    double longest2 = 0.0;
    for (const std::uint32_t i : folded) {
        const glm::dvec3 middle = mesh.vertex(mesh.triangles[i + 1]);
        const glm::dvec3 before = mesh.vertex(mesh.triangles[i]) - middle;
        const glm::dvec3 after = mesh.vertex(mesh.triangles[i + 2]) - middle;
        longest2 = std::max(longest2, std::max(glm::dot(before, before), glm::dot(after, after)));
    }
    return longest2;
}

// Finds skirts as VirtualPlanetBuilder makes them: texture coordinates that run from 0 to 1 over the tile, and at
// every vertex on its border a second one straight below, all equally deep, which only border vertices are joined to.
// Folds them up: the lower vertices go to the upper ones, and with them all of the skirts to the border.
// Returns: no marks, and the mesh unchanged, when it differs from that in any way: skirts, if any, then count as
// surface.
MeshSkirts foldSkirts(SurfaceMesh& mesh, const core::Ellipsoid& ellipsoid) {
    if (!mesh.texCoords) return {};
    MeshSkirts skirts;
    skirts.marks.resize(mesh.size());
    bool inUnitSquare = true;
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        inUnitSquare &= isInUnitSquare(mesh.texCoords[i]);
        skirts.marks[i] = edgesAt(mesh.texCoords[i]);
    }
    if (!inUnitSquare) return {};
    const DepthMeasure measure(ellipsoid);
    const std::vector<Pair> pairs = pairsOf(mesh, skirts.marks, measure);
    if (pairs.empty()) return {};

    double shallowest2 = std::numeric_limits<double>::infinity();
    double deepest2 = 0.0;
    bool plumb = true;
    for (const Pair& pair : pairs) {
        const double depth2 = measure.depth2(mesh.vertex(pair.upper), mesh.vertex(pair.lower));
        plumb &= depth2 > 0.0;
        shallowest2 = std::min(shallowest2, depth2);
        deepest2 = std::max(deepest2, depth2);
        skirts.marks[pair.lower] |= kSkirtVertex;
    }
    skirts.depth = std::sqrt(deepest2);
    const double rounding = kDepthRounding * core::earthScale(ellipsoid);
    const bool equal = skirts.depth <= std::sqrt(shallowest2) * (1.0 + kDepthTolerance) + rounding;
    if (!plumb || !equal) return {};
    const HangingTriangles hanging = hangingTriangles(mesh, skirts.marks);
    if (!hanging.areSkirts) return {};
    fold(pairs, mesh);
    skirts.borderChord2 = longestChord2(mesh, hanging.first);
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

constexpr std::size_t kEdges = 4;

std::array<double, kEdges> lowestOnEdges(const std::vector<std::uint8_t>& marks, const std::vector<double>& altitudes) {
    std::array<double, kEdges> lows;
    lows.fill(std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < marks.size(); ++i) {
        if (marks[i] == 0) continue;
        for (std::size_t edge = 0; edge < kEdges; ++edge)
            if ((static_cast<unsigned int>(marks[i]) >> edge) & 1u) lows[edge] = std::min(lows[edge], altitudes[i]);
    }
    return lows;
}

// Metres that a chord of this length, squared, sags at most below its lower end.
double chordSag(double length2, const core::Ellipsoid& ellipsoid) {
    const double smallestRadius = core::smallestCurvatureRadius(ellipsoid) + lowestMesh(ellipsoid);
    return length2 / (8.0 * smallestRadius);
}

// Where skirts do not tell which vertices are on an edge, all may be.
std::array<double, kEdges> edgeLows(const core::MeshBounds& bounds, const MeshSkirts& skirts, double borderSag) {
    const double low = bounds.bin().altitude().lower, error = bounds.altitudeError() + borderSag;
    std::array<double, kEdges> lows = lowestOnEdges(skirts.marks, bounds.altitudes());
    for (double& edge : lows) edge = std::isfinite(edge) ? std::max(edge - error, low) : low;
    return lows;
}

// The surface of one drawable's mesh, whose skirts are folded up. Requires: at least one triangle, indices
// within the vertices.
TileSurface meshSurface(SurfaceMesh& mesh, const osg::Matrixd& localToEcef, const core::Ellipsoid& ellipsoid) {
    const MeshSkirts skirts = foldSkirts(mesh, ellipsoid);
    dropUnusedVertices(mesh);
    // keeps its memory: fresh pages from the system for every tile cost a third of the work
    thread_local PerThread<core::MeshBounds> kept;
    core::MeshBounds& bounds = *kept;
    bounds.find(ellipsoid, mesh);
    const core::Interval& altitude = bounds.bin().altitude();
    const bool isTerrain = altitude.lower > lowestMesh(ellipsoid) && altitude.upper < highestTerrain(ellipsoid);
    if (bounds.bin().empty() || !isTerrain) return {};

    TileSurface result;
    const double error = ellipsoid.isPlane()
                             ? drawingErrorOf(largestCoordinate(bounds.bin()))
                             : std::max(drawingError(ellipsoid), drawingErrorOf(farthestVertex(mesh, localToEcef)));
    result.bin = AnalyticBin(bounds.bin(), error + bounds.axisError());
    result.bin.setSag(bounds.sag());
    result.edgeLow = edgeLows(bounds, skirts, chordSag(skirts.borderChord2, ellipsoid));
    result.skirt = skirts.depth;
    return result;
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
        for (std::size_t i = 0; i < part.edgeLow.size(); ++i)
            _result.edgeLow[i] = std::min(_result.edgeLow[i], part.edgeLow[i]);
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
