// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Draws with OpenGL what a cull traversal left to draw: each drawable in a flat colour of its own.

#pragma once

#include "Includes.h"

#include <osg/GraphicsContext>
#include <osgUtil/RenderStage>

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
extern const char* const kVertexShader;
extern const char* const kPaintFunction;

/// Has a graphics context, and colours for drawables that are known by a key. Both scenes use the same colours.
class Painter {
public:
    /// The kind of depths in the depth buffer.
    enum class Depths {
        Logarithms,  ///< see distance(); in perspective pictures
        OpenGL       ///< as applications have them, rounded as theirs
    };

    /// Needs a display. Throws: std::runtime_error where no graphics context can be made.
    explicit Painter(Depths depths = Depths::Logarithms);
    ~Painter();
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;

    /// For CullView::states.
    [[nodiscard]] osg::StateSet* states() { return _states; }

    /// The state that paints a drawable in the colour of its key. `hasProgram`: the scene has a shader program there,
    /// which does the painting itself, by kPaintFunction or otherwise.
    [[nodiscard]] const osg::StateSet* paintFor(const std::string& key, bool hasProgram = false);

    /// Returns: nullptr for the background.
    [[nodiscard]] const std::string* keyOf(std::uint32_t number) const;

    [[nodiscard]] Painting paint(osgUtil::RenderStage& stage, osg::FrameStamp& stamp);

    /// Forgets keys, and deletes what OpenGL held for scenes that are gone.
    void clear();

    /// The clip coordinate w of a logarithmic depth. Depths of OpenGL would not tell the sides of a globe apart when
    /// the near plane is some metres away.
    [[nodiscard]] static double distance(float depth);

private:
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
