// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "MeshState.h"

#include "../Classes.h"
#include "../surface/SurfaceWalk.h"
#include "../surface/TerrainTileSurface.h"

#include <osgAnalyticBin/TileSurface.h>

#include <osg/Billboard>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Image>
#include <osg/MatrixTransform>
#include <osg/Transform>
#include <osgTerrain/Layer>

#include <cstring>

namespace osgAnalyticBin {

namespace {

// Whether a node is of one of the classes that most nodes are of. Models may have thousands of them.
bool isOfCommonClass(const osg::Node& node) {
    return isExactly<osg::Geometry>(node) || isExactly<osg::Geode>(node) || isExactly<osg::MatrixTransform>(node) ||
           isExactly<osg::Group>(node);
}

void mix(std::uint64_t& hash, std::uint64_t value) {
    hash = (hash ^ value) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 29;
}

void mixFloat(std::uint64_t& hash, float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    mix(hash, std::uint64_t{bits});
}

void mixBound(std::uint64_t& hash, const osg::BoundingSphere& bound) {
    for (const float value : {bound.center().x(), bound.center().y(), bound.center().z(), bound.radius()}) {
        mixFloat(hash, value);
    }
}

void mixFrame(std::uint64_t& hash, const osg::Transform& transform) {
    osg::Matrixd matrix;
    transform.computeLocalToWorldMatrix(matrix, nullptr);
    for (int i = 0; i < 16; ++i) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, matrix.ptr() + i, sizeof bits);
        mix(hash, bits);
    }
}

// Adds what decides whether the technique blends an osgTerrain tile.
void mixBlending(std::uint64_t& hash, const osgTerrain::TerrainTile& tile) {
    mix(hash, static_cast<std::uint64_t>(tile.getBlendingPolicy()));
    for (unsigned int i = 0; i < tile.getNumColorLayers(); ++i) {
        const osgTerrain::Layer* const layer = tile.getColorLayer(i);
        const osg::Image* const image = layer ? layer->getImage() : nullptr;
        mix(hash, reinterpret_cast<std::uintptr_t>(image));
        mix(hash, std::uint64_t{image ? image->getModifiedCount() : 0});
    }
}

// By what OSG tells that vertices and triangles have changed; of osgTerrain tiles, the heights and images.
void mixSurface(std::uint64_t& hash, const osg::Node& part) {
    if (const auto* const terrain = asTerrain(part)) {
        mix(hash, surfaceFingerprint(const_cast<osg::Node&>(part), osg::Matrixd()));
        mix(hash, std::uint64_t{isDrawnByOsg(*terrain)});
        mixBlending(hash, *terrain);
    }
    const auto* const billboard = isOfCommonClass(part) ? nullptr : dynamic_cast<const osg::Billboard*>(&part);
    if (billboard) {
        for (const osg::Vec3& position : billboard->getPositionList()) {
            for (int axis = 0; axis < 3; ++axis) mixFloat(hash, position[axis]);
        }
    }
    const osg::Geometry* const geometry = part.asGeometry();
    const osg::Array* const vertices = geometry ? geometry->getVertexArray() : nullptr;
    if (!vertices) return;
    mix(hash, reinterpret_cast<std::uintptr_t>(vertices));
    mix(hash, std::uint64_t{vertices->getNumElements()});
    mix(hash, std::uint64_t{vertices->getModifiedCount()});
    for (const auto& primitives : geometry->getPrimitiveSetList()) {
        mix(hash, reinterpret_cast<std::uintptr_t>(primitives.get()));
        if (!primitives) continue;
        mix(hash, std::uint64_t{primitives->getMode()});
        mix(hash, std::uint64_t{primitives->getNumIndices()});
        mix(hash, std::uint64_t{primitives->getModifiedCount()});
    }
}

}  // namespace

MeshState MeshState::of(const osg::Node& mesh) {
    MeshState state;
    forEachPart(mesh, [&state](const osg::Node& part) {
        mix(state.parts, reinterpret_cast<std::uintptr_t>(&part));
        if (part.asTransform()) mixFrame(state.frames, *part.asTransform());
        mixSurface(state.surfaces, part);
    });
    return state;
}

std::uint64_t contentOf(const osg::Node& mesh) {
    return surfaceFingerprint(const_cast<osg::Node&>(mesh), osg::Matrixd());
}

std::uint64_t boundsOf(const osg::Node& mesh) {
    std::uint64_t hash = 1;
    forEachPart(mesh, [&hash](const osg::Node& part) {
        if (!part.asGroup()) mixBound(hash, part.getBound());
    });
    return hash | 1;
}

std::uint64_t frameOf(const osg::Node& node) {
    std::uint64_t hash = 0;
    if (const osg::Transform* const transform = node.asTransform()) mixFrame(hash, *transform);
    return hash;
}

const osgTerrain::TerrainTile* asTerrain(const osg::Node& node) {
    return isOfCommonClass(node) ? nullptr : dynamic_cast<const osgTerrain::TerrainTile*>(&node);
}

}  // namespace osgAnalyticBin
