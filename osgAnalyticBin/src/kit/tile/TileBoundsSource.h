// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/CullOptions.h>

#include <osg/Referenced>
#include <osg/ref_ptr>

#include <chrono>
#include <string>
#include <utility>

namespace osgDB {
class Options;
}

namespace osgAnalyticBin {

/// Finds the bins of all tiles of a database, before the database reads them.
/// Threads: everything may be called at any time, start() once.
class TileBoundsSource : public osg::Referenced {
public:
    virtual void start() = 0;

    /// Returns: null until the bins are complete.
    [[nodiscard]] virtual osg::ref_ptr<const BinIndex> whole() const = 0;
    /// Whether they are complete, or cannot be found.
    [[nodiscard]] virtual bool hasEnded() const = 0;
    /// Whether there are complete bins, or messages that were not printed.
    [[nodiscard]] virtual bool hasNews() const = 0;
    /// Waits until they are complete or cannot be found. Returns: whether they are complete.
    virtual bool waitUntilWhole(std::chrono::duration<double> most) const = 0;

    /// Call when the DatabasePager begins (1) and ends (-1) to read a file.
    virtual void noteRead(int change) = 0;

    /// Prints messages to the user, each once.
    virtual void showNotes() = 0;

protected:
    ~TileBoundsSource() override = default;
};

/// The bins that a database is opened with.
struct ChosenIndex {
    osg::ref_ptr<const BinIndex> index;     ///< null: none that can be used at once
    osg::ref_ptr<TileBoundsSource> making;  ///< makes an index, once it is started; null: none is made
};

/// Looks for an index beside the database, and in the user's cache folder. One that cannot be used gives one warning.
/// Defined by the part `index`, not by the kit. Returns: nothing in programs without that part.
[[nodiscard]] ChosenIndex chooseIndex(const std::string& databaseFileName, const osgDB::Options* readOptions,
                                      IndexUse use);

/// Makes a source wait while a file is read. `source` may be null.
class BusyPager final {
public:
    explicit BusyPager(osg::ref_ptr<TileBoundsSource> source) : _source(std::move(source)) {
        if (_source) _source->noteRead(1);
    }
    ~BusyPager() {
        if (_source) _source->noteRead(-1);
    }
    BusyPager(const BusyPager&) = delete;
    BusyPager& operator=(const BusyPager&) = delete;

private:
    const osg::ref_ptr<TileBoundsSource> _source;
};

}  // namespace osgAnalyticBin
