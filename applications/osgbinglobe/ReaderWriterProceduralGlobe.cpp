// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CommandLine.h"
#include "Failure.h"
#include "GlobeOptions.h"
#include "ProceduralGlobe.h"

#include <osgDB/FileNameUtils>
#include <osgDB/ReaderWriter>
#include <osgDB/Registry>

/// The pseudo-loader `12.proceduralglobe`: a paged globe of any depth without any files. Tiles are made when the
/// DatabasePager asks for them, by names that end in .proceduralglobe too.
class ReaderWriterProceduralGlobe : public osgDB::ReaderWriter {
public:
    ReaderWriterProceduralGlobe() {
        supportsExtension(osgAnalyticBin::globe::kGlobeExtension,
                          "Paged globe of terrain made by a formula (pseudo-loader): 12.proceduralglobe or "
                          "(levels=12,cells=16).proceduralglobe");
        CLI::App app;
        osgAnalyticBin::globe::GlobeOptions options;
        options.declare(app);
        for (const CLI::Option* option : app.get_options())
            supportsOption(osgAnalyticBin::support::parameterText(*option), option->get_description());
    }

    const char* className() const override { return "procedural globe pseudo-loader"; }

    ReadResult readObject(const std::string& fileName, const Options* options) const override {
        return readNode(fileName, options);
    }

    ReadResult readNode(const std::string& fileName, const Options*) const override {
        if (!acceptsExtension(osgDB::getLowerCaseFileExtension(fileName))) return ReadResult::FILE_NOT_HANDLED;
        try {
            const auto name = osgAnalyticBin::globe::globeNameOf(fileName);
            const osgAnalyticBin::globe::ProceduralGlobe globe(name.options);
            const osg::ref_ptr<osg::Node> node = name.tile ? globe.children(*name.tile) : globe.root();
            return node.get();
        } catch (const osgAnalyticBin::support::Failure& failure) {
            return ReadResult(failure.what());
        }
    }
};

REGISTER_OSGPLUGIN(proceduralglobe, ReaderWriterProceduralGlobe)
