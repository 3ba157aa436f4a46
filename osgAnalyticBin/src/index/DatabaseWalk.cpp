// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FileSurvey.h"
#include "WorkQueue.h"

#include <osgAnalyticBin/index/DatabaseWalk.h>

#include <utility>
#include <vector>

namespace osgAnalyticBin::indexing {

namespace {

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
    Walk(const DatabaseFiles& files, std::vector<FileRecord> known, WalkObserver& observer)
        : _files(files), _observer(observer) {
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
        const osg::ref_ptr<osg::Node> scene = _files.read(job.file, error);
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
    WalkObserver& _observer;
    std::map<std::string, FileRecord> _known;

    WorkQueue<Job> _queue;
    std::map<std::string, FilePlace> _places;
    FileRecords _records;
};

}  // namespace

WalkObserver::~WalkObserver() = default;

void WalkObserver::done(const FileRecord&, bool, double) {}

FileRecords walkDatabase(const DatabaseFiles& files, std::vector<FileRecord> known, WalkObserver& observer,
                         int threads) {
    return Walk(files, std::move(known), observer).run(threads);
}

}  // namespace osgAnalyticBin::indexing
