// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/TileFile.h>

#include <OpenThreads/ReentrantMutex>
#include <OpenThreads/ScopedLock>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <algorithm>
#include <cstdint>
#include <fstream>

namespace osgAnalyticBin {

namespace {

using ReadResult = osgDB::ReaderWriter::ReadResult;

// The names under which OSG's native reader knows its kinds of files.
const char* nativeFileType(const std::string& extension) {
    if (extension == "osgb") return "Binary";
    if (extension == "osgt") return "Ascii";
    if (extension == "osgx") return "XML";
    return nullptr;
}

std::uint32_t readWord(std::istream& in) {
    std::uint32_t word = 0;
    in.read(reinterpret_cast<char*>(&word), sizeof word);
    return word;
}

std::string readName(std::istream& in) {
    constexpr std::uint32_t kLongestClassName = 256;
    std::string name(std::min(readWord(in), kLongestClassName), '\0');
    in.read(name.data(), static_cast<std::streamsize>(name.size()));
    return name;
}

// Whether a binary file names a compressor. Decompression reads to the end of the file and checks what it finds by
// itself; a stream that throws at the end would stop it for nothing.
bool isCompressed(std::istream& in) {
    constexpr std::uint32_t kCustomDomains = 0x1;
    for (int i = 0; i < 4; ++i) (void)readWord(in);  // two magic words, kind of content, version
    if (readWord(in) & kCustomDomains) {
        for (std::uint32_t n = readWord(in); n > 0; --n) {
            (void)readName(in);
            (void)readWord(in);
        }
    }
    return readName(in) != "0";
}

// A file of the same name beside an archive, or on OSG's data path, is not the one in it.
bool isInArchive(const std::string& fileName) {
    const auto& extensions = osgDB::Registry::instance()->getArchiveExtensions();
    return std::any_of(extensions.begin(), extensions.end(), [&fileName](const std::string& extension) {
        return fileName.find('.' + extension + '/') != std::string::npos ||
               fileName.find('.' + extension + '\\') != std::string::npos;
    });
}

bool isGuarded(const std::string& fileName, const osgDB::Options* options) {
    const bool cached = options && (options->getObjectCacheHint() & osgDB::Options::CACHE_NODES);
    return !cached && !osgDB::containsServerAddress(fileName) && !isInArchive(fileName) &&
           nativeFileType(osgDB::getLowerCaseFileExtension(fileName));
}

// OSG's own reader. Returns: nullptr where an application has a reader of the same files, which may know them by name.
osgDB::ReaderWriter* onlyReaderOf(const std::string& extension) {
    // what OSG keeps for derived classes
    struct OpenRegistry : public osgDB::Registry {
        static OpenThreads::ReentrantMutex& mutexOf(osgDB::Registry& registry) {
            return registry.*(&OpenRegistry::_pluginMutex);
        }
    };
    osgDB::Registry& registry = *osgDB::Registry::instance();
    osgDB::ReaderWriter* const first = registry.getReaderWriterForExtension(extension);
    if (!first || std::string("OpenSceneGraph Native Format Reader/Writer") != first->className()) return nullptr;
    const OpenThreads::ScopedLock<OpenThreads::ReentrantMutex> lock(OpenRegistry::mutexOf(registry));
    const auto& readers = registry.getReaderWriterList();
    const auto count = std::count_if(readers.begin(), readers.end(),
                                     [&](const auto& reader) { return reader->acceptsExtension(extension); });
    return count == 1 ? first : nullptr;
}

ReadResult readGuarded(osgDB::ReaderWriter& reader, const std::string& path, const char* fileType,
                       const osgDB::Options* options) {
    const osg::ref_ptr<osgDB::Options> own = options ? options->cloneOptions() : new osgDB::Options;
    own->getDatabasePathList().push_front(osgDB::getFilePath(path));
    own->setPluginStringData("fileType", fileType);

    std::ifstream in(path, std::ios::binary);
    in.exceptions(std::ios::failbit | std::ios::badbit);
    if (std::string(fileType) == "Binary") {
        const bool compressed = isCompressed(in);
        in.seekg(0);
        if (compressed) in.exceptions(std::ios::goodbit);
    }
    return reader.readNode(in, own.get());
}

}  // namespace

ReadResult readTileFile(const std::string& fileName, const osgDB::Options* options) {
    if (isGuarded(fileName, options)) {
        const std::string path = osgDB::findDataFile(fileName, options);
        const std::string extension = osgDB::getLowerCaseFileExtension(path);
        const char* const fileType = nativeFileType(extension);
        osgDB::ReaderWriter* const reader = fileType ? onlyReaderOf(extension) : nullptr;
        if (reader) return readGuarded(*reader, path, fileType, options);
    }
    return osgDB::Registry::instance()->readNodeImplementation(fileName, options);
}

}  // namespace osgAnalyticBin
