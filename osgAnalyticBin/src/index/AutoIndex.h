// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BackgroundIndex.h"

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/index/DatabaseFiles.h>

#include <osg/ref_ptr>

#include <cstddef>
#include <string>
#include <utility>

namespace osgAnalyticBin {

/// Makes the index of a database in the background, and keeps it for the next time.
class AutoIndex final : public BackgroundIndex {
public:
    /// `kept`: an index with stamps, which is used if no file has changed since; null: none.
    AutoIndex(const std::string& rootFile, osg::ref_ptr<const BinIndex> kept)
        : BackgroundIndex(rootFile), _kept(std::move(kept)) {}

    [[nodiscard]] osg::ref_ptr<const BinIndex> whole() const override {
        const auto guard = lock();
        return _whole;
    }

protected:
    ~AutoIndex() override { stop(); }

private:
    class Observer;

    void make() override;
    [[nodiscard]] bool isUpToDate(const BinIndex& index, const indexing::DatabaseFiles& files) const;
    // Reads all files. Returns: the index, with stamps.
    [[nodiscard]] osg::ref_ptr<BinIndex> makeFrom(const indexing::DatabaseFiles& files);
    void publish(const osg::ref_ptr<const BinIndex>& index);
    void countTiles(std::size_t more);

    std::size_t _tiles = 0;
    osg::ref_ptr<const BinIndex> _kept;
    osg::ref_ptr<const BinIndex> _whole;  // guarded by lock()
};

}  // namespace osgAnalyticBin
