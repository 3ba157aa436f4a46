// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DrawnState.h"

#include "../Classes.h"
#include "../tile/Carrier.h"
#include "../tile/InstalledTile.h"

#include <osgAnalyticBin/Declarations.h>

#include <osg/AlphaFunc>
#include <osg/Billboard>
#include <osg/BlendColor>
#include <osg/BlendEquation>
#include <osg/BlendFunc>
#include <osg/ClampColor>
#include <osg/ClipPlane>
#include <osg/ColorMask>
#include <osg/CoordinateSystemNode>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/Fog>
#include <osg/FrontFace>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Hint>
#include <osg/Image>
#include <osg/LOD>
#include <osg/Light>
#include <osg/LightModel>
#include <osg/LineStipple>
#include <osg/LineWidth>
#include <osg/LogicOp>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/Multisample>
#include <osg/PagedLOD>
#include <osg/Point>
#include <osg/PointSprite>
#include <osg/PolygonMode>
#include <osg/PolygonStipple>
#include <osg/PositionAttitudeTransform>
#include <osg/Program>
#include <osg/Scissor>
#include <osg/Sequence>
#include <osg/ShadeModel>
#include <osg/ShapeDrawable>
#include <osg/Switch>
#include <osg/TexEnv>
#include <osg/TexEnvCombine>
#include <osg/TexEnvFilter>
#include <osg/TexGen>
#include <osg/TexMat>
#include <osg/Texture1D>
#include <osg/Texture2D>
#include <osg/Texture2DArray>
#include <osg/Texture3D>
#include <osg/TextureCubeMap>
#include <osg/TextureRectangle>
#include <osgTerrain/Terrain>
#include <osgUtil/CullVisitor>

#include <algorithm>

namespace osgAnalyticBin {

namespace {

using Attribute = osg::StateAttribute;

constexpr GLenum kSeamlessCubeMaps = 0x884F;  // GL_TEXTURE_CUBE_MAP_SEAMLESS
constexpr DrawnState kHarmless{true, true}, kUnknown{false, false}, kHidesNothing{false, true};

DrawnState ofDepth(const osg::Depth& depth) {
    const bool isNearest = depth.getFunction() == osg::Depth::LESS || depth.getFunction() == osg::Depth::LEQUAL;
    if (!isNearest || depth.getZNear() != 0.0 || depth.getZFar() != 1.0) return kUnknown;
    return depth.getWriteMask() ? kHarmless : kHidesNothing;
}

DrawnState ofPolygonMode(const osg::PolygonMode& mode) {
    const bool isFilled = mode.getMode(osg::PolygonMode::FRONT) == osg::PolygonMode::FILL &&
                          mode.getMode(osg::PolygonMode::BACK) == osg::PolygonMode::FILL;
    return isFilled ? kHarmless : kUnknown;
}

DrawnState ofColorMask(const osg::ColorMask& mask) {
    const bool drawsAll = mask.getRedMask() && mask.getGreenMask() && mask.getBlueMask() && mask.getAlphaMask();
    return drawsAll ? kHarmless : kHidesNothing;
}

DrawnState ofProgram(const osg::Program& program, const StateRules& rules) {
    return rules.trustsShaders || drawsTriangles(program) ? kHarmless : kUnknown;
}

DrawnState ofCullFace(const osg::CullFace& face) {
    return face.getMode() == osg::CullFace::BACK ? kHarmless : kHidesNothing;
}

DrawnState ofFrontFace(const osg::FrontFace& face, const StateRules& rules) {
    const bool isClockwise = face.getMode() == osg::FrontFace::CLOCKWISE;
    return isClockwise == rules.isClockwise ? kHarmless : kHidesNothing;
}

// Frozen cameras and those that follow others have viewports of the same extent.
DrawnState ofViewport(const osg::Viewport& viewport, const StateRules& rules) {
    return rules.viewport && viewport.compare(*rules.viewport) == 0 ? kHarmless : kUnknown;
}

// Of an attribute whose type is that of the class, if it is of no class derived from it.
template <class Class, class Of, class... Rules>
DrawnState ofExactly(const Attribute& attribute, const Of& of, const Rules&... rules) {
    return isOneOf<Class>(attribute) ? of(static_cast<const Class&>(attribute), rules...) : kUnknown;
}

DrawnState ofAttribute(const Attribute& attribute, const StateRules& rules) {
    if (attribute.getShaderComponent()) return kUnknown;
    switch (attribute.getType()) {
        case Attribute::CULLFACE:
            return ofExactly<osg::CullFace>(attribute, ofCullFace);
        case Attribute::FRONTFACE:
            return ofExactly<osg::FrontFace>(attribute, ofFrontFace, rules);
        case Attribute::DEPTH:
            return ofExactly<osg::Depth>(attribute, ofDepth);
        case Attribute::POLYGONMODE:
            return ofExactly<osg::PolygonMode>(attribute, ofPolygonMode);
        case Attribute::COLORMASK:
            return ofExactly<osg::ColorMask>(attribute, ofColorMask);
        case Attribute::PROGRAM:
            return ofExactly<osg::Program>(attribute, ofProgram, rules);
        case Attribute::VIEWPORT:
            return ofExactly<osg::Viewport>(attribute, ofViewport, rules);
        default:
            break;
    }
    // the others only matter while a mode is on, and are known by the mode
    const bool isKnown =
        isOneOf<osg::Material, osg::Light, osg::LightModel, osg::Fog, osg::ShadeModel, osg::AlphaFunc, osg::BlendFunc,
                osg::BlendEquation, osg::BlendColor, osg::Scissor, osg::LogicOp, osg::PolygonStipple, osg::LineWidth,
                osg::LineStipple, osg::Point, osg::Hint, osg::ClampColor, osg::Multisample, osg::ClipPlane>(attribute);
    return isKnown ? kHarmless : kUnknown;
}

DrawnState ofTextureAttribute(const Attribute& attribute) {
    const bool isKnown = isOneOf<osg::Texture2D, osg::TexEnv, osg::PointSprite, osg::TexEnvCombine, osg::TexEnvFilter,
                                 osg::TexGen, osg::TexMat, osg::Texture1D, osg::Texture3D, osg::TextureCubeMap,
                                 osg::TextureRectangle, osg::Texture2DArray>(attribute);
    return isKnown && !attribute.getShaderComponent() ? kHarmless : kUnknown;
}

DrawnState ofMode(GLenum mode, Attribute::GLModeValue value) {
    if (value & Attribute::INHERIT) return kHarmless;
    const bool isOn = value & Attribute::ON;
    if (mode == GL_DEPTH_TEST) return isOn ? kHarmless : kUnknown;
    if (!isOn) return kHarmless;
    constexpr GLenum kMostOfAKind = 16;  // lights, clip planes
    if (mode >= GL_LIGHT0 && mode < GL_LIGHT0 + kMostOfAKind) return kHarmless;
    if (mode >= GL_CLIP_PLANE0 && mode < GL_CLIP_PLANE0 + kMostOfAKind) return kHidesNothing;
    switch (mode) {
        case GL_LIGHTING:
        case GL_FOG:
        case GL_NORMALIZE:
        case GL_RESCALE_NORMAL:
        case GL_COLOR_MATERIAL:
        case GL_COLOR_SUM:
        case GL_DITHER:
        case GL_CULL_FACE:
        case GL_MULTISAMPLE_ARB:
        case GL_LINE_SMOOTH:
        case GL_LINE_STIPPLE:
        case GL_POINT_SMOOTH:
        case GL_POINT_SPRITE_ARB:
        case GL_PROGRAM_POINT_SIZE:
        case GL_FRAMEBUFFER_SRGB:
        case kSeamlessCubeMaps:
            return kHarmless;
        case GL_BLEND:
        case GL_ALPHA_TEST:
        case GL_POLYGON_STIPPLE:
        case GL_COLOR_LOGIC_OP:
        case GL_SCISSOR_TEST:
        case GL_SAMPLE_ALPHA_TO_COVERAGE_ARB:
        case GL_SAMPLE_COVERAGE_ARB:
            return kHidesNothing;
        default:
            return kUnknown;
    }
}

// The bins that come with OSG draw what they hold, in one order or another; that which sorts by depth, with an alpha
// test.
DrawnState ofRenderBin(const osg::StateSet& state) {
    if (state.getRenderBinMode() == osg::StateSet::INHERIT_RENDERBIN_DETAILS) return kHarmless;
    const std::string& name = state.getBinName();
    if (name == "DepthSortedBin") return kHidesNothing;
    const bool isKnown = name.empty() || name == "RenderBin" || name == "StateSortedBin" || name == "TraversalOrderBin";
    return isKnown ? kHarmless : kUnknown;
}

// Whether a visitor's picture is that of a mirror, by its view or by its projection.
bool isMirrored(osgUtil::CullVisitor& visitor) {
    const osg::Matrixd &m = *visitor.getModelViewMatrix(), &p = *visitor.getProjectionMatrix();
    const osg::Vec3d x(m(0, 0), m(0, 1), m(0, 2)), y(m(1, 0), m(1, 1), m(1, 2)), z(m(2, 0), m(2, 1), m(2, 2));
    const bool looksBackward = p(2, 3) > 0.0;
    return ((x ^ y) * z < 0.0) != ((p(0, 0) * p(1, 1) < p(0, 1) * p(1, 0)) != looksBackward);
}

// As the technique decides it, by the first image. A tile that inherits the policy knows its Terrain only after its
// first traversal: the database asks the Terrain in each view.
bool isBlended(const osgTerrain::TerrainTile& tile) {
    using Tile = osgTerrain::TerrainTile;
    const Tile::BlendingPolicy policy = tile.getBlendingPolicy();
    if (policy == Tile::DO_NOT_SET_BLENDING) return false;
    if (policy == Tile::ENABLE_BLENDING) return true;
    for (unsigned int i = 0; i < tile.getNumColorLayers(); ++i) {
        const osgTerrain::Layer* const layer = tile.getColorLayer(i);
        const osg::Image* const image = layer ? layer->getImage() : nullptr;
        if (image) return image->isImageTranslucent();
    }
    return false;
}

// Those that enter their children, all or some, and change no state but by their StateSets.
bool isKnownGroup(const osg::Node& node) {
    return isOneOf<osg::Group, osg::Geode, osg::MatrixTransform, Carrier, osg::PagedLOD, osg::LOD, osg::Switch,
                   osg::PositionAttitudeTransform, osg::CoordinateSystemNode, osgTerrain::Terrain, osg::Sequence,
                   osg::Billboard>(node);
}

DrawnState ofDrawable(const osg::Drawable& drawable) {
    if (drawable.getDrawCallback()) return kUnknown;
    if (!isOneOf<osg::Geometry, osg::ShapeDrawable>(drawable)) return kUnknown;
    // OSG may leave out what is not in a box of the application's
    return drawable.getComputeBoundingBoxCallback() ? kHidesNothing : kHarmless;
}

DrawnState ofClass(const osg::Node& node) {
    if (isExactly<osg::Group>(node) || isExactly<osg::Geode>(node)) return kHarmless;
    if (const osg::Drawable* const drawable = node.asDrawable()) return ofDrawable(*drawable);
    if (isOneOf<osgTerrain::TerrainTile>(node))
        return isBlended(static_cast<const osgTerrain::TerrainTile&>(node)) ? kHidesNothing : kHarmless;
    if (!isKnownGroup(node)) return kUnknown;
    return drawsAllChildren(node) ? kHarmless : kHidesNothing;
}

}  // namespace

unsigned int reasonsAbove(const DrawnState& drawn) {
    return (drawn.obeysDepth ? 0u : InstalledTile::IgnoresDepth) | (drawn.isCulled ? 0u : InstalledTile::NeverCulled);
}

DrawnState drawnState(const osg::StateSet& state, const StateRules& rules) {
    DrawnState drawn = ofRenderBin(state);
    for (const auto& [mode, value] : state.getModeList()) drawn &= ofMode(mode, value);
    for (const auto& [key, value] : state.getAttributeList()) drawn &= ofAttribute(*value.first, rules);
    for (const auto& unit : state.getTextureAttributeList()) {
        for (const auto& [key, value] : unit) drawn &= ofTextureAttribute(*value.first);
    }
    return drawn;
}

StateRules StateRules::of(osg::NodeVisitor& visitor, bool trustsShaders) {
    osgUtil::CullVisitor* const cullVisitor = visitor.asCullVisitor();
    if (!cullVisitor) return {trustsShaders};
    return {trustsShaders, isMirrored(*cullVisitor), cullVisitor->getViewport()};
}

DrawnState drawnStateByClass(const osg::Node& node, const StateRules& rules) {
    DrawnState drawn = drawnStateOf(node, rules);
    drawn &= ofClass(node);
    return drawn;
}

bool drawsFaces(const osg::Node& node) {
    const osg::Geometry* const geometry = node.asGeometry();
    if (!geometry) return true;
    const osg::Geometry::PrimitiveSetList& sets = geometry->getPrimitiveSetList();
    return std::all_of(sets.begin(), sets.end(), [](const osg::ref_ptr<osg::PrimitiveSet>& primitives) {
        return !primitives || (primitives->getMode() >= GL_TRIANGLES && primitives->getMode() <= GL_POLYGON);
    });
}

DrawnState drawnStates(const osgUtil::StateGraph* graph, const osgUtil::StateGraph* end, const StateRules& rules) {
    DrawnState drawn;
    for (; graph && graph != end; graph = graph->_parent) {
        if (graph->_stateset) drawn &= drawnState(*graph->_stateset, rules);
    }
    return drawn;
}

bool saysDepthTest(osgUtil::CullVisitor& visitor, const osgUtil::StateGraph* graph) {
    bool says = !visitor.getRenderInfo().getView();
    for (; !says && graph; graph = graph->_parent)
        says = graph->_stateset && !(graph->_stateset->getMode(GL_DEPTH_TEST) & Attribute::INHERIT);
    return says;
}

DrawnState drawnStateAbove(osg::NodeVisitor& visitor, const StateRules& rules, const osgUtil::StateGraph* end) {
    osgUtil::CullVisitor* const cullVisitor = visitor.asCullVisitor();
    if (!cullVisitor) return kHarmless;
    const osgUtil::StateGraph* const present = cullVisitor->getCurrentStateGraph();
    DrawnState drawn = drawnStates(present, end, rules);
    bool isWindingSet = !rules.isClockwise;
    for (const auto* graph = present; !isWindingSet && graph && graph != end; graph = graph->_parent)
        isWindingSet = graph->_stateset && graph->_stateset->getAttribute(Attribute::FRONTFACE);
    if (!isWindingSet) drawn &= kHidesNothing;
    if (!end && !saysDepthTest(*cullVisitor, present)) drawn &= kUnknown;
    return drawn;
}

bool hasBeenTraversed(const osgTerrain::TerrainTile& tile) {
    // what osgTerrain keeps for derived classes
    struct OpenTile : public osgTerrain::TerrainTile {
        static bool wasTraversed(const osgTerrain::TerrainTile& tile) { return tile.*(&OpenTile::_hasBeenTraversal); }
    };
    return OpenTile::wasTraversed(tile);
}

bool drawsAllChildren(const osg::Node& node) {
    return !node.asGroup() ||
           isOneOf<osg::Group, osg::Geode, osg::MatrixTransform, Carrier, osg::PositionAttitudeTransform,
                   osg::CoordinateSystemNode, osgTerrain::Terrain>(node);
}

}  // namespace osgAnalyticBin
