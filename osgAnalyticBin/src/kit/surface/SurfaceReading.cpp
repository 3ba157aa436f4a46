// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../GlmBridge.h"
#include "../PerThread.h"
#include "Skirts.h"
#include "SurfaceMesh.h"
#include "SurfaceWalk.h"
#include "TerrainLimits.h"
#include "TerrainTileSurface.h"

#include <osgAnalyticBin/TileFrame.h>
#include <osgAnalyticBin/TileSurface.h>

#include <osg/Billboard>
#include <osg/BoundingBox>
#include <osg/BoundingSphere>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace osgAnalyticBin {

namespace {

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
        if (!readMesh(drawable, localToEcef(), mesh)) return giveUp();
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
