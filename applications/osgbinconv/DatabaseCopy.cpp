// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Commands.h"
#include "CopyTarget.h"
#include "Failure.h"
#include "Interruption.h"
#include "Progress.h"

#include <osgAnalyticBin/InstallBinsCallback.h>
#include <osgAnalyticBin/TileFinder.h>

#include <osg/ClusterCullingCallback>
#include <osg/Drawable>
#include <osg/PagedLOD>
#include <osg/ProxyNode>
#include <osgTerrain/TerrainTile>

#include <algorithm>
#include <atomic>
#include <future>
#include <map>
#include <mutex>
#include <vector>

namespace osgbinconv {

using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::throwIfStopRequested;

using osgAnalyticBin::AnalyticBin;
using osgAnalyticBin::BinIndex;
using osgAnalyticBin::InstallBinsCallback;

namespace {

template <class Callback>
Callback* callbackIn(osg::Callback* first) {
    for (osg::Callback* callback = first; callback; callback = callback->getNestedCallback()) {
        if (auto* found = dynamic_cast<Callback*>(callback)) return found;
    }
    return nullptr;
}

/// Gives the files that a scene pages their new names, and takes away what the bins stand in for.
class Renaming : public osg::NodeVisitor {
public:
    Renaming(const std::string& extension, bool keepClusters)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _extension(extension), _keepClusters(keepClusters) {
        setNodeMaskOverride(~0u);
    }

    void apply(osg::Node& node) override {
        while (osg::ref_ptr<osg::Callback> old = callbackIn<InstallBinsCallback>(node.getUpdateCallback())) {
            node.removeUpdateCallback(old);
        }
        while (!_keepClusters) {
            const osg::ref_ptr<osg::Callback> old = callbackIn<osg::ClusterCullingCallback>(node.getCullCallback());
            if (!old) break;
            node.removeCullCallback(old);
        }
        // A terrain tile that is traversed before it has its Terrain never finds it afterwards.
        if (!dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
    }

    void apply(osg::PagedLOD& node) override {
        for (unsigned int i = 0; i < node.getNumFileNames(); ++i) {
            const std::string& name = node.getFileName(i);
            if (!name.empty()) node.setFileName(i, withExtension(name, _extension));
        }
        node.setDatabasePath("");
        apply(static_cast<osg::Node&>(node));
    }

    /// What was read in place of a name goes to the copy, for the file does not.
    void apply(osg::ProxyNode& node) override {
        for (unsigned int i = 0; i < node.getNumFileNames() && i < node.getNumChildren(); ++i) node.setFileName(i, "");
        apply(static_cast<osg::Node&>(node));
    }

private:
    const std::string& _extension;
    const bool _keepClusters;
};

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
        for (const auto& [file, record] : built.records) {
            if (record.isRead && !file.empty()) _waiting.push_back(&record);
        }
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
        Renaming renaming(_target.extension(), _options.keepClusters);
        scene->accept(renaming);
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
        if (isMap) {
            throw Failure("\"" + files.rootFile() +
                          "\" is a map, whose bins cannot be stored with its tiles; make an index: osgbinconv --index");
        }
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
