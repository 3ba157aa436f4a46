// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "OptionString.h"
#include "Photogrammetry.h"

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/NameParameters.h>

#include <osg/Notify>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <fstream>
#include <optional>
#include <string>

namespace {

constexpr const char* kExtension = "analyticbin";
constexpr const char* kIndexExtension = "bins";

// The database under its own name stays as it is in OSG's object cache: without bins. With them it is kept there by OSG
// under the name that ends in .analyticbin.
osg::ref_ptr<osgDB::Options> withoutNodeCache(const osgDB::Options* options) {
    osg::ref_ptr<osgDB::Options> uncached = options ? options->cloneOptions() : nullptr;
    if (uncached) {
        uncached->setObjectCacheHint(static_cast<osgDB::Options::CacheHintOptions>(options->getObjectCacheHint() &
                                                                                   ~osgDB::Options::CACHE_NODES));
    }
    return uncached;
}

}  // namespace

/// The pseudo-loader `database.analyticbin`: reads the database and installs analytic bins on it and on every tile that
/// is paged in later. Parameters: `database.(method=NAME,edges=off).analyticbin`, or the plugin option string; the
/// file name wins. Reads indexes of bins too, "database.bins".
class ReaderWriterAnalyticBin : public osgDB::ReaderWriter {
public:
    ReaderWriterAnalyticBin() {
        supportsExtension(kExtension, "Culls the tiles of a terrain database by their analytic bins (pseudo-loader)");
        supportsExtension(kIndexExtension, "The bins of a whole terrain database, made by osgbinconv --index");
        supportsOption("method=quadratic|exact|sphere|none",
                       "How tiles are culled: by bins, quadratic (default) or exact; sphere leaves OSG's culling "
                       "alone; none culls nothing.");
        supportsOption("horizon=METRES|declared|off",
                       "Culls tiles behind the horizon of the lowest surface shown. METRES: altitude below which "
                       "nothing is drawn; declared: the altitude that the database declares; default "
                       "declared.");
        supportsOption("inheritviewpoint=on|off",
                       "The horizon also for cameras that inherit a view point (shadow passes); default off.");
        supportsOption("edges=on|off", "Tests tiles across an edge of the frustum against the edge too; default on.");
        supportsOption("occlusion=on|off|auto",
                       "Culls tiles behind terrain, where the near plane is fixed; auto: while that hides a quarter of "
                       "the tiles in view; default auto.");
        supportsOption(
            "expiry=SECONDS",
            "Time for which finer tiles out of view are kept when the DatabasePager has more than its target; "
            "default 3, 0 leaves OSG's own rule alone.");
        supportsOption("heights=LOW..HIGH",
                       "Range of altitudes in metres of all terrain in the database, for tiles that are in no index; "
                       "default -11500..9000.");
        supportsOption(
            "techniquemargin=METRES",
            "Declares that osgTerrain tiles with another technique, or moved by shaders, stay within this distance "
            "of the mesh that GeometryTechnique makes; default: other techniques are not culled.");
        supportsOption("shaders=declared|plain",
                       "plain: declares that all shaders draw all of each triangle where its vertices are; otherwise "
                       "terrain under a shader hides nothing unless the application declares its program; default "
                       "declared.");
        supportsOption("index=auto|on|off",
                       "Whether an index beside the database (DATABASE.bins) is used; auto (default): made in the "
                       "background where there is none.");
        supportsOption("skirts=cracks|all",
                       "What bins hold of skirts: what an eye above the terrain can see (default), or all, for cameras "
                       "below it.");
        supportsOption("globe=wgs84|EQUATORIAL/POLAR",
                       "The globe, by its radii in metres, where no CoordinateSystemNode stands above the tiles.");
        supportsOption("ground=NAME",
                       "The name of the nodes that are the tiles' ground; all else keeps OSG's own culling.");
        supportsOption("cluster=replace|keep",
                       "Whether the database's ClusterCullingCallbacks cull nothing (default) or are left in charge.");
    }

    const char* className() const override { return "analytic bin pseudo-loader"; }

    ReadResult readObject(const std::string& fileName, const osgDB::Options* options) const override {
        if (!isIndex(fileName)) return readNode(fileName, options);
        const std::string path = osgDB::findDataFile(fileName, options);
        if (path.empty()) return ReadResult::FILE_NOT_FOUND;
        std::ifstream in(path, std::ios::binary);
        return in ? readObject(in, options) : ReadResult(ReadResult::ERROR_IN_READING_FILE);
    }

    /// An index of bins, from an archive, a server, or anywhere else.
    ReadResult readObject(std::istream& in, const osgDB::Options*) const override {
        std::string error;
        const osg::ref_ptr<osgAnalyticBin::BinIndex> index = osgAnalyticBin::BinIndex::read(in, error);
        return index ? ReadResult(index.get()) : ReadResult(error);
    }

    WriteResult writeObject(const osg::Object& object, const std::string& fileName,
                            const osgDB::Options*) const override {
        const auto* index = isIndex(fileName) ? dynamic_cast<const osgAnalyticBin::BinIndex*>(&object) : nullptr;
        if (!index) return WriteResult::FILE_NOT_HANDLED;
        std::string error;
        return index->write(fileName, error) ? WriteResult(WriteResult::FILE_SAVED) : WriteResult(error);
    }

    /// An index of bins, into an archive.
    WriteResult writeObject(const osg::Object& object, std::ostream& out, const osgDB::Options*) const override {
        const auto* index = dynamic_cast<const osgAnalyticBin::BinIndex*>(&object);
        if (!index) return WriteResult::FILE_NOT_HANDLED;
        return index->write(out) ? WriteResult::FILE_SAVED : WriteResult::ERROR_IN_WRITING_FILE;
    }

    ReadResult readNode(const std::string& fileName, const osgDB::Options* options) const override {
        if (osgDB::getLowerCaseFileExtension(fileName) != kExtension) return ReadResult::FILE_NOT_HANDLED;
        const auto request = osgAnalyticBin::nameParametersFrom(osgDB::getNameLessExtension(fileName));
        if (request.name.empty()) return ReadResult::FILE_NOT_HANDLED;

        std::string error;
        const auto shared = osgAnalyticBin::plugin::parsedOptionString(options ? options->getOptionString() : "");
        // OSG prints the message of a failed read; a second line would say no more.
        if (!shared.nearMisses.empty()) return ReadResult("analyticbin: " + complaint(shared));
        const std::string text = shared.items + request.parameters;
        const std::optional<osgAnalyticBin::CullOptions> cullOptions = osgAnalyticBin::cullOptionsFromText(text, error);
        if (!cullOptions) return ReadResult("analyticbin: " + error);
        const osg::ref_ptr<osgDB::Options> uncached = withoutNodeCache(options);
        ReadResult result = readDatabase(request.name, uncached.get());
        const osg::ref_ptr<osg::Node> node = result.getNode();
        if (!node) return result;
        const std::size_t installed = osgAnalyticBin::installBins(*node, *cullOptions, request.name, options);
        report(installed, *cullOptions, request.name, osgAnalyticBin::isIndexAwaited(*node));
        // the plugins that the database needs are loaded by now, and their options are known
        if (options) reportUnknown(osgAnalyticBin::plugin::parsedOptionString(options->getOptionString()));
        return node.get();
    }

private:
    // OSG reports the last reader's error alone, which is that of its http client.
    static ReadResult refusedFromServer(const std::string& name) {
        OSG_WARN << "analyticbin: \"" << name
                 << "\": photogrammetry sets are read from a disk, not from a server; mount or copy the folder."
                 << std::endl;
        return ReadResult::FILE_NOT_HANDLED;
    }

    // A photogrammetry set is a folder, which no other plugin reads.
    static ReadResult readDatabase(const std::string& name, const osgDB::Options* options) {
        using namespace osgAnalyticBin::plugin;
        if (osgDB::getLowerCaseFileExtension(name) == "xml") {
            if (osgDB::containsServerAddress(name)) return refusedFromServer(name);
            const std::string path = osgDB::findDataFile(name, options);
            if (!path.empty() && isPhotogrammetryMetadata(path)) return readPhotogrammetrySet(path, options);
        }
        return osgDB::Registry::instance()->readNode(name, options);
    }

    static bool isIndex(const std::string& fileName) {
        return osgDB::getLowerCaseFileExtension(fileName) == kIndexExtension;
    }

    static std::string complaint(const osgAnalyticBin::plugin::OptionString& shared) {
        const auto& [item, meant] = shared.nearMisses.front();
        const bool isKey = item == meant;
        return "the option string has \"" + item + "\"; " +
               (isKey ? "give it a value, as in " : "if it is for the bins, write ") + meant + "=...";
    }

    static void reportUnknown(const osgAnalyticBin::plugin::OptionString& shared) {
        for (const std::string& item : shared.unknown) {
            OSG_WARN << "analyticbin: \"" << item
                     << "\" in the option string is known neither to osgAnalyticBin nor to another plugin that is "
                        "loaded."
                     << std::endl;
        }
    }

    static void report(std::size_t installed, const osgAnalyticBin::CullOptions& options, const std::string& name,
                       bool isIndexAwaited) {
        using osgAnalyticBin::Method;
        const bool wantsBins = options.method != Method::Sphere && options.method != Method::None;
        if (wantsBins && installed > 0) {
            OSG_NOTICE << "analyticbin: \"" << name << "\" has bins on " << installed
                       << " tiles, and on those that are loaded later (" << osgAnalyticBin::toText(options) << ")."
                       << (isIndexAwaited ? " Their index is being made." : "") << std::endl;
        }
    }
};

REGISTER_OSGPLUGIN(analyticbin, ReaderWriterAnalyticBin)
