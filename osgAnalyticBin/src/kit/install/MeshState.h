// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../tile/BoundWatch.h"

#include <osg/Group>
#include <osg/Node>
#include <osgTerrain/TerrainTile>

#include <cstdint>

namespace osgAnalyticBin {

/// What a mesh is known by, so that changes are noticed: hashes of what OSG keeps of it.
struct MeshState {
    std::uint64_t parts = 1;     ///< changes when a part is added, removed or replaced
    std::uint64_t frames = 1;    ///< changes when a part is moved
    std::uint64_t surfaces = 1;  ///< changes when vertices or triangles are said to have changed

    [[nodiscard]] static MeshState of(const osg::Node& mesh);
    [[nodiscard]] bool operator==(const MeshState& other) const {
        return parts == other.parts && frames == other.frames && surfaces == other.surfaces;
    }
};

/// A hash of vertices and triangles themselves: a new array may get the address of an old one.
[[nodiscard]] std::uint64_t contentOf(const osg::Node& mesh);

/// A hash of the bounds of what has no children, for vertices that moved without a word. Never 0.
[[nodiscard]] std::uint64_t boundsOf(const osg::Node& mesh);

/// A hash that changes when a transform is moved; 0 for other nodes.
[[nodiscard]] std::uint64_t frameOf(const osg::Node& node);

/// A tile of osgTerrain. Returns: nullptr for other nodes. Quick for the most common classes, because models may have
/// thousands of nodes.
[[nodiscard]] const osgTerrain::TerrainTile* asTerrain(const osg::Node& node);

/// Visits the nodes of a mesh. Tiles inside look after themselves; a terrain tile draws nothing of what is below it.
template <class Visit>
void forEachPart(const osg::Node& node, const Visit& visit) {
    visit(node);
    if (BoundWatch::isOn(node) || asTerrain(node)) return;
    const osg::Group* const group = node.asGroup();
    for (unsigned int i = 0; group && i < group->getNumChildren(); ++i) forEachPart(*group->getChild(i), visit);
}

}  // namespace osgAnalyticBin
