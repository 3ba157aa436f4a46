// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BackgroundIndex.h"

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/index/DatabaseFiles.h>

#include <osg/ref_ptr>
#include <osgDB/Options>

#include <functional>
#include <string>

namespace osgAnalyticBin {

/// As indexing::areCurrent().
[[nodiscard]] inline bool isCurrent(const BinIndex& index, const indexing::DatabaseFiles& files,
                                    const std::function<void()>& checkpoint) {
    return indexing::areCurrent(index.stamps(), files, checkpoint);
}

/// Makes the index of a database in the background, and keeps it for the next time.
class AutoIndex final : public BackgroundIndexOf<BinIndex> {
public:
    using BackgroundIndexOf::BackgroundIndexOf;

protected:
    ~AutoIndex() override { stop(); }
    [[nodiscard]] osg::ref_ptr<BinIndex> makeFrom(const indexing::DatabaseFiles& files) override;
    void keepWhole(const BinIndex& index) override;

private:
    class Observer;
};

using ChosenIndex = ChosenOf<BinIndex, AutoIndex>;

/// Looks for an index beside the database, and in the user's cache folder. One that cannot be used gives one warning.
[[nodiscard]] ChosenIndex chooseIndex(const std::string& databaseFileName, const osgDB::Options* readOptions,
                                      IndexUse use);

}  // namespace osgAnalyticBin
