// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileGeometry.h"

#include "Hypsometry.h"
#include "TextureBlocks.h"

#include <osgAnalyticBin/PackedTerrain.h>

#include <osg/Texture2D>

#include <string>

namespace osgbindem {

namespace {

void drape(osg::Geometry& geometry, osg::Image& image) {
    const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(&image);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    geometry.getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
}

}  // namespace

void colour(osgAnalyticBin::TerrainGrid& grid, int textureSize) {
    grid.textureSize = textureSize;
    if (textureSize > 0) return;
    grid.colours = hypsometricStops();
    grid.relief = true;
}

osg::ref_ptr<const osg::Vec4ubArray> reliefColours(osgAnalyticBin::TerrainGrid grid) {
    colour(grid, 0);
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osgAnalyticBin::fillGeometry(grid, *geometry);
    return dynamic_cast<const osg::Vec4ubArray*>(geometry->getColorArray());
}

osg::ref_ptr<osg::Geometry> makeGeometry(const osgAnalyticBin::TerrainGrid& grid, osg::Image* image, bool isPacked) {
    osg::ref_ptr<osg::Geometry> geometry;
    if (isPacked) {
        geometry = new osgAnalyticBin::PackedTerrain(grid);
    } else {
        geometry = new osg::Geometry;
        osgAnalyticBin::fillGeometry(grid, *geometry);
    }
    if (image != nullptr) {
        const osg::ref_ptr<osg::Image> stored = isPacked ? inBlocks(*image) : osg::ref_ptr<osg::Image>(image);
        drape(*geometry, *stored);
    }
    return geometry;
}

}  // namespace osgbindem
