// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Photogrammetry.h"

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/NameParameters.h>

#include <osg/Notify>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace {

constexpr const char* kExtension = "analyticbin";
constexpr const char* kIndexExtension = "bins";

// The items of OSG's option string, which is one for all plugins, that are for bins.
std::string ownItems(std::string optionString) {
    std::replace_if(
        optionString.begin(), optionString.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
    const std::vector<osgAnalyticBin::CullOptionItem> known = osgAnalyticBin::cullOptionItems();
    std::istringstream items(optionString);
    std::string own;
    for (std::string item; items >> item;) {
        const std::string key = item.substr(0, item.find('='));
        const bool isOwn =
            std::any_of(known.begin(), known.end(), [&](const auto& option) { return key == option.key; });
        if (isOwn && item != key) own += item + ' ';
    }
    return own;
}

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
        for (const auto& item : osgAnalyticBin::cullOptionItems())
            supportsOption(item.key + '=' + item.values, item.meaning);
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
        const std::string text = ownItems(options ? options->getOptionString() : "") + request.parameters;
        const std::optional<osgAnalyticBin::CullOptions> cullOptions = osgAnalyticBin::cullOptionsFromText(text, error);
        if (!cullOptions) return ReadResult("analyticbin: " + error);
        const osg::ref_ptr<osgDB::Options> uncached = withoutNodeCache(options);
        ReadResult result = readDatabase(request.name, uncached.get());
        const osg::ref_ptr<osg::Node> node = result.getNode();
        if (!node) return result;
        const std::size_t installed = osgAnalyticBin::installBins(*node, *cullOptions, request.name, options);
        report(installed, *cullOptions, request.name, osgAnalyticBin::isIndexAwaited(*node));
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
