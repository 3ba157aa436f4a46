// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/TileFinder.h>
#include <osgAnalyticBin/TileSurface.h>
#include <osgAnalyticBin/index/DatabaseWalk.h>

#include <osg/PagedLOD>
#include <osg/ProxyNode>
#include <osgDB/FileNameUtils>
#include <osgTerrain/Terrain>
#include <osgTerrain/TerrainTile>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>
#include <vector>

namespace osgAnalyticBin::indexing {

namespace {

FilePlace placeOf(const TileFrame& frame, bool isBelowTile, double sampleRatio) {
    FilePlace place;
    if (frame.ellipsoid) {
        place.equatorialRadius = frame.ellipsoid->getRadiusEquator();
        place.polarRadius = frame.ellipsoid->getRadiusPolar();
    }
    place.isProjected = frame.isProjected;
    std::copy_n(frame.localToEcef.ptr(), 16, place.localToEcef.begin());
    place.isBelowTile = isBelowTile;
    place.sampleRatio = sampleRatio;
    return place;
}

TileSurface surfaceOf(const FoundTile& tile, double sampleRatio) {
    TileSurface whole;
    if (!tile.frame.ellipsoid) return whole;
    bool isFirst = true;
    for (const auto& mesh : tile.meshes) {
        const TileSurface part = tileSurface(*mesh, *tile.frame.ellipsoid, tile.frame.localToEcef, sampleRatio);
        if (!part.bin.valid()) return {};
        whole.isInMap = part.isInMap;
        if (isFirst) whole.edgeLow = part.edgeLow;
        isFirst = false;
        whole.bin.expandBy(part.bin);
        for (std::size_t i = 0; i < 4; ++i) whole.edgeLow[i] = std::min(whole.edgeLow[i], part.edgeLow[i]);
        whole.skirt = std::max(whole.skirt, part.skirt);
        whole.isScalable = whole.isScalable || part.isScalable;
    }
    return whole;
}

using Nodes = std::set<const osg::Node*>;

/// Meets what a file draws, or pages, beside its tiles and the links that are known.
class OtherContent : public osg::NodeVisitor {
public:
    OtherContent(const Nodes& tiles, const Nodes& links)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _tiles(tiles), _links(links) {
        setNodeMaskOverride(~0u);
    }
    void apply(osg::Node& node) override {
        if (_tiles.count(&node) > 0) return;
        const bool isTerrain = dynamic_cast<osgTerrain::TerrainTile*>(&node) != nullptr;
        isFound = isFound || node.asDrawable() || isTerrain;
        if (!isTerrain) traverse(node);
    }
    void apply(osg::PagedLOD& node) override {
        isFound = isFound || (_tiles.count(&node) == 0 && _links.count(&node) == 0);
        apply(static_cast<osg::Node&>(node));
    }
    void apply(osg::ProxyNode& node) override {
        isFound = true;
        apply(static_cast<osg::Node&>(node));
    }

    bool isFound = false;

private:
    const Nodes& _tiles;
    const Nodes& _links;
};

class Survey : public TileFinder {
public:
    Survey(const DatabaseFiles& files, const std::string& file, const FilePlace& place)
        : TileFinder(frameOf(place, file)), _files(files), _sampleRatio(place.sampleRatio) {
        record.file = file;
    }

    FileRecord record;
    Nodes tiles;
    Nodes links;

protected:
    void visitTile(FoundTile& tile) override {
        // what is paged is read from its own file
        if (tile.frame.file != record.file) return;
        tiles.insert(tile.node.get());
        const auto ordinal = static_cast<std::int32_t>(record.tiles.size());
        record.tiles.push_back({surfaceOf(tile, _sampleRatio), tileFingerprint(tile), _tile});
        if (const auto* paged = dynamic_cast<const osg::PagedLOD*>(tile.node.get())) link(*paged, ordinal);
        const std::int32_t outer = _tile;
        _tile = ordinal;
        traverseBelow(*tile.node);
        _tile = outer;
    }

    void visitOther(osg::Node& node) override {
        if (frame().file != record.file) return;
        const double outer = _sampleRatio;
        if (const auto* terrain = dynamic_cast<const osgTerrain::Terrain*>(&node)) {
            _sampleRatio = static_cast<double>(terrain->getSampleRatio());
        }
        if (const auto* paged = dynamic_cast<const osg::PagedLOD*>(&node)) link(*paged, _tile);
        traverseBelow(node);
        _sampleRatio = outer;
    }

private:
    void link(const osg::PagedLOD& paged, std::int32_t tile) {
        links.insert(&paged);
        for (unsigned int i = 0; i < paged.getNumFileNames(); ++i) {
            const std::string& name = paged.getFileName(i);
            if (name.empty()) continue;
            requireOwnFolder(paged, name);
            const std::string file = pagedFilePath(record.file, name);
            record.links.push_back({_files.checked(file, record.file), tile,
                                    placeOf(frame(), frame().isBelowTile || tile >= 0, _sampleRatio)});
        }
    }

    /// A path that is stored in the file would send the pager elsewhere.
    void requireOwnFolder(const osg::PagedLOD& paged, const std::string& name) const {
        namespace fs = std::filesystem;
        const std::string own = osgDB::getFilePath(_files.pathOf(record.file));
        const std::string& stored = paged.getDatabasePath();
        if (stored.empty() || stored == own || stored == own + "/") return;
        std::error_code ignored;
        if (!fs::exists(stored + "/" + name, ignored) || fs::equivalent(stored, own.empty() ? "." : own, ignored))
            return;
        throw Failure("\"" + _files.pathOf(record.file) + "\" sends the pager to the folder \"" + stored +
                      "\"; store it without database paths");
    }

    const DatabaseFiles& _files;
    double _sampleRatio;
    std::int32_t _tile = -1;
};

/// What an index needs to know of the scene of one file: its tiles with their surfaces, and the files paged below them.
/// The scene is not changed. Throws Failure when it names files outside of the database's folder.
FileRecord surveyFile(osg::Node& scene, const std::string& file, const FilePlace& place, const DatabaseFiles& files) {
    Survey survey(files, file, place);
    scene.accept(survey);
    OtherContent other(survey.tiles, survey.links);
    scene.accept(other);
    survey.record.isRead = true;
    survey.record.hasOtherContent = other.isFound;
    return std::move(survey.record);
}

/// Jobs for several threads; a finished job may add new ones. The newest job is taken first.
template <class Job>
class WorkQueue final {
public:
    /// Call before run(), or in `finish`.
    void push(Job job) { _waiting.push_back(std::move(job)); }

    /// Call in `finish`: no more jobs are started.
    void stop() { _isStopped = true; }

    /// Does all jobs in that many threads, one of which is the caller's: `work(job)` in parallel, then
    /// `finish(job, result)`, one at a time. The first exception stops the others and is thrown when all have ended.
    template <class Work, class Finish>
    void run(int threads, const Work& work, const Finish& finish) {
        const auto body = [&] {
            try {
                while (const std::optional<Job> job = next()) finishOne(*job, work(*job), finish);
            } catch (...) {
                fail(std::current_exception());
            }
        };
        std::vector<std::thread> others;
        for (int i = 1; i < threads; ++i) others.emplace_back(body);
        body();
        for (std::thread& thread : others) thread.join();
        if (_error) std::rethrow_exception(_error);
    }

private:
    std::optional<Job> next() {
        std::unique_lock<std::mutex> guard(_mutex);
        _changed.wait(guard, [&] { return _isStopped || !_waiting.empty() || _busy == 0; });
        if (_isStopped || _waiting.empty()) return std::nullopt;
        Job job = std::move(_waiting.back());
        _waiting.pop_back();
        ++_busy;
        return job;
    }

    template <class Result, class Finish>
    void finishOne(const Job& job, Result result, const Finish& finish) {
        const std::lock_guard<std::mutex> guard(_mutex);
        finish(job, std::move(result));
        --_busy;
        _changed.notify_all();
    }

    void fail(std::exception_ptr error) {
        const std::lock_guard<std::mutex> guard(_mutex);
        if (!_error) _error = std::move(error);
        _isStopped = true;
        _changed.notify_all();
    }

    std::mutex _mutex;
    std::condition_variable _changed;
    std::vector<Job> _waiting;
    int _busy = 0;
    bool _isStopped = false;
    std::exception_ptr _error;
};

struct Job {
    std::string file;
    FilePlace place;
    /// Share of the whole walk, for progress, of this file with all below it. The number of files is not known before
    /// the end, so the files that a file names have equal parts of its share.
    double share = 1.0;
};

/// A file that is done.
struct Done {
    FileRecord record;
    /// Whether an earlier run did it.
    bool isKnown = false;
};

/// The files that are done, and the other data that the threads share.
class Walk {
public:
    Walk(const DatabaseFiles& files, std::vector<FileRecord> known, WalkObserver& observer, Images images)
        : _files(files), _images(images), _observer(observer) {
        for (FileRecord& record : known) _known[record.file] = std::move(record);
    }

    /// Throws what a thread throws.
    FileRecords run(int threads) {
        FilePlace& root = _places[""];
        root.localToEcef = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        _queue.push({"", root, 1.0});
        _queue.run(
            threads, [this](const Job& job) { return doneOf(job); },
            [this](const Job& job, Done done) { finish(std::move(done), job.share); });
        return std::move(_records);
    }

private:
    Done doneOf(const Job& job) {
        _observer.beforeFile();
        const FileStamp stamp = _files.stampOf(job.file);
        const auto known = _known.find(job.file);  // nobody changes it any more
        if (known != _known.end() && known->second.stamp == stamp && known->second.place == job.place) {
            return {known->second, true};
        }
        FileRecord record = recordOf(job);
        record.file = job.file;
        record.stamp = stamp;
        record.place = job.place;
        return {std::move(record), false};
    }

    FileRecord recordOf(const Job& job) const {
        std::string error;
        const osg::ref_ptr<osg::Node> scene = _files.read(job.file, _images, error);
        if (scene) return surveyFile(*scene, job.file, job.place, _files);
        if (!job.file.empty()) return {};
        throw Failure("\"" + _files.rootFile() + "\" " + error + "; name the root file of a database");
    }

    void finish(Done done, double share) {
        FileRecord& record = done.record;
        std::vector<Job> below;
        for (const FileLink& link : record.links) {
            if (isNew(link)) below.push_back({link.file, link.place, 0.0});
        }
        for (Job& job : below) {
            job.share = share / static_cast<double>(below.size());
            _queue.push(std::move(job));
        }
        const double ownShare = below.empty() ? share : 0.0;
        _observer.done(record, done.isKnown, ownShare);
        _records[record.file] = std::move(record);
    }

    bool isNew(const FileLink& link) {
        const auto [place, isNew] = _places.emplace(link.file, link.place);
        if (!isNew && !link.file.empty() && !(place->second == link.place)) {
            throw Failure("\"" + _files.pathOf(link.file) +
                          "\" is paged in two places that differ; an index needs each file in one place");
        }
        return isNew;
    }

    const DatabaseFiles& _files;
    const Images _images;
    WalkObserver& _observer;
    std::map<std::string, FileRecord> _known;

    WorkQueue<Job> _queue;
    std::map<std::string, FilePlace> _places;
    FileRecords _records;
};

}  // namespace

TileFrame frameOf(const FilePlace& place, const std::string& file) {
    TileFrame frame;
    if (place.equatorialRadius > 0.0) {
        frame.ellipsoid = new osg::EllipsoidModel(place.equatorialRadius, place.polarRadius);
    }
    frame.isProjected = place.isProjected;
    frame.localToEcef.set(place.localToEcef.data());
    frame.file = file;
    frame.isBelowTile = place.isBelowTile;
    return frame;
}

WalkObserver::~WalkObserver() = default;

void WalkObserver::done(const FileRecord&, bool, double) {}

FileRecords walkDatabase(const DatabaseFiles& files, std::vector<FileRecord> known, WalkObserver& observer, int threads,
                         Images images) {
    return Walk(files, std::move(known), observer, images).run(threads);
}

}  // namespace osgAnalyticBin::indexing
