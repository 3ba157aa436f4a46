// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Draws with OpenGL what a cull traversal left to draw: each drawable in a flat colour of its own.

#pragma once

#include "Includes.h"

#include <osg/ContextData>
#include <osg/GLObjects>
#include <osg/GraphicsContext>
#include <osg/RenderInfo>
#include <osg/Uniform>
#include <osgViewer/GraphicsWindow>

USE_GRAPHICSWINDOW()

namespace osgAnalyticBin::test {

/// Width and height of the picture, and of those that cameras in the scene draw beside it, in pixels.
constexpr int kPictureSize = 512;
constexpr int kInnerPictureSize = 256;
constexpr int kInnerPictureStart = kPictureSize + 16;  // lines are drawn a pixel beyond the border

/// What is in the pixels, row by row from below. The picture of a camera in the scene is to the right.
struct Painting {
    static constexpr int kWidth = kInnerPictureStart + kInnerPictureSize;
    static constexpr int kHeight = kPictureSize;

    std::vector<std::uint32_t> numbers;  ///< of drawables; see Painter::keyOf()
    std::vector<float> depths;           ///< see Painter::distance()
};

/// For programs that paint as the painter does: a vertex shader, and a function of GLSL, paintFragment().
// As OpenGL's own functions do, clip planes take part.
inline constexpr const char* kVertexShader =
    "void main() {\n"
    "  gl_Position = ftransform();\n"
    "  gl_ClipVertex = gl_ModelViewMatrix * gl_Vertex;\n"
    "}\n";
// gl_FragCoord.w is 1 / w.
inline constexpr const char* kPaintFunction =
    "uniform vec4 paint;\n"
    "void paintFragment() {\n"
    "  gl_FragColor = paint;\n"
    "  bool isPerspective = gl_ProjectionMatrix[3][3] == 0.0;\n"
    "  float depth = isPerspective ? (-log2(gl_FragCoord.w) + 9.965784284662087) / 45.0 : gl_FragCoord.z;\n"
    "  gl_FragDepth = isPerspective ? mix(gl_DepthRange.near, gl_DepthRange.far, depth) : depth;\n"
    "}\n";

/// Has a graphics context, and colours for drawables that are known by a key. Both scenes use the same colours.
class Painter {
public:
    /// The kind of depths in the depth buffer.
    enum class Depths {
        Logarithms,  ///< see distance(); in perspective pictures
        OpenGL       ///< as applications have them, rounded as theirs
    };

    /// Needs a display. Throws: std::runtime_error where no graphics context can be made.
    explicit Painter(Depths depths = Depths::Logarithms) : _context(makeContext()) {
        if (!_context || !_context->realize() || !_context->makeCurrent())
            throw std::runtime_error("no graphics context: pictures need a display, such as xvfb-run gives");
        _context->getState()->initializeExtensionProcs();
        _states->setMode(GL_DEPTH_TEST, osg::StateAttribute::ON);
        _states->setMode(GL_DITHER, osg::StateAttribute::OFF);
        _flat->addShader(new osg::Shader(osg::Shader::VERTEX, kVertexShader));
        const std::string withDepth = std::string(kPaintFunction) + "void main() { paintFragment(); }\n";
        _flat->addShader(
            new osg::Shader(osg::Shader::FRAGMENT, depths == Depths::Logarithms ? withDepth : kPaintShader));
    }
    ~Painter() {
        clear();
        _context->close();
    }
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;

    /// For CullView::states.
    [[nodiscard]] osg::StateSet* states() { return _states; }

    /// The state that paints a drawable in the colour of its key. `hasProgram`: the scene has a shader program there,
    /// which does the painting itself, by kPaintFunction or otherwise.
    [[nodiscard]] const osg::StateSet* paintFor(const std::string& key, bool hasProgram = false) {
        const auto [known, isNew] = _numbers.emplace(key, static_cast<std::uint32_t>(_numbers.size() + 1));
        if (isNew) _keys.push_back(key);
        while (_paints.size() < known->second) {
            const osg::ref_ptr<osg::Uniform> paint =
                new osg::Uniform("paint", colourOf(static_cast<std::uint32_t>(_paints.size() + 1)));
            Paint made{new osg::StateSet, new osg::StateSet};
            made.flat->setAttributeAndModes(_flat);
            made.flat->addUniform(paint);
            made.colour->addUniform(paint);
            _paints.push_back(made);
        }
        const Paint& paint = _paints[known->second - 1];
        return hasProgram ? paint.colour : paint.flat;
    }

    /// Returns: nullptr for the background.
    [[nodiscard]] const std::string* keyOf(std::uint32_t number) const {
        return number > 0 && number <= _keys.size() ? &_keys[number - 1] : nullptr;
    }

    [[nodiscard]] Painting paint(osgUtil::RenderStage& stage, osg::FrameStamp& stamp) {
        osg::State& state = *_context->getState();
        // OSG tells attributes, arrays and buffers apart by addresses, which those of scenes that are gone had, too
        state.reset();
        // what is not the default would be taken for applied
        state.apply();
        state.lazyDisablingOfVertexAttributes();
        state.applyDisablingOfVertexAttributes();
        state.unbindVertexBufferObject();
        state.unbindElementBufferObject();
        state.setFrameStamp(&stamp);
        osg::get<osg::ContextData>(state.getContextID())->newFrame(&stamp);
        state.applyMode(GL_SCISSOR_TEST, false);
        glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
        glClear(GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
        stage.setClearColor(osg::Vec4());
        stage.sort();
        osg::RenderInfo info(&state, nullptr);
        osgUtil::RenderLeaf* previous = nullptr;
        stage.drawPreRenderStages(info, previous);
        stage.draw(info, previous);
        state.popAllStateSets();
        state.apply();

        constexpr std::size_t kPixels = std::size_t{Painting::kWidth} * Painting::kHeight;
        Painting painting{std::vector<std::uint32_t>(kPixels), std::vector<float>(kPixels)};
        std::vector<unsigned char> colours(4 * kPixels);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glReadPixels(0, 0, Painting::kWidth, Painting::kHeight, GL_RGBA, GL_UNSIGNED_BYTE, colours.data());
        glReadPixels(0, 0, Painting::kWidth, Painting::kHeight, GL_DEPTH_COMPONENT, GL_FLOAT, painting.depths.data());
        if (const GLenum error = glGetError(); error != GL_NO_ERROR)
            throw std::runtime_error("OpenGL says " + std::to_string(error));
        for (std::size_t i = 0; i < kPixels; ++i) {
            const unsigned char* const c = &colours[4 * i];
            painting.numbers[i] =
                c[0] | static_cast<std::uint32_t>(c[1]) << 8U | static_cast<std::uint32_t>(c[2]) << 16U;
        }
        return painting;
    }

    /// Forgets keys, and deletes what OpenGL held for scenes that are gone.
    void clear() {
        _numbers.clear();
        _keys.clear();
        const unsigned int context = _context->getState()->getContextID();
        osg::flushAllDeletedGLObjects(context);
    }

    /// The clip coordinate w of a logarithmic depth. Depths of OpenGL would not tell the sides of a globe apart when
    /// the near plane is some metres away.
    [[nodiscard]] static double distance(float depth) {
        return kNearest * std::exp2(kOctaves * static_cast<double>(depth));
    }

private:
    // Distances from kNearest up to kNearest times two to the power of kOctaves have depths from 0 to 1.
    static constexpr double kNearest = 1e-3;
    static constexpr double kOctaves = 45.0;

    static constexpr const char* kPaintShader =
        "uniform vec4 paint;\n"
        "void main() { gl_FragColor = paint; }\n";

    static osg::Vec4 colourOf(std::uint32_t number) {
        const auto channel = [number](unsigned int shift) {
            return static_cast<float>((number >> shift) & 0xFFU) / 255.0F;
        };
        return {channel(0), channel(8), channel(16), 1.0F};
    }

    static osg::ref_ptr<osg::GraphicsContext> makeContext() {
        const osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
        traits->readDISPLAY();
        traits->setUndefinedScreenDetailsToDefaultScreen();
        traits->width = Painting::kWidth;
        traits->height = Painting::kHeight;
        traits->red = traits->green = traits->blue = 8;
        traits->depth = 24;
        traits->stencil = 8;
        traits->samples = 0;
        traits->pbuffer = true;
        traits->doubleBuffer = false;
        return osg::GraphicsContext::createGraphicsContext(traits);
    }

    osg::ref_ptr<osg::GraphicsContext> _context;
    const osg::ref_ptr<osg::StateSet> _states = new osg::StateSet;
    const osg::ref_ptr<osg::Program> _flat = new osg::Program;
    struct Paint {
        osg::ref_ptr<osg::StateSet> flat, colour;  // with a program, and without
    };
    std::vector<Paint> _paints;  // from number 1 on; 0 is the background
    std::map<std::string, std::uint32_t> _numbers;
    std::vector<std::string> _keys;
};

}  // namespace osgAnalyticBin::test
