// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../index/BackgroundIndex.h"

#include <osgAnalyticBin/BoxIndex.h>
#include <osgAnalyticBin/CullOptions.h>

#include <osg/ref_ptr>

#include <functional>
#include <string>

namespace osgAnalyticBin {

/// Whether all files of the set are those that an index with stamps was made from, and the set has no other tiles.
/// `checkpoint`: as for indexing::areCurrent().
[[nodiscard]] bool isCurrent(const BoxIndex& index, const indexing::DatabaseFiles& files,
                             const std::function<void()>& checkpoint);

/// Makes the index of a photogrammetry set in the background, and keeps it for the next time.
class AutoBoxIndex final : public BackgroundIndexOf<BoxIndex> {
public:
    using BackgroundIndexOf::BackgroundIndexOf;

protected:
    ~AutoBoxIndex() override { stop(); }
    [[nodiscard]] osg::ref_ptr<BoxIndex> makeFrom(const indexing::DatabaseFiles& files) override;
    void keepWhole(const BoxIndex& index) override;
};

using ChosenBoxIndex = ChosenOf<BoxIndex, AutoBoxIndex>;

/// Looks for an index beside the metadata of a set, and in the user's cache folder. One that cannot be used gives one
/// warning.
[[nodiscard]] ChosenBoxIndex chooseBoxIndex(const std::string& metadataFile, IndexUse use);

}  // namespace osgAnalyticBin
