// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "InstallRivals.h"
#include "RivalOptions.h"

#include <osgAnalyticBin/NameParameters.h>

#include <osg/Notify>
#include <osgDB/FileNameUtils>
#include <osgDB/Options>
#include <osgDB/ReaderWriter>
#include <osgDB/Registry>

/// Reads "earth.osgb.(method=paper).binrival": a terrain database that is culled by a rule of others, to be compared
/// with the same database under analyticbin, which finds the tiles and their bins here too.
class ReaderWriterBinRival : public osgDB::ReaderWriter {
public:
    ReaderWriterBinRival() {
        supportsExtension("binrival",
                          "Culls the tiles of a terrain database by a rule for comparison with analyticbin: "
                          "earth.osgb.(method=paper).binrival");
        supportsOption("method=paper|corners|box|orientedbox",
                       "The rule: paper (default), published, and corners cull visible tiles; box and orientedbox "
                       "are sound");
        supportsOption("horizon=METRES|declared|off", "As of analyticbin; default off");
        supportsOption("edges=on|off", "As of analyticbin; boxes are tested by their faces; default off");
    }

    const char* className() const override { return "Rules for comparison with analytic bins"; }

    ReadResult readObject(const std::string& fileName, const Options* options) const override {
        return readNode(fileName, options);
    }

    ReadResult readNode(const std::string& fileName, const Options* options) const override {
        if (!acceptsExtension(osgDB::getLowerCaseFileExtension(fileName))) return ReadResult::FILE_NOT_HANDLED;
        const auto request = osgAnalyticBin::nameParametersFrom(osgDB::getNameLessExtension(fileName));
        std::string error;
        const auto rule = osgAnalyticBin::rivals::rivalOptionsFromText(request.parameters, error);
        if (!rule) return ReadResult("binrival: " + error);
        // the database with bins alone is another node
        const osg::ref_ptr<Options> uncached = options ? options->cloneOptions() : new Options;
        uncached->setObjectCacheHint(Options::CACHE_NONE);
        ReadResult result = osgDB::Registry::instance()->readNode(
            request.name + ".(" + rule->binOptions + ").analyticbin", uncached.get());
        const osg::ref_ptr<osg::Node> node = result.getNode();
        if (!node) return result;
        const std::size_t installed = osgAnalyticBin::rivals::installRivals(*node, *rule);
        OSG_NOTICE
            << "binrival: " << installed << " tiles of \"" << request.name
            << "\", and those that are loaded later, are culled by a rule for comparison in place of their bins ("
            << (request.parameters.empty() ? "method=paper" : request.parameters) << ")." << std::endl;
        return result;
    }
};

REGISTER_OSGPLUGIN(binrival, ReaderWriterBinRival)
