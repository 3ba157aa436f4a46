// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CopyTarget.h"

#include "Failure.h"
#include "TextFile.h"

#include <osgDB/FileNameUtils>
#include <osgDB/Options>
#include <osgDB/Registry>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <ostream>
#include <set>
#include <unistd.h>

namespace osgbinconv {

using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::UsageError;

namespace fs = std::filesystem;

namespace {

/// The names under which OSG's native writer knows its kinds of files; other formats drop the request for bins.
const char* fileTypeOf(const std::string& extension) {
    if (extension == "osgb") return "Binary";
    if (extension == "osgt") return "Ascii";
    if (extension == "osgx") return "XML";
    return nullptr;
}

void writeScene(const std::string& path, const std::string& extension, const osg::Node& scene) {
    osgDB::ReaderWriter* writer = osgDB::Registry::instance()->getReaderWriterForExtension(extension);
    if (!writer) throw Failure("OpenSceneGraph's plugin for ." + extension + " is missing; install it");
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options("precision 17");
    options->setPluginStringData("fileType", fileTypeOf(extension));
    options->setPluginStringData("WriteImageHint", "IncludeData");
    osgAnalyticBin::support::writeFile(
        path, [&](std::ostream& out) { return writer->writeNode(scene, out, options).success(); });
}

std::string markerOf(const std::string& rootFile) {
    return rootFile + ".copying";
}

/// What stands in the marker of a copy.
std::string markOf(const std::string& sourceFile) {
    std::error_code ignored;
    return fs::weakly_canonical(sourceFile, ignored).string() + "\n";
}

}  // namespace

std::string withExtension(const std::string& name, const std::string& extension) {
    return osgDB::getNameLessExtension(name) + "." + extension;
}

void requireCopyName(const std::string& rootFile, const std::string& sourceFile, bool overwrite) {
    if (!fileTypeOf(osgDB::getLowerCaseFileExtension(rootFile))) {
        throw UsageError("output \"" + rootFile + "\"; give a file name that ends in .osgb, .osgt or .osgx");
    }
    const std::string folder = osgDB::getFilePath(rootFile);
    if (!folder.empty() && !fs::is_directory(folder)) {
        throw Failure("no folder \"" + folder + "\" for the copy; create it first");
    }
    std::error_code ignored;
    if (fs::is_directory(rootFile, ignored)) {
        throw Failure("the output \"" + rootFile + "\" is a folder; name a file that ends in .osgb, .osgt or .osgx");
    }
    // an interrupted copy, which the same command makes anew, leaves its marker
    if (!fs::exists(rootFile, ignored) || fs::exists(markerOf(rootFile), ignored)) return;
    if (fs::weakly_canonical(rootFile, ignored) == fs::weakly_canonical(sourceFile, ignored)) {
        throw Failure("\"" + rootFile + "\" is a file of the database itself; give another folder or extension");
    }
    if (!overwrite) throw Failure("\"" + rootFile + "\" is there already; give --overwrite or another name");
}

CopyTarget::CopyTarget(const std::string& rootFile, const DatabaseFiles& source, const FileRecords& records,
                       bool overwrite)
    : _rootFile(rootFile),
      _folder(osgDB::getFilePath(rootFile)),
      _extension(osgDB::getLowerCaseFileExtension(rootFile)),
      _marker(markerOf(rootFile)),
      _lock(_marker, "osgbinconv", rootFile) {
    if (_folder.empty()) _folder = ".";
    const std::string left = osgAnalyticBin::support::contentOf(_marker);
    _goesOn = left == markOf(source.rootFile());
    _keepsMarker = !left.empty();
    try {
        requireFree(source, records, overwrite || _goesOn);
        mark(source.rootFile());
    } catch (...) {
        removeMarker();
        throw;
    }
    // an old copy must not look whole while its files are replaced
    std::error_code ignored;
    fs::remove(rootFile, ignored);
}

CopyTarget::~CopyTarget() {
    for (const std::string& path : _written) std::remove(path.c_str());
    removeMarker();
}

void CopyTarget::mark(const std::string& sourceFile) {
    const std::string text = markOf(sourceFile);
    const int handle = _lock.handle();
    if (::ftruncate(handle, 0) == 0 &&
        ::pwrite(handle, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size()))
        return;
    throw Failure("cannot write \"" + _marker + "\": " + std::strerror(errno) + "; make room or choose another folder");
}

void CopyTarget::removeMarker() {
    if (!_keepsMarker) _lock.remove();
}

void CopyTarget::requireFree(const DatabaseFiles& source, const FileRecords& records, bool overwrite) const {
    std::set<fs::path> originals;
    std::set<std::string> names;
    std::error_code ignored;
    for (const auto& entry : records) originals.insert(fs::weakly_canonical(source.pathOf(entry.first), ignored));
    for (const auto& entry : records) {
        const std::string path = pathOf(entry.first);
        if (!names.insert(path).second) throw Failure("two files would become \"" + path + "\"; rename one of them");
        if (!fs::exists(path, ignored)) continue;
        if (originals.count(fs::weakly_canonical(path, ignored)) > 0) {
            throw Failure("\"" + path + "\" is a file of the database itself; give another folder or extension");
        }
        if (!overwrite) throw Failure("\"" + path + "\" is there already; give --overwrite or another name");
    }
}

std::string CopyTarget::pathOf(const std::string& file) const {
    return file.empty() ? _rootFile : _folder + "/" + withExtension(file, _extension);
}

void CopyTarget::write(const std::string& file, const osg::Node& scene) {
    const std::string path = pathOf(file);
    std::error_code error;
    fs::create_directories(fs::path(path).parent_path(), error);
    {
        const std::lock_guard<std::mutex> guard(_mutex);
        _written.push_back(path);
    }
    writeScene(path, _extension, scene);
}

void CopyTarget::complete(const osg::Node& root) {
    osgAnalyticBin::support::flushToDisk(_folder);  // a root file that outlives a power failure has its tiles
    write("", root);
    _written.clear();
    _keepsMarker = false;
}

}  // namespace osgbinconv
