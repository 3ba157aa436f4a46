// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TerrainBounds.h"

#include "GlmBridge.h"

#include <osgAnalyticBin/core/GeodeticMeshBounds.h>

#include <osg/Drawable>
#include <osg/Transform>
#include <osg/TriangleFunctor>

#include <cmath>
#include <vector>

namespace osgAnalyticBin {

namespace {

// Float vertices about the axis are that far off at most; they get no longitude of their own.
constexpr double kAxisTolerance = 1.0;
// Coarse meshes sag far below the ellipsoid, skirts hang lower still; what leaves these altitudes is no terrain.
constexpr double kLowestMesh = -1.0e6;
constexpr double kHighestMesh = 5.0e4;

struct Triangle {
    glm::dvec3 a, b, c;
};

// Receives the triangles of one drawable from osg::TriangleFunctor.
struct TriangleSink {
    const osg::Matrixd* toEcef = nullptr;
    std::vector<Triangle>* triangles = nullptr;

    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c, bool = false) const {
        const auto moved = [this](const osg::Vec3& v) { return toGlm(osg::Vec3d(v) * *toEcef); };
        triangles->push_back({moved(a), moved(b), moved(c)});
    }
};

class TriangleCollector : public osg::NodeVisitor {
public:
    explicit TriangleCollector(const osg::Matrixd& localToEcef)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _toEcef(localToEcef) {}

    void apply(osg::Transform& node) override {
        const osg::Matrixd outer = _toEcef;
        osg::Matrixd own;
        node.computeLocalToWorldMatrix(own, this);
        _toEcef = own * outer;
        traverse(node);
        _toEcef = outer;
    }

    void apply(osg::Drawable& drawable) override {
        osg::TriangleFunctor<TriangleSink> functor;
        functor.toEcef = &_toEcef;
        functor.triangles = &triangles;
        drawable.accept(functor);
    }

    std::vector<Triangle> triangles;

private:
    osg::Matrixd _toEcef;
};

glm::dvec3 middleOf(const std::vector<Triangle>& triangles) {
    glm::dvec3 sum(0.0);
    for (const Triangle& t : triangles) sum += t.a + t.b + t.c;
    return sum;
}

}  // namespace

AnalyticBin terrainBounds(osg::Node& node, const osg::EllipsoidModel& ellipsoid, const osg::Matrixd& localToEcef) {
    TriangleCollector collector(localToEcef);
    node.accept(collector);
    if (collector.triangles.empty()) return {};

    const glm::dvec3 middle = middleOf(collector.triangles);
    core::GeodeticMeshBounds bounds(toCore(ellipsoid), std::atan2(middle.y, middle.x), kAxisTolerance);
    for (const Triangle& t : collector.triangles) {
        for (const glm::dvec3& vertex : {t.a, t.b, t.c}) bounds.expandByVertex(vertex);
        bounds.expandByTriangle(t.a, t.b, t.c);
    }
    const core::GeodeticBin bin = bounds.bin();
    const bool isTerrain = !bin.empty() && bin.altitude().lower > kLowestMesh && bin.altitude().upper < kHighestMesh;
    return isTerrain ? AnalyticBin(bin, kAxisTolerance) : AnalyticBin();
}

}  // namespace osgAnalyticBin
