// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CameraFlight.h"
#include "CameraPath.h"
#include "Failure.h"
#include "FlightOptions.h"

#include <osgAnalyticBin/NameParameters.h>

#include <osg/Group>
#include <osg/LightSource>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/ReaderWriter>
#include <osgDB/Registry>

namespace {

using osgAnalyticBin::flight::CameraFlight;
using osgAnalyticBin::flight::CameraPose;
using osgAnalyticBin::flight::FlightOptions;

}  // namespace

/// Reads "path.csv.(out=DIR,frames=15,timeout=120).binflight": a camera path, as a node that draws nothing, flies the
/// viewer's camera, and lights the scene.
class ReaderWriterBinFlight : public osgDB::ReaderWriter {
public:
    ReaderWriterBinFlight() {
        supportsExtension("binflight",
                          "Camera path: path.csv.(out=DIR,frames=15,timeout=120).binflight flies the viewer along "
                          "path.csv, and leaves pictures and poses.csv in DIR");
        for (const auto& parameter : FlightOptions().parameters()) supportsOption(parameter.text, parameter.meaning);
    }

    const char* className() const override { return "Camera path of osgAnalyticBin"; }

    ReadResult readObject(const std::string& fileName, const Options* options) const override {
        return readNode(fileName, options);
    }

    ReadResult readNode(const std::string& fileName, const Options* options) const override {
        if (!acceptsExtension(osgDB::getLowerCaseFileExtension(fileName))) return ReadResult::FILE_NOT_HANDLED;
        const auto name = osgAnalyticBin::nameParametersFrom(osgDB::getNameLessExtension(fileName));
        const std::string pathFile = osgDB::findDataFile(name.name, options);
        if (pathFile.empty()) return ReadResult(name.name + ": no such camera path");

        FlightOptions flightOptions;
        const auto parameters = flightOptions.parameters();
        try {
            if (options) osgAnalyticBin::flight::readOptionString(parameters, options->getOptionString());
            osgAnalyticBin::flight::readBracketed(parameters, name.parameters);
            return ReadResult(nodeOf(osgAnalyticBin::flight::readCameraPathFiles({pathFile}), flightOptions).get());
        } catch (const osgAnalyticBin::support::Failure& failure) {
            return ReadResult(failure.what());
        }
    }

private:
    // The viewer's own light, which shines along the line of sight, leaves a landscape seen at a low angle dark. This
    // one takes its place and shines from the upper left behind the camera, wherever that looks. It has no position,
    // and so does not widen the scene's bounds.
    static osg::ref_ptr<osg::Node> light() {
        const osg::ref_ptr<osg::Light> light = new osg::Light(0);
        light->setPosition(osg::Vec4(-0.6f, 0.7f, 0.5f, 0.0f));
        light->setAmbient(osg::Vec4(0.15f, 0.15f, 0.15f, 1.0f));
        light->setDiffuse(osg::Vec4(0.9f, 0.9f, 0.9f, 1.0f));
        light->setSpecular(osg::Vec4(0.0f, 0.0f, 0.0f, 1.0f));
        osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
        source->setReferenceFrame(osg::LightSource::ABSOLUTE_RF);
        source->setLight(light);
        return source;
    }

    // A named group with a callback, declared dynamic: osgUtil::Optimizer leaves it alone.
    static osg::ref_ptr<osg::Node> nodeOf(std::vector<CameraPose> path, const FlightOptions& options) {
        osg::ref_ptr<osg::Group> node = new osg::Group;
        node->setName("camera flight");
        node->setDataVariance(osg::Object::DYNAMIC);
        node->addChild(light());
        node->setEventCallback(new CameraFlight(std::move(path), options));
        return node;
    }
};

REGISTER_OSGPLUGIN(binflight, ReaderWriterBinFlight)
