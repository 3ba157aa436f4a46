// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BackgroundIndex.h"

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/index/DatabaseFiles.h>

#include <osg/ref_ptr>
#include <osgDB/Options>

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin {

/// Makes the index of a database in the background, and keeps it for the next time. Bins of subtrees can be used as
/// soon as all their files are read. Before it is whole, bins hold all skirts, and some are missing.
class AutoIndex final : public BackgroundIndex {
public:
    /// `kept`: an index with stamps, which is used if no file has changed since; null: none.
    AutoIndex(const std::string& rootFile, osg::ref_ptr<BinIndex> kept);

    /// What is known of a tile, so far. Returns: nullopt, too, for a tile that is not in the database.
    [[nodiscard]] std::optional<BinIndex::Entry> find(const std::string& file, std::size_t ordinal) const;

    /// As indexing::areCurrent().
    [[nodiscard]] static bool isCurrent(const BinIndex& index, const indexing::DatabaseFiles& files,
                                        const std::function<void()>& checkpoint) {
        return indexing::areCurrent(index.stamps(), files, checkpoint);
    }

protected:
    ~AutoIndex() override { stop(); }
    void make() override;

private:
    class Observer;

    void makeFrom(const indexing::DatabaseFiles& files);
    void publishWhole(osg::ref_ptr<const BinIndex> index);

    osg::ref_ptr<BinIndex> _kept;
    // guarded by lock()
    std::map<std::string, std::vector<BinIndex::Entry>> _subtrees;
    osg::ref_ptr<const BinIndex> _whole;
};

using ChosenIndex = ChosenOf<BinIndex, AutoIndex>;

/// Looks for an index beside the database, and in the user's cache folder. One that cannot be used gives one warning.
[[nodiscard]] ChosenIndex chooseIndex(const std::string& databaseFileName, const osgDB::Options* readOptions,
                                      IndexUse use);

}  // namespace osgAnalyticBin
