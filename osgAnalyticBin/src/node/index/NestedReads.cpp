// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "NestedReads.h"

#include <osgAnalyticBin/TileFile.h>
#include <osgAnalyticBin/TileFrame.h>

#include <osg/Image>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>

namespace osgAnalyticBin::indexing {

namespace fs = std::filesystem;

using osgAnalyticBin::pagedFilePath;

namespace {

using Result = NestedReads::Result;

thread_local NestedReads* current = nullptr;

/// Neither an object nor an error: OSG goes on without.
Result nothing() {
    return Result::FILE_LOADED;
}

bool isFont(const std::string& name) {
    constexpr std::array<const char*, 9> kExtensions{"ttf", "ttc", "otf", "pfa", "pfb", "cid", "cff", "fon", "fnt"};
    const std::string extension = osgDB::getLowerCaseFileExtension(name);
    return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

/// OSG hands over the path where it has found a font: on its data path, or among the system's.
bool isOfferedFont(const std::string& path) {
    osgDB::FilePathList folders = osgDB::Registry::instance()->getDataFilePathList();
    folders.insert(folders.end(), {"/usr/share/fonts", "/usr/local/share/fonts"});
    const std::string plain = fs::path(path).lexically_normal().string();
    return std::any_of(folders.begin(), folders.end(), [&plain](const std::string& folder) {
        const std::string above = (fs::path(folder) / "").lexically_normal().string();
        return above.size() > 1 && plain.compare(0, above.size(), above) == 0;
    });
}

/// What OSG asks for by name, of the one that reads in this thread.
class ReadsOfThread : public osgDB::ReadFileCallback {
public:
    using Options = osgDB::Options;
    using Default = osgDB::ReadFileCallback;

    Result readNode(const std::string& name, const Options* options) override {
        const auto reader = [&](const std::string& path) { return osgAnalyticBin::readTileFile(path, options); };
        return current ? current->readScene(name, reader) : Default::readNode(name, options);
    }
    Result readHeightField(const std::string& name, const Options* options) override {
        const auto reader = [&](const std::string& path) { return Default::readHeightField(path, options); };
        return current ? current->readScene(name, reader) : reader(name);
    }
    Result readObject(const std::string& name, const Options* options) override {
        const auto reader = [&](const std::string& path) { return Default::readObject(path, options); };
        if (!current) return reader(name);
        return isFont(name) ? current->readFont(name, reader) : current->readScene(name, reader);
    }
    Result openArchive(const std::string& name, osgDB::ReaderWriter::ArchiveStatus status, unsigned int blockSize,
                       const Options* options) override {
        const auto reader = [&](const std::string& path) {
            return Default::openArchive(path, status, blockSize, options);
        };
        return current ? current->readScene(name, reader) : reader(name);
    }
    Result readImage(const std::string& name, const Options* options) override {
        const auto reader = [&](const std::string& path) { return Default::readImage(path, options); };
        return current ? current->readPart(name, new osg::Image, reader) : reader(name);
    }
    Result readShader(const std::string& name, const Options* options) override {
        const auto reader = [&](const std::string& path) { return Default::readShader(path, options); };
        return current ? current->readPart(name, nothing(), reader) : reader(name);
    }
    Result readScript(const std::string& name, const Options* options) override {
        const auto reader = [&](const std::string& path) { return Default::readScript(path, options); };
        return current ? current->readPart(name, nothing(), reader) : reader(name);
    }

protected:
    ~ReadsOfThread() override = default;
};

}  // namespace

NestedReads::NestedReads(const DatabaseFiles& files, const std::string& file, Images images)
    : _files(files), _images(images), _stack{file} {
    current = this;
}

NestedReads::~NestedReads() {
    current = nullptr;
}

osg::ref_ptr<osgDB::ReadFileCallback> NestedReads::callback() {
    return new ReadsOfThread;
}

std::string NestedReads::fileFrom(const std::string& referring, const std::string& name) const {
    if (!osgDB::isAbsolutePath(name)) return pagedFilePath(referring, name);
    const fs::path folder = fs::absolute(_files.rootFile()).lexically_normal().parent_path();
    return fs::path(name).lexically_normal().lexically_relative(folder).generic_string();
}

bool NestedReads::leaves(const std::string& name) const {
    return leavesFolder(fileFrom(_stack.back(), name));
}

std::string NestedReads::fileCalled(const std::string& name) const {
    const bool isGdal = osgDB::getLowerCaseFileExtension(name) == "gdal";
    const std::string own = isGdal ? osgDB::getNameLessExtension(name) : name;
    for (auto outer = _stack.rbegin(); outer != _stack.rend(); ++outer) {
        const std::string file = fileFrom(*outer, own);
        std::error_code ignored;
        if (!leavesFolder(file) && fs::is_regular_file(_files.pathOf(file), ignored)) {
            return isGdal ? file + ".gdal" : file;
        }
    }
    return {};
}

NestedReads::Found NestedReads::find(const std::string& name) const {
    std::string file = fileCalled(name);
    if (file.empty()) file = fileCalled(osgDB::getSimpleFileName(name));  // as OSG looks
    // absolute, for OSG would look for a relative path in other folders first
    if (!file.empty()) return {file == _files.rootName() ? "" : file, fs::absolute(_files.pathOf(file)).string()};
    if (leaves(name) || leavesFolder(fileFrom("", name))) return {};
    const std::string path = osgDB::findFileInPath(name, osgDB::Registry::instance()->getDataFilePathList());
    return {path, path};
}

void NestedReads::refuse(const std::string& name, const std::string& why) {
    if (_refusal.empty()) _refusal = "\"" + _files.pathOf(_stack.back()) + "\" names \"" + name + "\", " + why;
}

NestedReads::Result NestedReads::readScene(const std::string& name, const Reader& reader) {
    if (leaves(name)) {
        refuse(name, kIsOutside);
        return nothing();
    }
    const Found found = find(name);
    if (found.path.empty()) return nothing();
    if (std::find(_stack.begin(), _stack.end(), found.file) != _stack.end()) {
        refuse(name, "which is read below itself; such a database has no end");
        return nothing();
    }
    _stack.push_back(found.file);
    Result result = nothing();
    try {
        result = reader(found.path);
    } catch (const std::exception&) {
        // as a file that is missing
    }
    _stack.pop_back();
    return result;
}

NestedReads::Result NestedReads::readPart(const std::string& name, const Result& standIn, const Reader& reader) {
    if (_images == Images::Left) return standIn;
    const std::string path = find(name).path;
    if (path.empty() && leaves(name)) {
        refuse(name, "which is outside of the database's folder; put a copy beside that file, where OSG finds it");
    }
    if (_images == Images::Checked) return standIn;
    return path.empty() ? nothing() : reader(path);
}

NestedReads::Result NestedReads::readFont(const std::string& path, const Reader& reader) {
    if (_images == Images::Read && isOfferedFont(path)) return reader(path);
    return isOfferedFont(path) ? nothing() : readPart(path, nothing(), reader);
}

}  // namespace osgAnalyticBin::indexing
