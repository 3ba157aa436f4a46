// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ContentWatch.h"

#include "Database.h"
#include "GlmBridge.h"
#include "InstalledTile.h"
#include "PlanarBinCullCallback.h"
#include "Spheres.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <osg/CoordinateSystemNode>
#include <osg/Transform>
#include <osgTerrain/TerrainTile>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace osgAnalyticBin {

namespace {

const ContentWatch* watchOf(const osg::Node& node) {
    return dynamic_cast<const ContentWatch*>(node.getComputeBoundingSphereCallback());
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

// What changes when a part of a mesh is added, removed, moved or replaced by one with other bounds. Tiles inside look
// after themselves; a terrain tile draws nothing of what is below it.
void addSignature(const osg::Node& node, std::uint64_t& hash) {
    mix(hash, reinterpret_cast<std::uintptr_t>(&node));
    if (watchOf(node) || dynamic_cast<const osgTerrain::TerrainTile*>(&node)) return;
    if (node.asDrawable()) mixBound(hash, node.getBound());
    if (node.asTransform()) mixFrame(hash, *node.asTransform());
    const osg::Group* const group = node.asGroup();
    for (unsigned int i = 0; group && i < group->getNumChildren(); ++i) addSignature(*group->getChild(i), hash);
}

std::uint64_t signatureOf(const osg::Node& node) {
    std::uint64_t hash = 1;
    addSignature(node, hash);
    return hash;
}

// The content as the box of latitudes, longitudes and altitudes about its sphere. Not valid: it has none.
AnalyticBin binAbout(const osg::BoundingSphere& sphere, const core::Ellipsoid& ellipsoid) {
    const glm::dvec3 center = toGlm(osg::Vec3d(sphere.center()));
    const double radius = sphere.radius() * 1.001;
    const core::Geodetic middle = ellipsoid.toGeodetic(center);
    const double fromAxis = std::hypot(center.x, center.y);
    const double a = ellipsoid.equatorialRadius();
    const double b = ellipsoid.polarRadius();
    // of the smallest circle of curvature that a meridian has at this altitude
    const double fromCurvature = std::min(a * (a / b), b * (b / a)) + middle.altitude - radius;
    if (!std::isfinite(fromAxis + radius) || !(fromCurvature > radius) || !(fromAxis > radius)) return {};
    const double north = std::asin(radius / fromCurvature);
    const double east = std::asin(radius / fromAxis);
    return AnalyticBin(core::GeodeticBin({middle.latitude - north, middle.latitude + north},
                                         {middle.longitude - east, middle.longitude + east},
                                         {middle.altitude - radius, middle.altitude + radius}));
}

void fitInto(const AnalyticBinCullCallback& callback, const osg::BoundingSphere& sphere) {
    InstalledTile* const tile = callback.installedTile();
    if (!tile || !callback.bin().valid()) return;
    // the bin is that of the terrain before it is exaggerated, the content is not
    const bool isScaled = callback.terrainShape() && callback.terrainShape()->verticalScale != 1.0;
    const core::Ellipsoid ellipsoid = toCore(*tile->database().ellipsoid());
    const AnalyticBin content =
        isScaled ? AnalyticBin() : binAbout(movedSphere(sphere, callback.localToEcef()), ellipsoid);
    if (content.valid() && callback.bin().bin().contains(content.bin())) return;
    tile->keepVisible(true);
    tile->database().noteContent(callback, {content, !content.valid()});
}

void fitInto(const PlanarBinCullCallback& callback, const osg::BoundingSphere& sphere) {
    if (callback.installedTile() && !callback.bin().holds(sphere)) callback.installedTile()->keepVisible(true);
}

// Looks whether all tiles from the node upwards hold what stands among the node's children. Returns: whether this got
// to the database's root.
bool fitIntoTilesFrom(const osg::Node& node, const osg::BoundingSphere& sphere) {
    if (dynamic_cast<const osg::CoordinateSystemNode*>(&node)) return true;
    for (const osg::Callback* at = node.getCullCallback(); at; at = at->getNestedCallback()) {
        if (const auto* bin = dynamic_cast<const AnalyticBinCullCallback*>(at)) fitInto(*bin, sphere);
        if (const auto* planar = dynamic_cast<const PlanarBinCullCallback*>(at)) fitInto(*planar, sphere);
    }
    osg::BoundingSphere moved = sphere;
    if (const osg::Transform* const transform = node.asTransform()) {
        osg::Matrixd matrix;
        transform->computeLocalToWorldMatrix(matrix, nullptr);
        moved = movedSphere(sphere, matrix);
    }
    bool isComplete = node.getNumParents() > 0;
    for (const osg::Group* const parent : node.getParents()) {
        isComplete = fitIntoTilesFrom(*parent, moved) && isComplete;
    }
    return isComplete;
}

bool isAbsolute(const osg::Node& node) {
    const osg::Transform* const transform = node.asTransform();
    return transform && transform->getReferenceFrame() != osg::Transform::RELATIVE_RF;
}

}  // namespace

ContentWatch::ContentWatch(const ContentWatch& other, const osg::CopyOp& copyop)
    : osg::Node::ComputeBoundingSphereCallback(other, copyop) {}

void ContentWatch::place(osg::Node& node, const std::vector<osg::ref_ptr<osg::Node>>& fitted) {
    remove(node);
    const osg::ref_ptr<ContentWatch> watch = new ContentWatch;
    watch->_node = &node;
    watch->_previous = node.getComputeBoundingSphereCallback();
    for (const auto& mesh : fitted) {
        if (mesh != &node) watch->_fitted.push_back({mesh, signatureOf(*mesh)});
    }
    const bool isMesh = std::find(fitted.begin(), fitted.end(), &node) != fitted.end();
    const osg::Group* const group = isMesh ? node.asGroup() : nullptr;
    for (unsigned int i = 0; group && i < group->getNumChildren(); ++i) {
        watch->_fitted.push_back({group->getChild(i), signatureOf(*group->getChild(i))});
    }
    node.setComputeBoundingSphereCallback(watch);
    // what is there already, beside meshes, is looked at with the next bound
    node.dirtyBound();
}

void ContentWatch::remove(osg::Node& node) {
    if (const ContentWatch* const watch = watchOf(node)) {
        node.setComputeBoundingSphereCallback(osg::ref_ptr(watch->_previous).get());
    }
}

osg::BoundingSphere ContentWatch::computeBound(const osg::Node& node) const {
    if (&node == _node) check(node);
    return _previous ? _previous->computeBound(node) : node.computeBound();
}

bool ContentWatch::isFitted(const osg::Node& child) const {
    const auto known =
        std::find_if(_fitted.begin(), _fitted.end(), [&](const Fitted& fitted) { return fitted.node == &child; });
    return known != _fitted.end() && known->signature == signatureOf(child);
}

void ContentWatch::check(const osg::Node& node) const {
    _isPending = false;
    // osgTerrain draws nothing of what is below its tiles
    const osg::Group* const group = dynamic_cast<const osgTerrain::TerrainTile*>(&node) ? nullptr : node.asGroup();
    for (unsigned int i = 0; group && i < group->getNumChildren(); ++i) {
        const osg::Node& child = *group->getChild(i);
        const osg::BoundingSphere& sphere = child.getBound();  // has others look at what is below it, too
        const ContentWatch* const watch = child.getNumParents() == 1 ? watchOf(child) : nullptr;
        if (watch && watch->_node == &child) {
            if (watch->_isPending) watch->check(child);
            _isPending = _isPending || watch->_isPending;
        } else if (sphere.valid() && !isAbsolute(child) && !isFitted(child)) {
            _isPending = !fitIntoTilesFrom(node, sphere) || _isPending;
        }
    }
}

}  // namespace osgAnalyticBin
