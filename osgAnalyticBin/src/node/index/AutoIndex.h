// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/index/DatabaseFiles.h>
#include <osgAnalyticBin/index/MadeIndex.h>

#include <osg/Referenced>
#include <osg/ref_ptr>
#include <osgDB/Options>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace osgAnalyticBin {

/// Makes the index of a database in a thread of low priority, and keeps it for the next time. Bins of subtrees can be
/// used as soon as all their files are read. Waits while the DatabasePager reads.
/// Threads: everything may be called at any time, start() once. The destructor and stop() wait for the thread, which
/// ends after the file that it reads.
class AutoIndex final : public osg::Referenced {
public:
    /// `kept`: an index with stamps, which is used if no file has changed since; null: none.
    AutoIndex(const std::string& rootFile, osg::ref_ptr<BinIndex> kept);

    void start();
    void stop();

    /// What is known of a tile, so far. `isWhole`: see isWhole(). Returns: nullopt, too, for a tile that is not in the
    /// database.
    [[nodiscard]] std::optional<BinIndex::Entry> find(const std::string& file, std::size_t ordinal) const;

    /// Whether the bins are those of the whole index: before, they hold all skirts, and some are missing.
    [[nodiscard]] bool isWhole() const { return _isWhole.load(std::memory_order_acquire); }
    /// Grows whenever more is known.
    [[nodiscard]] unsigned int generation() const { return _generation.load(std::memory_order_acquire); }

    /// Waits until it is whole, or never will be. Returns: whether it is whole.
    bool waitUntilWhole(std::chrono::duration<double> most) const;

    /// The DatabasePager begins and ends to read a file.
    void noteRead(int change) { _reads.fetch_add(change, std::memory_order_relaxed); }

    /// Lines for the user, each once.
    [[nodiscard]] std::vector<std::string> takeNotes();

protected:
    ~AutoIndex() override;

private:
    class Observer;

    void run();
    void make(const indexing::DatabaseFiles& files);
    void publish(const std::string& file, std::vector<BinIndex::Entry> tiles);
    void publishWhole(osg::ref_ptr<const BinIndex> index);
    void forgetSubtrees();
    void note(const std::string& line);
    void throwIfStopped() const;
    void giveWay();

    const std::string _rootFile;
    osg::ref_ptr<BinIndex> _kept;
    std::thread _thread;
    std::mutex _threadMutex;  // of _thread
    std::atomic<bool> _isStopped{false};
    std::atomic<bool> _isWhole{false};
    std::atomic<unsigned int> _generation{0};
    std::atomic<int> _reads{0};
    mutable std::mutex _mutex;  // guards what follows
    mutable std::condition_variable _changed;
    bool _hasEnded = false;
    std::map<std::string, std::vector<BinIndex::Entry>> _subtrees;
    osg::ref_ptr<const BinIndex> _whole;
    std::vector<std::string> _notes;
};

/// The index that a database is opened with.
struct ChosenIndex {
    osg::ref_ptr<const BinIndex> index;  ///< null: none that can be used at once
    osg::ref_ptr<AutoIndex> making;      ///< not started; null: none is made
};

/// Looks for an index beside the database, and in the user's cache folder. One that cannot be used gives one warning.
[[nodiscard]] ChosenIndex chooseIndex(const std::string& databaseFileName, const osgDB::Options* readOptions,
                                      IndexUse use);

}  // namespace osgAnalyticBin
