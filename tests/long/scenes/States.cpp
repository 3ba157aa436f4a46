// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Painter.h"
#include "Parts.h"

#include <osg/AlphaFunc>
#include <osg/BlendColor>
#include <osg/BlendEquation>
#include <osg/BlendFunc>
#include <osg/ClampColor>
#include <osg/ClipControl>
#include <osg/ClipPlane>
#include <osg/ColorMask>
#include <osg/CullFace>
#include <osg/DepthRangeIndexed>
#include <osg/Fog>
#include <osg/FragmentProgram>
#include <osg/FrontFace>
#include <osg/Hint>
#include <osg/Light>
#include <osg/LightModel>
#include <osg/LineStipple>
#include <osg/LineWidth>
#include <osg/LogicOp>
#include <osg/Material>
#include <osg/Multisample>
#include <osg/Point>
#include <osg/PointSprite>
#include <osg/PolygonOffset>
#include <osg/PolygonStipple>
#include <osg/PrimitiveRestartIndex>
#include <osg/SampleMaski>
#include <osg/Sampler>
#include <osg/Scissor>
#include <osg/ScissorIndexed>
#include <osg/ShadeModel>
#include <osg/Shader>
#include <osg/ShaderAttribute>
#include <osg/Stencil>
#include <osg/StencilTwoSided>
#include <osg/TexEnv>
#include <osg/TexEnvCombine>
#include <osg/TexEnvFilter>
#include <osg/TexGen>
#include <osg/TexMat>
#include <osg/Texture2D>
#include <osg/VertexAttribDivisor>
#include <osg/VertexProgram>

namespace osgAnalyticBin::test {

namespace {

using Value = osg::StateAttribute::GLModeValue;
using Maker = std::function<osg::ref_ptr<osg::StateAttribute>()>;

struct NamedState {
    const char* name;
    Maker attribute;            // may be none
    std::vector<GLenum> modes;  // besides those of the attribute
    bool hasModes = true;       // those of the attribute
    unsigned int unit = 0;
    bool isTexture = false;
};

constexpr GLenum kDepthClamp = 0x864F;
constexpr GLenum kDiscard = 0x8C89;
constexpr GLenum kRestart = 0x8F9D;
constexpr GLenum kClipDistance = 0x3000;

template <class Attribute, class... Arguments>
Maker made(Arguments... arguments) {
    return [=] { return osg::ref_ptr<osg::StateAttribute>(new Attribute(arguments...)); };
}

// All scenes share programs: compiling takes longer than a scene.
Maker shared(const Maker& maker) {
    auto kept = std::make_shared<osg::ref_ptr<osg::StateAttribute>>();
    return [=] {
        if (!*kept) *kept = maker();
        return *kept;
    };
}

template <class Attribute, class Set>
Maker configured(const Set& set) {
    return [=]() -> osg::ref_ptr<osg::StateAttribute> {
        const osg::ref_ptr<Attribute> made = new Attribute;
        set(*made);
        return made;
    };
}

Maker program(const std::string& vertexShader, const std::string& fragmentMain, bool isDeclared = false) {
    return shared(configured<osg::Program>([=](auto& made) {
        made.addShader(new osg::Shader(osg::Shader::VERTEX, vertexShader));
        made.addShader(new osg::Shader(osg::Shader::FRAGMENT, kPaintFunction + fragmentMain));
        if (isDeclared) setDrawsTriangles(made);
    }));
}

// No vertex comes out of it.
Maker geometryProgram() {
    return shared(configured<osg::Program>([](auto& made) {
        made.addShader(new osg::Shader(osg::Shader::VERTEX, kVertexShader));
        made.addShader(new osg::Shader(osg::Shader::GEOMETRY,
                                       "#version 150 compatibility\n"
                                       "layout(triangles) in;\n"
                                       "layout(triangle_strip, max_vertices = 3) out;\n"
                                       "void main() {}\n"));
        made.addShader(
            new osg::Shader(osg::Shader::FRAGMENT, std::string(kPaintFunction) + "void main() { paintFragment(); }\n"));
    }));
}

osg::ref_ptr<osg::StateAttribute> makeTexture() {
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(2, 2, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    std::fill_n(image->data(), 16, static_cast<unsigned char>(255));
    return new osg::Texture2D(image);
}

osg::ref_ptr<osg::StateAttribute> makeStipple() {
    GLubyte pattern[128];
    std::fill_n(pattern, 128, static_cast<GLubyte>(0x0F));
    return new osg::PolygonStipple(pattern);
}

// Not among them: osg::ViewportIndexed, which OSG leaves in force for all that is drawn later.
std::vector<NamedState> makeStates() {
    const std::string paints = "void main() { paintFragment(); }\n";
    std::vector<NamedState> all{
        {"scissor", made<osg::Scissor>(0, 0, 1, 1), {}},
        {"indexed scissor", made<osg::ScissorIndexed>(0u, 0.0f, 0.0f, 1.0f, 1.0f), {GL_SCISSOR_TEST}},
        {"logic op", made<osg::LogicOp>(osg::LogicOp::NOOP), {}},
        {"logic op, exclusive or", made<osg::LogicOp>(osg::LogicOp::XOR), {}},
        {"rasterizer discard", nullptr, {kDiscard}},
        {"viewport", made<osg::Viewport>(0, 0, 64, 64), {}},
        {"no program", shared(made<osg::Program>()), {}},
        // OpenGL uses assembly programs only while no GLSL program is bound
        {"ARB vertex program",
         shared(configured<osg::VertexProgram>(
             [](auto& made) { made.setVertexProgram("!!ARBvp1.0\nMOV result.position, {2,2,2,1};\nEND\n"); })),
         {}},
        {"ARB fragment program",
         shared(configured<osg::FragmentProgram>([](auto& made) {
             made.setFragmentProgram("!!ARBfp1.0\nTEMP t;\nMOV t, {-1,-1,-1,-1};\nKIL t;\nMOV result.color, t;\nEND\n");
         })),
         {}},
        {"program that draws triangles", program(kVertexShader, paints), {}},
        {"declared program", program(kVertexShader, paints, true), {}},
        {"program that discards",
         program(kVertexShader, "void main() { if (mod(gl_FragCoord.x, 16.0) < 12.0) discard; paintFragment(); }\n"),
         {}},
        // outwards: what is out of view stays there, as any test of bounds takes for granted
        {"program that moves vertices",
         program("void main() { gl_Position = ftransform(); gl_Position.xy *= 1.7; }\n", paints),
         {}},
        {"program that draws in front",
         program(kVertexShader, "void main() { paintFragment(); gl_FragDepth = 1e-4; }\n"),
         {}},
        {"program with a geometry shader", geometryProgram(), {}},
        {"shader component",
         configured<osg::ShaderAttribute>([](auto& part) {
             part.setType(osg::StateAttribute::VERTEXPROGRAM);
             part.addShader(
                 new osg::Shader(osg::Shader::VERTEX, "void moved(inout vec4 place) { place.xy += 2.0; }\n"));
         }),
         {}},
        {"depth ALWAYS", made<osg::Depth>(osg::Depth::ALWAYS), {}},
        {"depth GREATER", made<osg::Depth>(osg::Depth::GREATER), {}},
        {"depth NEVER", made<osg::Depth>(osg::Depth::NEVER), {}},
        {"depth LEQUAL", made<osg::Depth>(osg::Depth::LEQUAL), {}},
        {"depth not written", made<osg::Depth>(osg::Depth::LESS, 0.0, 1.0, false), {}},
        {"depth range in front", made<osg::Depth>(osg::Depth::LESS, 0.0, 0.01), {}},
        {"depth range behind", made<osg::Depth>(osg::Depth::LESS, 0.99, 1.0), {}},
        {"indexed depth range", made<osg::DepthRangeIndexed>(0u, 0.99, 1.0), {}},
        {"depth test", nullptr, {GL_DEPTH_TEST}},
        {"depth clamp", nullptr, {kDepthClamp}},
        {"cull face BACK", made<osg::CullFace>(osg::CullFace::BACK), {}},
        {"cull face FRONT", made<osg::CullFace>(osg::CullFace::FRONT), {}},
        {"cull face FRONT without its mode", made<osg::CullFace>(osg::CullFace::FRONT), {}, false},
        {"cull face FRONT AND BACK", made<osg::CullFace>(osg::CullFace::FRONT_AND_BACK), {}},
        {"cull face mode alone", nullptr, {GL_CULL_FACE}},
        {"front face CLOCKWISE", made<osg::FrontFace>(osg::FrontFace::CLOCKWISE), {}},
        {"front face COUNTER CLOCKWISE", made<osg::FrontFace>(osg::FrontFace::COUNTER_CLOCKWISE), {}},
        {"no colours", made<osg::ColorMask>(false, false, false, true), {}},
        {"all colours", made<osg::ColorMask>(true, true, true, true), {}},
        {"no alpha", made<osg::ColorMask>(true, true, true, false), {}},
        {"stencil EQUAL", configured<osg::Stencil>([](auto& s) { s.setFunction(osg::Stencil::EQUAL, 1, ~0u); }), {}},
        // it draws nothing, and marks where it would
        {"stencil that writes",
         configured<osg::Stencil>([](auto& stencil) {
             stencil.setFunction(osg::Stencil::NEVER, 1, ~0u);
             stencil.setOperation(osg::Stencil::REPLACE, osg::Stencil::REPLACE, osg::Stencil::REPLACE);
         }),
         {}},
        {"two-sided stencil",
         configured<osg::StencilTwoSided>([](auto& stencil) {
             stencil.setFunction(osg::StencilTwoSided::FRONT, osg::StencilTwoSided::NEVER, 0, ~0u);
         }),
         {}},
        {"stencil mode alone", nullptr, {GL_STENCIL_TEST}},
        {"alpha NEVER", made<osg::AlphaFunc>(osg::AlphaFunc::NEVER, 0.5f), {}},
        {"alpha GREATER", made<osg::AlphaFunc>(osg::AlphaFunc::GREATER, 0.5f), {}},
        {"blend", made<osg::BlendFunc>(GLenum{GL_ONE}, GLenum{GL_ONE}), {}},
        {"blend equation", made<osg::BlendEquation>(osg::BlendEquation::RGBA_MIN), {GL_BLEND}},
        {"blend color", made<osg::BlendColor>(osg::Vec4(1, 1, 1, 1)), {}},
        {"blend mode alone", nullptr, {GL_BLEND}},
        {"polygon mode LINE", made<osg::PolygonMode>(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::LINE), {}},
        {"polygon mode FILL", made<osg::PolygonMode>(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::FILL), {}},
        {"polygon offset", made<osg::PolygonOffset>(-1.0f, -1.0f), {}},
        {"polygon stipple", makeStipple, {}},
        {"clip plane", made<osg::ClipPlane>(0u, osg::Vec4d(1.0, 0.0, 0.0, 0.0)), {}},
        {"clip plane mode alone", nullptr, {kClipDistance}},
        {"sample mask", configured<osg::SampleMaski>([](auto& mask) { mask.setMask(0u); }), {}},
        {"multisample", configured<osg::Multisample>([](auto& m) { m.setSampleCoverage(0.5f, true); }), {}},
        {"alpha to coverage", nullptr, {GL_SAMPLE_ALPHA_TO_COVERAGE_ARB}},
        {"primitive restart", made<osg::PrimitiveRestartIndex>(4u), {kRestart}},
        {"clip control", made<osg::ClipControl>(osg::ClipControl::UPPER_LEFT), {}},
        {"attribute divisor", made<osg::VertexAttribDivisor>(0u, 1u), {}},
        // harmless
        {"material", made<osg::Material>(), {}},
        {"texture", makeTexture, {}, true, 0, true},
        {"texture of unit 1", makeTexture, {}, true, 1, true},
        {"texture environment", made<osg::TexEnv>(osg::TexEnv::MODULATE), {}, true, 0, true},
        {"combining texture environment", made<osg::TexEnvCombine>(), {}, true, 0, true},
        {"texture filter", made<osg::TexEnvFilter>(0.0f), {}, true, 0, true},
        {"texture coordinates", made<osg::TexGen>(), {}, true, 0, true},
        {"texture matrix", made<osg::TexMat>(), {}, true, 0, true},
        {"sampler", made<osg::Sampler>(), {}, true, 0, true},
        {"fog", made<osg::Fog>(), {}},
        {"light", made<osg::Light>(1u), {}},
        {"light model", made<osg::LightModel>(), {}},
        {"lighting", nullptr, {GL_LIGHTING}},
        {"normalize", nullptr, {GL_NORMALIZE}},
        {"hint", made<osg::Hint>(GLenum{GL_FOG_HINT}, GLenum{GL_NICEST}), {}},
        {"shade model", made<osg::ShadeModel>(osg::ShadeModel::FLAT), {}},
        {"line width", made<osg::LineWidth>(1.0f), {}},
        {"line stipple", made<osg::LineStipple>(1, static_cast<GLushort>(0xFFFF)), {}},
        {"point", made<osg::Point>(1.0f), {}},
        {"point sprite", made<osg::PointSprite>(), {}, true, 0, true},
        {"clamp color", made<osg::ClampColor>(), {}}};
    return all;
}

const std::vector<NamedState>& states() {
    static const std::vector<NamedState> all = makeStates();
    return all;
}

const std::set<osg::StateAttribute::Type>& harmlessTypes() {
    using A = osg::StateAttribute;
    static const std::set<A::Type> types{A::TEXTURE,     A::MATERIAL,     A::FOG,       A::LIGHT,      A::SHADEMODEL,
                                         A::TEXENV,      A::TEXGEN,       A::TEXMAT,    A::LIGHTMODEL, A::HINT,
                                         A::SAMPLER,     A::CLAMPCOLOR,   A::LINEWIDTH, A::POINT,      A::TEXENVFILTER,
                                         A::POLYGONMODE, A::POLYGONOFFSET};
    return types;
}

}  // namespace

int stateCount() {
    return static_cast<int>(states().size());
}

std::string stateName(int number) {
    return states()[static_cast<std::size_t>(number)].name;
}

int stateOf(const std::string& name) {
    for (int i = 0; i < stateCount(); ++i)
        if (stateName(i) == name) return i;
    throw std::logic_error("no state " + name);
}

void setState(int number, Value value, osg::StateSet& set) {
    const NamedState& state = states()[static_cast<std::size_t>(number)];
    if (state.attribute) {
        const osg::ref_ptr<osg::StateAttribute> attribute = state.attribute();
        if (state.isTexture && state.hasModes)
            set.setTextureAttributeAndModes(state.unit, attribute, value);
        else if (state.hasModes)
            set.setAttributeAndModes(attribute, value);
        else
            set.setAttribute(attribute, value);
    }
    for (const GLenum mode : state.modes) set.setMode(mode, value);
}

bool isHarmless(const osg::StateSet& set) {
    const auto isKnown = [](const auto& entry) { return harmlessTypes().count(entry.first.first) > 0; };
    const auto& attributes = set.getAttributeList();
    if (!std::all_of(attributes.begin(), attributes.end(), isKnown)) return false;
    const auto isPlain = [](const auto& entry) {
        switch (entry.first) {
            case GL_DEPTH_TEST:
                return (entry.second & osg::StateAttribute::ON) != 0;
            case GL_LIGHTING:
            case GL_NORMALIZE:
            case GL_FOG:
            case GL_LIGHT1:
            case GL_DITHER:
                return true;
            default:
                return (entry.second & osg::StateAttribute::ON) == 0;
        }
    };
    const auto& modes = set.getModeList();
    return std::all_of(modes.begin(), modes.end(), isPlain);
}

}  // namespace osgAnalyticBin::test
