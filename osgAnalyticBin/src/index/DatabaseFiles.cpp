// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/TileFile.h>
#include <osgAnalyticBin/TileFrame.h>
#include <osgAnalyticBin/index/DatabaseFiles.h>

#include <osg/Image>
#include <osg/ref_ptr>
#include <osgDB/Callbacks>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/ObjectWrapper>
#include <osgDB/Options>
#include <osgDB/ReaderWriter>
#include <osgDB/Registry>

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <functional>
#include <ios>
#include <string>
#include <vector>

#if defined(_WIN32)
#include <windows.h>
#else
#include <sys/stat.h>
#endif

namespace osgAnalyticBin::indexing {

namespace fs = std::filesystem;

namespace {

// The message about such a file, and what to do.
constexpr const char* kIsOutside =
    "which is outside of the database's folder; name its files by paths below that folder";

// Whether a name that is relative to the root file's folder leads out of it.
bool leavesFolder(const std::string& file) {
    const bool climbs = file == ".." || file.rfind("../", 0) == 0;
    const bool isElsewhere = osgDB::isAbsolutePath(file) || file.find(":/") != std::string::npos;
    return climbs || isElsewhere || file.empty();
}

class NestedReads;
thread_local NestedReads* current = nullptr;

using Result = osgDB::ReaderWriter::ReadResult;

// Neither an object nor an error: OSG goes on without.
Result nothing() {
    return Result::FILE_LOADED;
}

bool isFont(const std::string& name) {
    constexpr std::array<const char*, 9> kExtensions{"ttf", "ttc", "otf", "pfa", "pfb", "cid", "cff", "fon", "fnt"};
    const std::string extension = osgDB::getLowerCaseFileExtension(name);
    return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

// While it exists, files that OSG reads in this thread because a file of a database names them (the content of
// proxies, height fields) are searched for only below the database's folder and on OSG's data path, and no server is
// contacted; bins do not depend on images, shaders and fonts, which are not opened. Names that end in a pseudo-loader's
// extension, except .gdal, do not count as files. Files that plugins of other formats than OSG's open by themselves are
// not noticed.
class NestedReads final {
public:
    // `file`: the one that is read, as DatabaseFiles names it. Requires: no other in this thread.
    NestedReads(const DatabaseFiles& files, const std::string& file) : _files(files), _stack{file} { current = this; }
    ~NestedReads() { current = nullptr; }
    NestedReads(const NestedReads&) = delete;
    NestedReads& operator=(const NestedReads&) = delete;

    // Why the file must not be used, in one line: the first name that leads elsewhere; empty: nothing is wrong.
    [[nodiscard]] const std::string& refusal() const { return _refusal; }

    using Reader = std::function<Result(const std::string& path)>;
    // What bins depend on: a name that leads elsewhere is refused.
    [[nodiscard]] Result readScene(const std::string& name, const Reader& reader) {
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

private:
    // The file that `referring` refers to by a name. An absolute path may lead into the folder.
    [[nodiscard]] std::string fileFrom(const std::string& referring, const std::string& name) const {
        if (!osgDB::isAbsolutePath(name)) return pagedFilePath(referring, name);
        const fs::path folder = fs::absolute(_files.rootFile()).lexically_normal().parent_path();
        return fs::path(name).lexically_normal().lexically_relative(folder).generic_string();
    }
    [[nodiscard]] bool leaves(const std::string& name) const { return leavesFolder(fileFrom(_stack.back(), name)); }
    // A file of the database, "" none.
    [[nodiscard]] std::string fileCalled(const std::string& name) const {
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

    struct Found {
        // As DatabaseFiles names it; a path when it is on OSG's data path.
        std::string file;
        // Empty: there is none.
        std::string path;
    };
    [[nodiscard]] Found find(const std::string& name) const {
        std::string file = fileCalled(name);
        if (file.empty()) file = fileCalled(osgDB::getSimpleFileName(name));  // as OSG looks
        // absolute, for OSG would look for a relative path in other folders first
        if (!file.empty()) return {file == _files.rootName() ? "" : file, fs::absolute(_files.pathOf(file)).string()};
        if (leaves(name) || leavesFolder(fileFrom("", name))) return {};
        const std::string path = osgDB::findFileInPath(name, osgDB::Registry::instance()->getDataFilePathList());
        return {path, path};
    }
    void refuse(const std::string& name, const std::string& why) {
        if (_refusal.empty()) _refusal = "\"" + _files.pathOf(_stack.back()) + "\" names \"" + name + "\", " + why;
    }

    const DatabaseFiles& _files;
    // The files that are being read, each named by the one before.
    std::vector<std::string> _stack;
    std::string _refusal;
};

// What OSG asks for by name, of the one that reads in this thread: has to be set in the options of a read, or in the
// registry.
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
        return isFont(name) ? nothing() : current->readScene(name, reader);
    }
    Result openArchive(const std::string& name, osgDB::ReaderWriter::ArchiveStatus status, unsigned int blockSize,
                       const Options* options) override {
        const auto reader = [&](const std::string& path) {
            return Default::openArchive(path, status, blockSize, options);
        };
        return current ? current->readScene(name, reader) : reader(name);
    }
    Result readImage(const std::string& name, const Options* options) override {
        return current ? Result(new osg::Image) : Default::readImage(name, options);
    }
    Result readShader(const std::string& name, const Options* options) override {
        return current ? nothing() : Default::readShader(name, options);
    }
    Result readScript(const std::string& name, const Options* options) override {
        return current ? nothing() : Default::readScript(name, options);
    }

protected:
    ~ReadsOfThread() override = default;
};

}  // namespace

Failure::~Failure() = default;

#if defined(_WIN32)

FileStamp stampOfPath(const std::string& path) {
    WIN32_FILE_ATTRIBUTE_DATA status{};
    if (!::GetFileAttributesExA(path.c_str(), GetFileExInfoStandard, &status)) return {};
    const auto joined = [](DWORD high, DWORD low) { return (static_cast<std::uint64_t>(high) << 32) | low; };
    constexpr std::int64_t kTicks = 10000000;        // a second, in units of 100 ns
    constexpr std::int64_t kEpochs = 11644473600LL;  // seconds from 1601 to 1970
    const auto time =
        static_cast<std::int64_t>(joined(status.ftLastWriteTime.dwHighDateTime, status.ftLastWriteTime.dwLowDateTime));
    return {joined(status.nFileSizeHigh, status.nFileSizeLow), time / kTicks - kEpochs, time % kTicks * 100};
}

#else

FileStamp stampOfPath(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return {};
    return {static_cast<std::uint64_t>(status.st_size), static_cast<std::int64_t>(status.st_mtim.tv_sec),
            static_cast<std::int64_t>(status.st_mtim.tv_nsec)};
}

#endif

DatabaseFiles::DatabaseFiles(const std::string& rootFile)
    : _rootFile(rootFile), _rootName(osgDB::getSimpleFileName(rootFile)), _folder(osgDB::getFilePath(rootFile)) {
    std::error_code error;
    if (osgDB::containsServerAddress(rootFile)) {
        throw Failure("\"" + rootFile + "\" is on a server; run osgbinconv where its files are");
    }
    if (!fs::exists(rootFile, error)) throw Failure("no file \"" + rootFile + "\"; name the root file of a database");
    if (!fs::is_regular_file(rootFile, error)) {
        throw Failure("\"" + rootFile + "\" is no file; name the root file of a database");
    }
    if (_folder.empty()) _folder = ".";
}

std::string DatabaseFiles::pathOf(const std::string& file) const {
    return file.empty() ? _rootFile : _folder + "/" + file;
}

osg::ref_ptr<osg::Node> DatabaseFiles::read(const std::string& file, std::string& error) const {
    const std::string path = pathOf(file);
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) {
        error = "is missing";
        return nullptr;
    }
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    options->setObjectCacheHint(osgDB::Options::CACHE_NONE);
    options->getDatabasePathList().push_front(osgDB::getFilePath(path));
    options->setReadFileCallback(new ReadsOfThread);
    const NestedReads nested(*this, file);
    osg::ref_ptr<osg::Node> node;
    try {
        osgDB::ReaderWriter::ReadResult result = osgAnalyticBin::readTileFile(path, options);
        node = result.getNode();
        error = result.message().empty() ? "cannot be read" : "cannot be read: " + result.message();
    } catch (const std::ios_base::failure&) {
        error = "ends too early";
    } catch (const std::exception& failure) {
        error = std::string("cannot be read: ") + failure.what();
    }
    if (!nested.refusal().empty()) throw Failure(nested.refusal());
    error = error.substr(0, error.find('\n'));
    return node;
}

std::string DatabaseFiles::checked(const std::string& file, const std::string& namedBy) const {
    if (leavesFolder(file)) throw Failure("\"" + pathOf(namedBy) + "\" names \"" + file + "\", " + kIsOutside);
    return file == _rootName ? std::string() : file;
}

// By a class of each: OSG locks its tables first and loads a library then, and the other order may deadlock.
void loadSerializers() {
    osgDB::ObjectWrapperManager& tables = *osgDB::Registry::instance()->getObjectWrapperManager();
    for (const char* const name : {"osg::Node", "osgTerrain::TerrainTile", "osgSim::LightPointNode",
                                   "osgAnalyticBin::AnalyticBinCullCallback", "osgFX::Effect", "osgText::Text"}) {
        (void)tables.findWrapper(name);
    }
}

void checkAllReads() {
    osgDB::Registry::instance()->setReadFileCallback(new ReadsOfThread);
}

}  // namespace osgAnalyticBin::indexing
