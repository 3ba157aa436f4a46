// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Commands.h"
#include "DiskFile.h"
#include "Failure.h"
#include "Nodes.h"
#include "Progress.h"
#include "TextFile.h"

#include <osgAnalyticBin/InstallBinsCallback.h>
#include <osgAnalyticBin/TileFinder.h>

#include <osg/ClusterCullingCallback>
#include <osg/Drawable>
#include <osg/PagedLOD>
#include <osg/ProxyNode>
#include <osgDB/FileNameUtils>
#include <osgDB/Options>
#include <osgDB/Registry>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <future>
#include <map>
#include <mutex>
#include <ostream>
#include <set>
#include <unistd.h>
#include <vector>

namespace osgbinconv {

namespace fs = std::filesystem;
using namespace osgAnalyticBin::support;

using osgAnalyticBin::AnalyticBin;
using osgAnalyticBin::BinIndex;
using osgAnalyticBin::InstallBinsCallback;

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

/// A name with another extension: "../a/b.ive" -> "../a/b.osgb".
std::string withExtension(const std::string& name, const std::string& extension) {
    return osgDB::getNameLessExtension(name) + "." + extension;
}

/// What a copy's name must be, as far as it can be told before the database is read.
/// Throws Failure when OpenSceneGraph cannot write such files with bins in them, when there is no such folder, or when
/// the file is there already and `overwrite` is not given.
void requireCopyName(const std::string& rootFile, const std::string& sourceFile, bool overwrite) {
    if (!fileTypeOf(osgDB::getLowerCaseFileExtension(rootFile)))
        throw UsageError("output \"" + rootFile + "\"; give a file name that ends in .osgb, .osgt or .osgx");
    const std::string folder = osgDB::getFilePath(rootFile);
    if (!folder.empty() && !fs::is_directory(folder))
        throw Failure("no folder \"" + folder + "\" for the copy; create it first");
    std::error_code ignored;
    if (fs::is_directory(rootFile, ignored))
        throw Failure("the output \"" + rootFile + "\" is a folder; name a file that ends in .osgb, .osgt or .osgx");
    // an interrupted copy, which the same command makes anew, leaves its marker
    if (!fs::exists(rootFile, ignored) || fs::exists(markerOf(rootFile), ignored)) return;
    if (fs::weakly_canonical(rootFile, ignored) == fs::weakly_canonical(sourceFile, ignored))
        throw Failure("\"" + rootFile + "\" is a file of the database itself; give another folder or extension");
    if (!overwrite) throw Failure("\"" + rootFile + "\" is there already; give --overwrite or another name");
}

/// The files of a copy, beside its root file as the originals are beside theirs. Each is written under a temporary name
/// and renamed, the root file last; what was written is removed again unless the copy is complete. While a copy is
/// made, "earth.osgb.copying" stands beside it, locked against a second program; a copy of the same database may
/// replace what the one has left that was killed.
class CopyTarget final {
public:
    /// Requires: requireCopyName(). Throws Failure when a file would replace one of the original or take the name of
    /// another one, or when one is there already and `overwrite` is not given.
    CopyTarget(const std::string& rootFile, const DatabaseFiles& source, const FileRecords& records, bool overwrite)
        : _rootFile(rootFile),
          _folder(osgDB::getFilePath(rootFile)),
          _extension(osgDB::getLowerCaseFileExtension(rootFile)),
          _marker(markerOf(rootFile)),
          _lock(_marker, "osgbinconv", rootFile) {
        if (_folder.empty()) _folder = ".";
        const std::string left = osgAnalyticBin::support::contentOf(_marker);
        const bool goesOn = left == markOf(source.rootFile());  // an earlier copy of the same database was killed
        _keepsMarker = !left.empty();
        try {
            requireFree(source, records, overwrite || goesOn);
            mark(source.rootFile());
        } catch (...) {
            removeMarker();
            throw;
        }
        // an old copy must not look whole while its files are replaced
        std::error_code ignored;
        fs::remove(rootFile, ignored);
    }
    CopyTarget(const CopyTarget&) = delete;
    CopyTarget& operator=(const CopyTarget&) = delete;
    ~CopyTarget() {
        for (const std::string& path : _written) std::remove(path.c_str());
        removeMarker();
    }

    /// Without the point.
    [[nodiscard]] const std::string& extension() const { return _extension; }

    /// `file`: the name of the original. For any thread. Throws Failure.
    void write(const std::string& file, const osg::Node& scene) {
        const std::string path = pathOf(file);
        std::error_code error;
        fs::create_directories(fs::path(path).parent_path(), error);
        {
            const std::lock_guard<std::mutex> guard(_mutex);
            _written.push_back(path);
        }
        writeScene(path, _extension, scene);
    }

    /// Writes the root file, when all others are there. Throws Failure.
    void complete(const osg::Node& root) {
        osgAnalyticBin::support::flushToDisk(_folder);  // a root file that outlives a power failure has its tiles
        write("", root);
        _written.clear();
        _keepsMarker = false;
    }

private:
    [[nodiscard]] std::string pathOf(const std::string& file) const {
        return file.empty() ? _rootFile : _folder + "/" + withExtension(file, _extension);
    }
    void mark(const std::string& sourceFile) {
        const std::string text = markOf(sourceFile);
        const int handle = _lock.handle();
        if (::ftruncate(handle, 0) == 0 &&
            ::pwrite(handle, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size()))
            return;
        throw Failure("cannot write \"" + _marker + "\": " + std::strerror(errno) +
                      "; make room or choose another folder");
    }
    void removeMarker() {
        if (!_keepsMarker) _lock.remove();
    }
    void requireFree(const DatabaseFiles& source, const FileRecords& records, bool overwrite) const {
        std::set<fs::path> originals;
        std::set<std::string> names;
        std::error_code ignored;
        for (const auto& entry : records) originals.insert(fs::weakly_canonical(source.pathOf(entry.first), ignored));
        for (const auto& entry : records) {
            const std::string path = pathOf(entry.first);
            if (!names.insert(path).second)
                throw Failure("two files would become \"" + path + "\"; rename one of them");
            if (!fs::exists(path, ignored)) continue;
            if (originals.count(fs::weakly_canonical(path, ignored)) > 0)
                throw Failure("\"" + path + "\" is a file of the database itself; give another folder or extension");
            if (!overwrite) throw Failure("\"" + path + "\" is there already; give --overwrite or another name");
        }
    }

    std::string _rootFile;
    std::string _folder;
    std::string _extension;
    std::string _marker;
    const osgAnalyticBin::support::LockedFile _lock;
    bool _keepsMarker = false;  ///< whether files of an earlier copy may be left
    std::mutex _mutex;
    std::vector<std::string> _written;
};

/// Gives the files that a node pages their new names, and takes away what the bins stand in for.
void rename(osg::Node& node, const std::string& extension, bool keepClusters) {
    while (const osg::ref_ptr<osg::Callback> old = findCallback<InstallBinsCallback>(node.getUpdateCallback()))
        node.removeUpdateCallback(old);
    while (!keepClusters) {
        const osg::ref_ptr<osg::Callback> old = findCallback<osg::ClusterCullingCallback>(node.getCullCallback());
        if (!old) break;
        node.removeCullCallback(old);
    }
    if (auto* const paged = dynamic_cast<osg::PagedLOD*>(&node)) {
        for (unsigned int i = 0; i < paged->getNumFileNames(); ++i)
            if (const std::string& name = paged->getFileName(i); !name.empty())
                paged->setFileName(i, withExtension(name, extension));
        paged->setDatabasePath("");
    }
    // what was read in place of a name goes to the copy, for the file does not
    if (auto* const proxy = dynamic_cast<osg::ProxyNode*>(&node))
        for (unsigned int i = 0; i < proxy->getNumFileNames() && i < proxy->getNumChildren(); ++i)
            proxy->setFileName(i, "");
}

void storeBins(osg::Node& scene, const FileRecord& record, const BinIndex& index) {
    struct Stored {
        AnalyticBin bin;
        double surfaceLow;
    };
    std::map<osg::Node*, Stored> bins;
    for (const osgAnalyticBin::FoundTile& tile :
         osgAnalyticBin::findTiles(scene, osgAnalyticBin::indexing::frameOf(record.place, record.file))) {
        const BinIndex::Entry* entry = tile.frame.file == record.file ? index.find(record.file, tile.ordinal) : nullptr;
        if (!entry) continue;
        // a node that stands in two places has one bin for both
        const auto [place, isNew] = bins.emplace(tile.node.get(), Stored{entry->bin, entry->ownLow});
        Stored& stored = place->second;
        stored.surfaceLow = std::min(stored.surfaceLow, entry->ownLow);
        if (!isNew && stored.bin.valid() && entry->bin.valid()) stored.bin.expandBy(entry->bin);
        if (!entry->bin.valid()) stored.bin = AnalyticBin();
    }
    for (const auto& [node, stored] : bins) {
        // a tile that is not known is left to the installer, which keeps it visible
        if (!stored.bin.valid()) continue;
        setStoredBin(*node, stored.bin);
        osgAnalyticBin::setStoredSurfaceLow(*node, stored.surfaceLow);
    }
}

class Copy {
public:
    Copy(const DatabaseFiles& files, const MadeIndex& built, CopyTarget& target, const CopyOptions& options,
         bool isQuiet)
        : _files(files), _built(built), _target(target), _options(options), _progress("copied", isQuiet) {
        for (const auto& [file, record] : built.records)
            if (record.isRead && !file.empty()) _waiting.push_back(&record);
    }

    /// The body of each thread.
    void work() {
        try {
            for (std::size_t i = _next++; i < _waiting.size() && !_isFailed; i = _next++) {
                throwIfStopRequested();
                write(*_waiting[i]);
            }
        } catch (...) {
            _isFailed = true;
            throw;
        }
    }

    /// Requires: the threads have ended.
    void finish() {
        const FileRecord& root = _built.records.at("");
        _target.complete(*readyScene(root));
        _progress.add(root.tiles.size(), 0.0);
        _progress.finish();
    }

private:
    void write(const FileRecord& record) {
        _target.write(record.file, *readyScene(record));
        const std::lock_guard<std::mutex> guard(_mutex);
        _progress.add(record.tiles.size(), 1.0 / static_cast<double>(_waiting.size()));
    }

    /// The scene as it goes to the copy.
    [[nodiscard]] osg::ref_ptr<osg::Node> readyScene(const FileRecord& record) const {
        std::string error;
        const osg::ref_ptr<osg::Node> scene = _files.read(record.file, Images::Read, error);
        if (!scene) throw Failure("\"" + _files.pathOf(record.file) + "\" " + error + "; it was there before");
        storeBins(*scene, record, *_built.index);
        osgAnalyticBin::support::forAllNodes(
            *scene, [&](osg::Node& node) { rename(node, _target.extension(), _options.keepClusters); });
        if (record.file.empty()) requestBins(*scene);
        return scene;
    }

    void requestBins(osg::Node& root) const {
        osgAnalyticBin::CullOptions options;
        if (_options.keepClusters) options.cluster = osgAnalyticBin::ClusterUse::Keep;
        root.addUpdateCallback(new InstallBinsCallback(options));
    }

    const DatabaseFiles& _files;
    const MadeIndex& _built;
    CopyTarget& _target;
    const CopyOptions _options;
    std::vector<const FileRecord*> _waiting;
    std::atomic<std::size_t> _next{0};
    std::atomic<bool> _isFailed{false};
    std::mutex _mutex;
    Progress _progress;
};

/// What is stored with a tile is read as latitudes and longitudes.
void requireGlobe(const FileRecords& records, const DatabaseFiles& files) {
    for (const auto& [file, record] : records) {
        const bool isMap = std::any_of(record.tiles.begin(), record.tiles.end(),
                                       [](const TileRecord& tile) { return tile.surface.isInMap; });
        if (isMap)
            throw Failure("\"" + files.rootFile() +
                          "\" is a map, whose bins cannot be stored with its tiles; make an index: osgbinconv --index");
    }
}

}  // namespace

void copyDatabase(const DatabaseFiles& files, const std::string& output, const CopyOptions& options,
                  const WalkOptions& walk) {
    requireCopyName(output, files.rootFile(), options.overwrite);
    WalkOptions survey = walk;
    survey.images = Images::Checked;  // what is refused must not cost an older copy its files
    const MadeIndex built = buildIndex(files, survey);
    requireGlobe(built.records, files);
    CopyTarget target(output, files, built.records, options.overwrite);
    Copy copy(files, built, target, options, walk.isQuiet);
    std::vector<std::future<void>> threads;
    for (int i = 0; i < walk.threads; ++i) threads.push_back(std::async(std::launch::async, [&copy] { copy.work(); }));
    for (std::future<void>& thread : threads) thread.get();
    copy.finish();
}

}  // namespace osgbinconv
