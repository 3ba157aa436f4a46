// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TilePainter.h"

#include <osg/ClearNode>
#include <osg/MatrixTransform>
#include <osg/Program>

namespace osgAnalyticBin::bench {

namespace {

constexpr const char* kVertexShader = "void main() { gl_Position = ftransform(); }\n";
constexpr const char* kFragmentShader = "uniform vec4 tileColour;\nvoid main() { gl_FragColor = tileColour; }\n";
constexpr unsigned int kOverride = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;

// Numbers from 1 on as colours of 8 bits a channel; 0 is the background.
osg::Vec4 colourOf(std::uint32_t number) {
    const auto channel = [number](unsigned int shift) {
        return static_cast<float>((number >> shift) & 0xFFU) / 255.0F;
    };
    return {channel(0), channel(8), channel(16), 1.0F};
}

std::uint32_t numberOf(const unsigned char* colour) {
    return colour[0] | static_cast<std::uint32_t>(colour[1]) << 8U | static_cast<std::uint32_t>(colour[2]) << 16U;
}

osg::ref_ptr<osg::Group> paintedScene(const std::vector<flight::DrawnTile>& tiles) {
    // A node of its own, because the viewer's background is blue.
    osg::ref_ptr<osg::ClearNode> scene = new osg::ClearNode;
    scene->setClearColor(osg::Vec4(0.0F, 0.0F, 0.0F, 0.0F));
    const osg::ref_ptr<osg::Program> flat = new osg::Program;
    flat->addShader(new osg::Shader(osg::Shader::VERTEX, kVertexShader));
    flat->addShader(new osg::Shader(osg::Shader::FRAGMENT, kFragmentShader));
    scene->getOrCreateStateSet()->setAttributeAndModes(flat, kOverride);
    scene->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    std::uint32_t number = 0;
    for (const flight::DrawnTile& tile : tiles) {
        const osg::ref_ptr<osg::Uniform> colour = new osg::Uniform("tileColour", colourOf(++number));
        for (const flight::DrawnMesh& mesh : tile.meshes) {
            const osg::ref_ptr<osg::MatrixTransform> placed = new osg::MatrixTransform(mesh.localToWorld);
            placed->addChild(mesh.drawable);
            placed->getOrCreateStateSet()->addUniform(colour, kOverride);
            scene->addChild(placed);
        }
    }
    return scene;
}

}  // namespace

std::map<std::string, std::uint64_t> visiblePixels(BenchViewer& viewer, const std::vector<flight::DrawnTile>& tiles,
                                                   const osg::Camera& view) {
    const osg::ref_ptr<osg::Image> picture =
        viewer.pictureOf(*paintedScene(tiles), view, osg::CullSettings::NO_CULLING);
    std::map<std::string, std::uint64_t> pixels;
    for (int row = 0; row < picture->t(); ++row) {
        for (int column = 0; column < picture->s(); ++column) {
            const std::uint32_t number =
                numberOf(picture->data(static_cast<unsigned int>(column), static_cast<unsigned int>(row)));
            if (number > 0 && number <= tiles.size()) ++pixels[tiles[number - 1].key];
        }
    }
    return pixels;
}

}  // namespace osgAnalyticBin::bench
