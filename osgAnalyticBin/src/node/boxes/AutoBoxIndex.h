// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../index/BackgroundIndex.h"

#include <osgAnalyticBin/BoxIndex.h>
#include <osgAnalyticBin/CullOptions.h>

#include <osg/ref_ptr>

#include <functional>
#include <optional>
#include <string>

namespace osgAnalyticBin {

/// Makes the index of a photogrammetry set in the background, and keeps it for the next time. The boxes of a tile of
/// the set can be used as soon as all files below its root file are read.
class AutoBoxIndex final : public BackgroundIndex {
public:
    /// `kept`: an index with stamps, which is used if no file has changed since; null: none.
    AutoBoxIndex(const std::string& metadataFile, osg::ref_ptr<BoxIndex> kept);

    /// What is known of a file, so far. Returns: nullopt, too, for a file that is not in the set.
    [[nodiscard]] std::optional<BoxIndex::Boxes> find(const std::string& file) const;

    /// Returns: null until it is complete.
    [[nodiscard]] osg::ref_ptr<const BoxIndex> whole() const;

    /// Whether all files of the set are those that an index with stamps was made from, and the set has no other tiles.
    /// `checkpoint`: as for indexing::areCurrent().
    [[nodiscard]] static bool isCurrent(const BoxIndex& index, const indexing::DatabaseFiles& files,
                                        const std::function<void()>& checkpoint);

protected:
    ~AutoBoxIndex() override { stop(); }
    void make() override;

private:
    [[nodiscard]] bool makeOnce();

    osg::ref_ptr<BoxIndex> _kept;
    osg::ref_ptr<BoxIndex> _known;  // guarded by lock(); not changed when it is whole
};

using ChosenBoxIndex = ChosenOf<BoxIndex, AutoBoxIndex>;

/// Looks for an index beside the metadata of a set, and in the user's cache folder. One that cannot be used gives one
/// warning.
[[nodiscard]] ChosenBoxIndex chooseBoxIndex(const std::string& metadataFile, IndexUse use);

}  // namespace osgAnalyticBin
