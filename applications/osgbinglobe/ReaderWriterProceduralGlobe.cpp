// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Failure.h"
#include "GlobeOptions.h"
#include "ProceduralGlobe.h"

#include <osgDB/FileNameUtils>
#include <osgDB/ReaderWriter>
#include <osgDB/Registry>

#include <memory>
#include <mutex>

/// The pseudo-loader `12.proceduralglobe`: a paged globe of any depth without any files. Tiles are made when the
/// DatabasePager asks for them, by names that end in .proceduralglobe too.
class ReaderWriterProceduralGlobe : public osgDB::ReaderWriter {
public:
    ReaderWriterProceduralGlobe() {
        supportsExtension(osgAnalyticBin::globe::kGlobeExtension,
                          "Paged globe of terrain made by a formula (pseudo-loader): 12.proceduralglobe or "
                          "(levels=12,cells=16).proceduralglobe");
        for (const auto& parameter : osgAnalyticBin::globe::GlobeOptions().parameters())
            supportsOption(parameter.text, parameter.meaning);
    }

    const char* className() const override { return "procedural globe pseudo-loader"; }

    ReadResult readObject(const std::string& fileName, const Options* options) const override {
        return readNode(fileName, options);
    }

    ReadResult readNode(const std::string& fileName, const Options*) const override {
        if (!acceptsExtension(osgDB::getLowerCaseFileExtension(fileName))) return ReadResult::FILE_NOT_HANDLED;
        try {
            const auto name = osgAnalyticBin::globe::globeNameOf(fileName);
            const auto globe = globeOf(name.options);
            const osg::ref_ptr<osg::Node> node = name.tile ? globe->children(*name.tile) : globe->root();
            return node.get();
        } catch (const osgAnalyticBin::support::Failure& failure) {
            return ReadResult(failure.what());
        }
    }

private:
    using Globe = osgAnalyticBin::globe::ProceduralGlobe;

    // Nearly always that of the file before.
    std::shared_ptr<const Globe> globeOf(const osgAnalyticBin::globe::GlobeOptions& options) const {
        const std::lock_guard<std::mutex> lock(_mutex);
        if (!_globe || !(options == _options)) _globe = std::make_shared<const Globe>(options);
        _options = options;
        return _globe;
    }

    mutable std::mutex _mutex;
    mutable osgAnalyticBin::globe::GlobeOptions _options;
    mutable std::shared_ptr<const Globe> _globe;
};

REGISTER_OSGPLUGIN(proceduralglobe, ReaderWriterProceduralGlobe)
