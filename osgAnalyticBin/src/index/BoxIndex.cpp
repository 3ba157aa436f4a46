// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// makeBoxIndex(): reads all files of a set, each once, and adds up their boxes from the leaves.

#include "../kit/WorkQueue.h"
#include "../kit/surface/LodContent.h"

#include <osgAnalyticBin/BoxIndex.h>
#include <osgAnalyticBin/PhotogrammetrySet.h>
#include <osgAnalyticBin/TileFile.h>
#include <osgAnalyticBin/TileFrame.h>
#include <osgAnalyticBin/index/DatabaseFiles.h>

#include <osg/PagedLOD>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>

#include <algorithm>
#include <map>
#include <optional>

namespace osgAnalyticBin {

namespace {

/// What a file holds; its scene is forgotten.
struct Surveyed {
    struct Lod {
        MeshBox own;
        std::vector<std::string> files;
        std::optional<std::size_t> parent;
    };
    std::vector<Lod> lods;
    MeshBox beside;
};

Surveyed surveyed(osg::Node& node, const std::string& file) {
    const LodContent content = findLods(node);
    Surveyed result{{}, content.beside};
    for (const FoundLod& lod : content.lods) {
        result.lods.push_back({lod.own, {}, lod.parent});
        const auto* const paged = dynamic_cast<const osg::PagedLOD*>(lod.node);
        for (unsigned int i = 0; paged && i < paged->getNumFileNames(); ++i) {
            if (isPagedChildOf(*paged, i))
                result.lods.back().files.push_back(pagedFilePath(file, paged->getFileName(i)));
        }
    }
    return result;
}

class Survey {
public:
    Survey(std::string folder, const BoxIndexProgress& progress) : _folder(std::move(folder)), _progress(progress) {}

    void run(const std::vector<std::string>& roots, int threads) {
        for (const std::string& root : roots) enter(root, 1.0 / static_cast<double>(roots.size()));
        _queue.run(
            threads, [this](const Job& job) { return read(job.file); },
            [this](const Job& job, Read read) { finish(job, std::move(read)); });
    }

    [[nodiscard]] bool isStopped() const { return _isStopped; }

    /// Requires: run().
    [[nodiscard]] osg::ref_ptr<BinIndex> result() {
        const osg::ref_ptr<BinIndex> index = new BinIndex;
        BinIndex::Stamps stamps;
        for (const auto& [file, read] : _read) {
            stamps[file] = read.stamp;
            if (!read.content) continue;
            std::vector<BinIndex::Entry> entries;
            for (const MeshBox& box : boxesOf(*read.content)) entries.push_back({box.bin()});
            index->setTiles(file, std::move(entries));
        }
        index->setStamps(std::move(stamps));
        return index;
    }

private:
    struct Job {
        std::string file;
        double share;
    };

    struct Read {
        BinIndex::Stamp stamp;  // from before it was read
        std::optional<Surveyed> content;
        std::string complaint;  // empty where there is none
    };

    void enter(const std::string& file, double share) {
        if (_read.emplace(file, Read()).second) _queue.push({file, share});
    }

    [[nodiscard]] Read read(const std::string& file) const {
        const std::string path = osgDB::concatPaths(_folder, file);
        const BinIndex::Stamp stamp = indexing::stampOfPath(path);
        // missing children are not drawn either
        if (!osgDB::fileExists(path)) return {stamp, std::nullopt, {}};
        std::string why = "cannot be read";
        try {
            const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
            options->setObjectCacheHint(osgDB::Options::CACHE_NONE);
            osgDB::ReaderWriter::ReadResult result = readTileFile(path, options.get());
            if (result.validNode()) return {stamp, surveyed(*result.getNode(), file), {}};
        } catch (const std::exception& error) {
            why += std::string(": ") + error.what();
        }
        return {stamp, std::nullopt, "\"" + path + "\" " + why + "; it counts as empty"};
    }

    void finish(const Job& job, Read read) {
        if (!read.complaint.empty() && _progress.unreadable) _progress.unreadable(read.complaint);
        const std::optional<Surveyed>& content = read.content;
        const std::size_t lods = content ? content->lods.size() : 0;
        std::size_t files = 0;
        for (std::size_t i = 0; i < lods; ++i) files += content->lods[i].files.size();
        for (std::size_t i = 0; i < lods; ++i) {
            for (const std::string& file : content->lods[i].files) enter(file, job.share / static_cast<double>(files));
        }
        _read[job.file] = std::move(read);
        if (_progress.fileDone) _progress.fileDone(lods, files == 0 ? job.share : 0.0);
        if (!_progress.goesOn || _progress.goesOn()) return;
        _isStopped = true;
        _queue.stop();
    }

    // All that is in a file and below it.
    const MeshBox& wholeOf(const std::string& file) {
        const auto known = _wholes.find(file);
        if (known != _wholes.end()) return known->second;
        // what is paged below itself has no end
        _wholes[file] = MeshBox::boundless();
        const auto found = _read.find(file);
        MeshBox whole;
        if (found != _read.end() && found->second.content) {
            const std::vector<MeshBox> boxes = boxesOf(*found->second.content);
            whole.expandBy(found->second.content->beside);
            for (const MeshBox& box : boxes) whole.expandBy(box);
        }
        return _wholes[file] = whole;
    }

    std::vector<MeshBox> boxesOf(const Surveyed& content) {
        std::vector<MeshBox> boxes(content.lods.size());
        for (std::size_t i = boxes.size(); i-- > 0;) {
            const Surveyed::Lod& lod = content.lods[i];
            boxes[i].expandBy(lod.own);
            for (const std::string& file : lod.files) boxes[i].expandBy(wholeOf(file));
            if (lod.parent) boxes[*lod.parent].expandBy(boxes[i]);
        }
        return boxes;
    }

    const std::string _folder;
    const BoxIndexProgress& _progress;
    WorkQueue<Job> _queue;
    bool _isStopped = false;
    std::map<std::string, Read> _read;
    std::map<std::string, MeshBox> _wholes;
};

}  // namespace

osg::ref_ptr<BinIndex> makeStampedBoxIndex(const std::string& metadataFile, int threads,
                                           const BoxIndexProgress& progress, std::string& error) {
    const PhotogrammetryFiles files = findPhotogrammetryFiles(metadataFile, error);
    if (files.roots.empty()) return nullptr;
    Survey survey(osgDB::getFilePath(metadataFile), progress);
    survey.run(files.roots, threads);
    if (survey.isStopped()) {
        error = "was stopped";
        return nullptr;
    }
    osg::ref_ptr<BinIndex> index = survey.result();
    index->setSource({osgDB::getSimpleFileName(metadataFile), 0, 0});
    if (index->fileCount() > 0) return index;
    error = "no tile of \"" + metadataFile + "\" can be read";
    return nullptr;
}

osg::ref_ptr<BinIndex> makeBoxIndex(const std::string& metadataFile, int threads, const BoxIndexProgress& progress,
                                    std::string& error) {
    osg::ref_ptr<BinIndex> index = makeStampedBoxIndex(metadataFile, threads, progress, error);
    // it may be copied together with the set
    if (index) index->setStamps({});
    return index;
}

}  // namespace osgAnalyticBin
