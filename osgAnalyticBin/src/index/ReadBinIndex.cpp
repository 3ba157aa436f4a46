// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/BinIndex.h>

#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <filesystem>
#include <system_error>

namespace osgAnalyticBin {

namespace {

constexpr const char* kExtension = "bins";

// OSG finds our plugin by the extension, for archives and servers too.
const bool kIsAliasKnown = [] {
    osgDB::Registry::instance()->addFileExtensionAlias(kExtension, "analyticbin");
    return true;
}();

std::string withoutFolder(const std::string& path) {
    return osgDB::getSimpleFileName(path);
}

// Without the plugin, which need not be installed for this.
osg::ref_ptr<BinIndex> readLocal(const std::string& path, std::string& error) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored) ? BinIndex::read(path, error) : nullptr;
}

osg::ref_ptr<BinIndex> readByOsg(const std::string& name, const osgDB::Options* options, std::string& error) {
    osgDB::Registry& registry = *osgDB::Registry::instance();
    if (!registry.getReaderWriterForExtension(kExtension)) return nullptr;
    osgDB::ReaderWriter::ReadResult result = registry.readObject(name, options);
    osg::ref_ptr<BinIndex> index = dynamic_cast<BinIndex*>(result.getObject());
    if (!index && result.error()) error = "\"" + name + "\": " + result.message();
    return index;
}

}  // namespace

std::string binIndexName(const std::string& databaseFileName) {
    return databaseFileName + "." + kExtension;
}

osg::ref_ptr<BinIndex> readBinIndex(const std::string& databaseFileName, const osgDB::Options* options,
                                    std::string& error) {
    error.clear();
    (void)kIsAliasKnown;
    const std::string name = binIndexName(databaseFileName);
    const std::string root = osgDB::findDataFile(databaseFileName, options);
    const bool isLocal = !root.empty() && !osgDB::containsServerAddress(root);
    const osg::ref_ptr<BinIndex> index =
        isLocal ? readLocal(binIndexName(root), error) : readByOsg(name, options, error);
    if (!index) return nullptr;
    std::error_code failure;
    const auto size = isLocal ? std::filesystem::file_size(root, failure) : 0;
    const std::uint64_t known = index->source().size;
    if (!isLocal || failure || known == 0 || size == known) return index;
    error = "\"" + name + "\" was made of another \"" + withoutFolder(databaseFileName) + "\" (" +
            std::to_string(index->source().size) + " bytes, now " + std::to_string(size) +
            "); make it again with osgbinconv --index";
    return nullptr;
}

}  // namespace osgAnalyticBin
