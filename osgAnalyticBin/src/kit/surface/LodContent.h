// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "MeshBox.h"

#include <osg/LOD>
#include <osg/Node>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin {

/// A LOD of a file, and what stands below it there.
struct FoundLod {
    osg::LOD* node;
    std::optional<std::size_t> parent;  ///< number of the LOD above it in the same file
    MeshBox own;                        ///< vertices of the file that stand below it and below no other LOD
};

/// A plain group of a file.
struct FoundGroup {
    osg::Group* node;
    std::optional<std::size_t> lod;  ///< number of the LOD above it in the same file
};

/// What stands in a file of a photogrammetry set, the files paged below it left out.
struct LodContent {
    std::vector<FoundLod> lods;  ///< in preorder
    std::vector<FoundGroup> groups;
    MeshBox beside;  ///< vertices below no LOD

    /// All that stands below each LOD in the file, and what `below` adds to them, one for each LOD.
    [[nodiscard]] std::vector<MeshBox> boxes(const std::vector<MeshBox>& below) const;
    /// Everything in the file. `boxes`: those of all LODs.
    [[nodiscard]] MeshBox all(const std::vector<MeshBox>& boxes) const;
};

/// Finds the LODs of a file and the boxes of their meshes, those below static transforms included. Content that may
/// move, and drawables that are not drawn where their vertices are (billboards, text), have no bounds. LODs below a
/// transform have none either, and are not listed. The node is not changed, but bounds of its drawables are computed.
[[nodiscard]] LodContent findLods(osg::Node& node);

/// Whether a LOD pages this child in.
[[nodiscard]] bool isPagedChildOf(const osg::LOD& node, unsigned int child);

}  // namespace osgAnalyticBin
