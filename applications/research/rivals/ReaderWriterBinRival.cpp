// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Rivals.h"

#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/NameParameters.h>

#include <osg/Notify>
#include <osgDB/FileNameUtils>
#include <osgDB/Options>
#include <osgDB/ReaderWriter>
#include <osgDB/Registry>

#include <map>
#include <optional>
#include <sstream>

namespace {

using osgAnalyticBin::rivals::RivalOptions;
using osgAnalyticBin::rivals::Rule;

const std::map<std::string, Rule> kRules{
    {"paper", Rule::Paper}, {"corners", Rule::Corners}, {"box", Rule::Box}, {"orientedbox", Rule::OrientedBox}};

// Returns: what is wrong; empty: nothing.
std::string applyItem(const std::string& item, RivalOptions& options) {
    const std::size_t equals = item.find('=');
    const std::string key = item.substr(0, equals);
    const std::string value = equals == std::string::npos ? std::string() : item.substr(equals + 1);
    if (key == "method") {
        const auto rule = kRules.find(value);
        if (rule == kRules.end()) return "unknown method \"" + value + "\" (use paper, corners, box or orientedbox)";
        options.rule = rule->second;
    } else if (key == "edges") {
        if (value != "on" && value != "off") return "bad edges \"" + value + "\" (use on or off)";
        options.testsEdges = value == "on";
    } else {
        if (key == "horizon") options.usesHorizon = value != "off";
        options.binOptions += item + ',';
    }
    return {};
}

// Reads "method=paper,horizon=declared,edges=on"; all but method= may be left out. Other items go to the kit. Returns:
// nullopt, with one line in `error`, where an item is malformed.
std::optional<RivalOptions> rivalOptionsFromText(const std::string& text, std::string& error) {
    RivalOptions options;
    std::istringstream items(text);
    for (std::string item; std::getline(items, item, ',');) {
        if (!item.empty()) error = applyItem(item, options);
        if (!error.empty()) return std::nullopt;
    }
    // what the rules do not use costs time
    options.binOptions += options.usesHorizon ? "occlusion=off" : "horizon=off,occlusion=off";
    if (!osgAnalyticBin::cullOptionsFromText(options.binOptions, error)) return std::nullopt;
    return options;
}

}  // namespace

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
        const auto rule = rivalOptionsFromText(request.parameters, error);
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
