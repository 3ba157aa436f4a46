// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FileSurvey.h"

#include <osgAnalyticBin/index/DatabaseWalk.h>
#include <osgAnalyticBin/index/Failure.h>

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace osgAnalyticBin::indexing {

namespace {

struct Job {
    std::string file;
    FilePlace place;
    /// Of the whole walk, this file with all below it: the number of files is not known before the end, so those that
    /// a file names have equal parts of its share.
    double share = 1.0;
};

/// A file that is done.
struct Done {
    FileRecord record;
    /// Whether an earlier run did it.
    bool isKnown = false;
};

/// The files that wait, those that are done, and what the threads share besides.
class Walk {
public:
    Walk(const DatabaseFiles& files, std::vector<FileRecord> known, WalkObserver& observer, Images images)
        : _files(files), _images(images), _observer(observer) {
        for (FileRecord& record : known) _known[record.file] = std::move(record);
    }

    void start() {
        _places[""] = FilePlace();
        FilePlace& root = _places[""];
        root.localToEcef = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        _waiting.push_back({"", root, 1.0});
    }

    /// The body of each thread.
    void work() {
        try {
            while (const std::optional<Job> job = next()) {
                _observer.beforeFile();
                finish(doneOf(*job), job->share);
            }
        } catch (...) {
            fail(std::current_exception());
        }
    }

    /// Requires: the threads have ended. Throws what they threw.
    FileRecords result() {
        if (_error) std::rethrow_exception(_error);
        return std::move(_records);
    }

private:
    std::optional<Job> next() {
        std::unique_lock<std::mutex> guard(_mutex);
        while (true) {
            if (_error || (_waiting.empty() && _busy == 0)) return std::nullopt;
            if (!_waiting.empty()) break;
            _changed.wait(guard);
        }
        Job job = std::move(_waiting.back());
        _waiting.pop_back();
        ++_busy;
        return job;
    }

    Done doneOf(const Job& job) {
        const FileStamp stamp = _files.stampOf(job.file);
        const auto known = _known.find(job.file);  // nobody changes it any more
        if (known != _known.end() && known->second.stamp == stamp && known->second.place == job.place) {
            return {known->second, true};
        }
        FileRecord record;
        std::string error;
        if (const osg::ref_ptr<osg::Node> scene = _files.read(job.file, _images, error)) {
            record = surveyFile(*scene, job.file, job.place, _files);
        } else if (job.file.empty()) {
            throw Failure("\"" + _files.rootFile() + "\" " + error + "; name the root file of a database");
        }
        record.file = job.file;
        record.stamp = stamp;
        record.place = job.place;
        const std::lock_guard<std::mutex> guard(_keepMutex);
        _observer.keep(record);
        return {std::move(record), false};
    }

    void finish(Done done, double share) {
        FileRecord& record = done.record;
        const std::lock_guard<std::mutex> guard(_mutex);
        const std::size_t before = _waiting.size();
        for (const FileLink& link : record.links) enter(link);
        const std::size_t below = _waiting.size() - before;
        for (std::size_t i = before; i < _waiting.size(); ++i) _waiting[i].share = share / static_cast<double>(below);
        const double ownShare = below == 0 ? share : 0.0;
        _observer.done(record, done.isKnown, ownShare);
        _records[record.file] = std::move(record);
        --_busy;
        _changed.notify_all();
    }

    void enter(const FileLink& link) {
        const auto [place, isNew] = _places.emplace(link.file, link.place);
        if (isNew) {
            _waiting.push_back({link.file, link.place, 0.0});
        } else if (!link.file.empty() && !(place->second == link.place)) {
            throw Failure("\"" + _files.pathOf(link.file) +
                          "\" is paged in two places that differ; an index needs each file in one place");
        }
    }

    void fail(std::exception_ptr error) {
        const std::lock_guard<std::mutex> guard(_mutex);
        if (!_error) _error = std::move(error);
        _changed.notify_all();
    }

    const DatabaseFiles& _files;
    const Images _images;
    WalkObserver& _observer;
    std::map<std::string, FileRecord> _known;
    std::mutex _keepMutex;

    std::mutex _mutex;
    std::condition_variable _changed;
    std::vector<Job> _waiting;
    int _busy = 0;
    std::map<std::string, FilePlace> _places;
    FileRecords _records;
    std::exception_ptr _error;
};

}  // namespace

WalkObserver::~WalkObserver() = default;

void WalkObserver::keep(const FileRecord&) {}

void WalkObserver::done(const FileRecord&, bool, double) {}

FileRecords walkDatabase(const DatabaseFiles& files, std::vector<FileRecord> known, WalkObserver& observer, int threads,
                         Images images) {
    Walk walk(files, std::move(known), observer, images);
    walk.start();
    std::vector<std::thread> others;
    for (int i = 1; i < threads; ++i) others.emplace_back([&walk] { walk.work(); });
    walk.work();
    for (std::thread& thread : others) thread.join();
    return walk.result();
}

}  // namespace osgAnalyticBin::indexing
