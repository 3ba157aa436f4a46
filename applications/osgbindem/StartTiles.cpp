// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "StartTiles.h"

#include "NodeFile.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/InstallBinsCallback.h>

#include <ogr_spatialref.h>
#include <osg/CoordinateSystemNode>
#include <osg/LightModel>
#include <osg/Material>

#include <algorithm>
#include <cmath>
#include <string>

namespace osgbindem {

namespace {

std::string wgs84Text() {
    OGRSpatialReference reference;
    reference.importFromEPSG(4326);
    char* text = nullptr;
    reference.exportToWkt(&text);
    const std::string result(text);
    CPLFree(text);
    return result;
}

/// The root node of a database, without tiles.
osg::ref_ptr<osg::CoordinateSystemNode> makeRoot(const Settings& settings) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(
        new osg::EllipsoidModel(settings.ellipsoid.equatorialRadius(), settings.ellipsoid.polarRadius()));
    if (settings.isWgs84) {
        root->setFormat("WKT");
        root->setCoordinateSystem(wgs84Text());
    }
    // Lit, with the vertices' own colours.
    const osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
    root->getOrCreateStateSet()->setAttributeAndModes(material);
    // The colours have their own light and shade; a light that stands with the eye adds little of its own.
    constexpr float kAmbient = 0.7F;
    const osg::ref_ptr<osg::LightModel> light = new osg::LightModel;
    light->setAmbientIntensity(osg::Vec4(kAmbient, kAmbient, kAmbient, 1.0F));
    root->getOrCreateStateSet()->setAttribute(light);
    return root;
}

/// Declares below what nothing is drawn: a globe is whole, so that what lies behind it is hidden. Of a region nothing
/// is declared: where its horizon can be used is found out when it is shown.
void declareHorizon(osg::Group& root, const TileLayout& layout) {
    if (layout.isRegional()) {
        root.setUpdateCallback(new osgAnalyticBin::InstallBinsCallback);
        return;
    }
    double lowest = 0.0;
    for (unsigned int i = 0; i < root.getNumChildren(); ++i) {
        const osgAnalyticBin::AnalyticBin bin = osgAnalyticBin::storedBin(*root.getChild(i));
        lowest = std::min(lowest, bin.bin().altitude().lower - bin.margin());
    }
    osgAnalyticBin::CullOptions options;
    options.horizonUse = osgAnalyticBin::HorizonUse::Given;
    options.horizon = std::floor(lowest);
    root.setUpdateCallback(new osgAnalyticBin::InstallBinsCallback(options));
}

}  // namespace

void StartTiles::build(TileBuilder& builder) {
    for (std::size_t i = _next++; i < _tiles.size(); i = _next++) {
        if (i == 0) _shared = builder.sharedParts();  // which are the same for all builders
        _tiles[i] = builder.build(_layout.startTiles()[i]);
    }
}

std::string StartTiles::rootBytes() const {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = makeRoot(_settings);
    SharedParts shared = *_shared;
    for (const auto& tile : _tiles) {
        root->addChild(tile->node);
        tile->add(shared);
    }
    declareHorizon(*root, _layout);
    return nodeFileBytes(*root, _settings.compress);
}

}  // namespace osgbindem
