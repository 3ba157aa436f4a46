// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SeeThrough.h"

#include "../install/TileCallback.h"
#include "ShaderText.h"

#include <osg/ClipPlane>
#include <osg/ColorMask>
#include <osg/CoordinateSystemNode>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/FrontFace>
#include <osg/Geode>
#include <osg/Image>
#include <osg/MatrixTransform>
#include <osg/Multisample>
#include <osg/PolygonMode>
#include <osg/PositionAttitudeTransform>
#include <osg/Texture>
#include <osgTerrain/Terrain>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <array>
#include <cmath>
#include <typeinfo>

namespace osgAnalyticBin {

namespace {

using Attribute = osg::StateAttribute;

template <class Type>
const Type* attribute(const osg::StateSet& state, Attribute::Type type) {
    return dynamic_cast<const Type*>(state.getAttribute(type));
}

bool drawsNoFaces(const osg::StateSet& state) {
    const auto* mode = attribute<osg::PolygonMode>(state, Attribute::POLYGONMODE);
    return mode && (mode->getMode(osg::PolygonMode::FRONT) != osg::PolygonMode::FILL ||
                    mode->getMode(osg::PolygonMode::BACK) != osg::PolygonMode::FILL);
}

bool leavesOutColours(const osg::StateSet& state) {
    const auto* mask = attribute<osg::ColorMask>(state, Attribute::COLORMASK);
    return mask && !(mask->getRedMask() && mask->getGreenMask() && mask->getBlueMask());
}

bool hasDoubtfulShaders(const osg::StateSet& state) {
    const auto* program = attribute<osg::Program>(state, Attribute::PROGRAM);
    return program && mayAlterSurface(*program);
}

bool leavesOutFrontFaces(const osg::StateSet& state) {
    const auto* face = attribute<osg::CullFace>(state, Attribute::CULLFACE);
    return face && face->getMode() != osg::CullFace::BACK && (state.getMode(GL_CULL_FACE) & Attribute::ON);
}

bool ignoresDepth(const osg::StateSet& state) {
    const auto* depth = attribute<osg::Depth>(state, Attribute::DEPTH);
    if (!depth) return false;
    switch (depth->getFunction()) {
        case osg::Depth::LESS:
        case osg::Depth::LEQUAL:
        case osg::Depth::GREATER:  // reversed depth
        case osg::Depth::GEQUAL:
            return !depth->getWriteMask();
        default:
            return true;
    }
}

bool hasDepthRange(const osg::StateSet& state) {
    const auto* depth = attribute<osg::Depth>(state, Attribute::DEPTH);
    return depth && (depth->getZNear() != 0.0 || depth->getZFar() != 1.0);
}

bool isClockwise(const osg::FrontFace& face) {
    return face.getMode() == osg::FrontFace::CLOCKWISE;
}

bool isMirror(const osg::Matrixd& m) {
    const osg::Vec3d x(m(0, 0), m(0, 1), m(0, 2)), y(m(1, 0), m(1, 1), m(1, 2)), z(m(2, 0), m(2, 1), m(2, 2));
    return (x ^ y) * z < 0.0;
}

bool isSeeThroughMode(const osg::StateSet::ModeList::value_type& mode) {
    const auto [name, value] = mode;
    const bool isOn = value & Attribute::ON;
    const bool isInherited = value & Attribute::INHERIT;
    if (name == GL_DEPTH_TEST) return !isOn && !isInherited;
    constexpr GLenum kMostClipPlanes = 16;
    const bool isClipPlane = name >= GL_CLIP_PLANE0 && name < GL_CLIP_PLANE0 + kMostClipPlanes;
    return isOn && (isClipPlane || name == GL_BLEND || name == GL_ALPHA_TEST || name == GL_STENCIL_TEST ||
                    name == GL_POLYGON_STIPPLE || name == GL_SAMPLE_ALPHA_TO_COVERAGE_ARB);
}

// OSG takes some textures without alpha for translucent.
bool hasAlpha(const osg::Image& image) {
    return image.getPixelFormat() != GL_COMPRESSED_RGB_S3TC_DXT1_EXT && image.isImageTranslucent();
}

// osgTerrain::GeometryTechnique leaves out the triangles at posts that are not valid.
bool hasHole(const osgTerrain::TerrainTile& tile) {
    const osgTerrain::Layer* const layer = tile.getElevationLayer();
    if (!layer || !layer->getValidDataOperator()) return false;
    for (unsigned int row = 0; row < layer->getNumRows(); ++row) {
        for (unsigned int column = 0; column < layer->getNumColumns(); ++column) {
            float height = 0.0f;
            if (!layer->getValidValue(column, row, height)) return true;
        }
    }
    return false;
}

// As the technique decides, by the first image.
bool isBlended(const osgTerrain::TerrainTile& tile) {
    using Tile = osgTerrain::TerrainTile;
    Tile::BlendingPolicy policy = tile.getBlendingPolicy();
    if (policy == Tile::INHERIT && tile.getTerrain()) policy = tile.getTerrain()->getBlendingPolicy();
    if (policy == Tile::DO_NOT_SET_BLENDING) return false;
    if (policy == Tile::ENABLE_BLENDING) return true;
    for (unsigned int i = 0; i < tile.getNumColorLayers(); ++i) {
        const osgTerrain::Layer* const layer = tile.getColorLayer(i);
        const osg::Image* const image = layer ? layer->getImage() : nullptr;
        if (image) return hasAlpha(*image);
    }
    return false;
}

}  // namespace

bool isSeeThrough(const osg::StateSet& state) {
    if (state.getRenderingHint() == osg::StateSet::TRANSPARENT_BIN) return true;
    const osg::StateSet::ModeList& modes = state.getModeList();
    return std::any_of(modes.begin(), modes.end(), isSeeThroughMode) || drawsNoFaces(state) ||
           leavesOutFrontFaces(state) || ignoresDepth(state) || leavesOutColours(state) || hasDoubtfulShaders(state);
}

bool isPartSeeThrough(const osg::StateSet& state) {
    const auto* face = attribute<osg::FrontFace>(state, Attribute::FRONTFACE);
    return isSeeThrough(state) || hasDepthRange(state) || (face && isClockwise(*face));
}

bool isSeeThrough(const osgTerrain::TerrainTile& tile) {
    return hasHole(tile) || isBlended(tile);
}

bool isStateSeeThrough(osg::NodeVisitor& visitor) {
    osgUtil::CullVisitor* const cullVisitor = visitor.asCullVisitor();
    if (!cullVisitor) return false;
    const osg::FrontFace* face = nullptr;
    for (const auto* graph = cullVisitor->getCurrentStateGraph(); graph; graph = graph->_parent) {
        const osg::StateSet* const state = graph->_stateset;
        if (state && isSeeThrough(*state)) return true;
        if (state && !face) face = attribute<osg::FrontFace>(*state, Attribute::FRONTFACE);
    }
    // a tile's own state may switch the culling of back faces on
    return (face && isClockwise(*face)) != isMirror(*cullVisitor->getModelViewMatrix());
}

double depthRangeOfState(osg::NodeVisitor& visitor) {
    osgUtil::CullVisitor* const cullVisitor = visitor.asCullVisitor();
    double narrowest = 1.0;
    for (const auto* graph = cullVisitor ? cullVisitor->getCurrentStateGraph() : nullptr; graph;
         graph = graph->_parent) {
        const auto* const depth =
            graph->_stateset ? attribute<osg::Depth>(*graph->_stateset, Attribute::DEPTH) : nullptr;
        if (depth) narrowest = std::min(narrowest, std::abs(depth->getZFar() - depth->getZNear()));
    }
    return narrowest;
}

bool drawsAllChildren(const osg::Node& node) {
    static const std::array<const std::type_info*, 7> known{
        &typeid(osg::Group),           &typeid(Carrier),
        &typeid(osg::MatrixTransform), &typeid(osg::PositionAttitudeTransform),
        &typeid(osg::Geode),           &typeid(osg::CoordinateSystemNode),
        &typeid(osgTerrain::Terrain)};
    const std::type_info& type = typeid(node);
    // by address first: comparing names takes longer
    return !node.asGroup() || std::find(known.begin(), known.end(), &type) != known.end() ||
           std::any_of(known.begin(), known.end(), [&type](const std::type_info* one) { return *one == type; });
}

}  // namespace osgAnalyticBin
