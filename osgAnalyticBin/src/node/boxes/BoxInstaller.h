// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../surface/LodContent.h"
#include "BoxSet.h"

#include <osg/Group>
#include <osg/PagedLOD>
#include <osgDB/Options>

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

class BoxReadFileCallback;

/// Installs boxes on the LODs of the files of a photogrammetry set.
class BoxInstaller final {
public:
    /// `root`: of the set, where all of it is visited; null: a file of it.
    explicit BoxInstaller(BoxSet& set, const osg::Group* root = nullptr)
        : _set(set), _index(set.index()), _root(root) {}

    struct Content {
        MeshBox box;            ///< all vertices that are loaded
        bool isMisfit = false;  ///< whether the index does not know it as it is
    };

    /// Installs boxes on a file's content, and on what is loaded below. `parent`: the LOD that pages it; null: none.
    Content install(osg::Node& node, const std::string& file, BoxTile* parent);

    /// Reports the content without changing it, as content that the index does not know.
    [[nodiscard]] Content survey(osg::Node& node) const;

    /// Makes a group cull those of its children that have boxes.
    void placeFamily(osg::Group& group) const;

    /// Number of LODs that got boxes.
    [[nodiscard]] std::size_t installed() const { return _installed; }

private:
    // The options of PagedLODs: as they came (null: none), and with a callback of ours.
    struct Paging {
        osg::ref_ptr<osgDB::Options> own, options;
        BoxReadFileCallback* callback;  // the options keep it
    };
    using Pagings = std::vector<Paging>;

    [[nodiscard]] bool isKnown(const std::string& file, std::size_t lods) const;
    [[nodiscard]] Content place(const LodContent& content, const std::vector<Content>& below, const std::string& file,
                                const std::vector<osg::ref_ptr<BoxTile>>& tiles);
    void placeCallbacks(const LodContent& content, const std::vector<osg::ref_ptr<BoxTile>>& tiles);
    Content installBelow(osg::LOD& node, const std::string& file, BoxTile& tile);
    void followPaging(osg::PagedLOD& node, const std::string& file, BoxTile& tile, Pagings& pagings) const;
    [[nodiscard]] Paging makePaging(osgDB::Options* own) const;

    [[nodiscard]] bool isInGroup(const osg::Node& node) const;

    BoxSet& _set;
    const osg::ref_ptr<const BinIndex> _index;
    const osg::Group* const _root;
    std::map<const osg::Node*, osg::ref_ptr<BoxTile>> _members;  // of groups
    std::size_t _installed = 0;
};

/// Installs boxes on all tiles of a set, in place of earlier ones, and on those that are loaded later.
/// Returns: the number of LODs that have boxes now.
std::size_t installBoxes(osg::Group& set, const CullOptions& options);

/// Removes them.
void removeBoxes(osg::Group& set);

/// Returns: nullptr where a node is no set with boxes.
[[nodiscard]] BoxSet* boxSetOf(osg::Node& node);

}  // namespace osgAnalyticBin
