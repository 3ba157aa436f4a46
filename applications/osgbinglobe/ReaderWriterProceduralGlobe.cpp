// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

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
        supportsOption("levels=0..24",
                       "Levels below the 16 x 8 start tiles (default: 12). From some 20 on OSG measures the distances "
                       "at which tiles are refined in steps of half a metre.");
        supportsOption("cells=2..64", "Cells along a tile's edge, an even number (default: 16)");
        supportsOption("relief=0..20000", "Metres from the lowest terrain there may be to the highest (default: 8000)");
        supportsOption("lod=1..100", "Half diagonals of a tile from which on it is refined (default: 4)");
        supportsOption("bins=on|off", "Whether tiles carry analytic bins, as those of osgbindem do (default: on)");
    }

    const char* className() const override { return "procedural globe pseudo-loader"; }

    ReadResult readObject(const std::string& fileName, const Options* options) const override {
        return readNode(fileName, options);
    }

    ReadResult readNode(const std::string& fileName, const Options* options) const override {
        if (!acceptsExtension(osgDB::getLowerCaseFileExtension(fileName))) return ReadResult::FILE_NOT_HANDLED;
        std::string error;
        const auto name =
            osgAnalyticBin::globe::globeNameOf(fileName, options ? options->getOptionString() : std::string(), error);
        if (!name) return ReadResult(error);
        const auto globe = globeOf(name->options);
        const osg::ref_ptr<osg::Node> node = name->tile ? globe->children(*name->tile) : globe->root();
        return node.get();
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
