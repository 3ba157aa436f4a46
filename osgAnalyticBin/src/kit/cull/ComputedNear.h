// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../tile/TerrainHider.h"
#include "TileSelection.h"

#include <osg/CullStack>
#include <osg/Node>
#include <osg/NodeVisitor>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace osgAnalyticBin {

/// Bounds the near plane that OSG computes after the cull traversal from what is drawn. The plane cuts nothing that is
/// drawn, except where it is moved away from the eye to CullSettings::getNearFarRatio() of the farthest depth: there it
/// is no farther than that share.
/// Source: doc/theory/occlusion.md, section 5.
class ComputedNear final : public NearPlaneBound {
public:
    /// Whether OSG computes the planes in a way that has a bound: from the boxes of drawables, straight across the look
    /// direction, without a callback of the application's.
    [[nodiscard]] static bool isPossible(osg::NodeVisitor& visitor, const osg::CullStack& cullStack);

    /// Looks through everything that is drawn with the visitor's present projection. `selection`: of the database at
    /// the visitor's present node. Requires: isPossible(). Returns: nullopt where a depth is not known. `unknown`
    /// returns the node that it is not known of; null: there is none, or it is not known what else the camera draws.
    /// Cost: some ten nanoseconds for each kept node, and for each node beside the database, 1024 at most.
    [[nodiscard]] static std::optional<ComputedNear> of(osgUtil::CullVisitor& visitor, const TileSelection& selection,
                                                        const osg::Node*& unknown);

    [[nodiscard]] double most(const std::vector<std::size_t>& hidden) const override;
    [[nodiscard]] double least() const override { return _ratio * std::max(0.0, _drawn); }

private:
    class DepthSearch;

    ComputedNear(const TileSelection& selection, double ratio) : _selection(&selection), _ratio(ratio) {}

    [[nodiscard]] static const osg::Node* addBeside(DepthSearch& search, const osg::NodePath& path,
                                                    osgUtil::CullVisitor& visitor);
    [[nodiscard]] bool addKept(osgUtil::CullVisitor& visitor, DepthSearch& search);

    const TileSelection* _selection;
    double _ratio;
    double _others = 0.0;         // the farthest depth of what is beside the database
    std::vector<double> _depths;  // of each kept node, without those below it
    double _drawn = 0.0;          // something surely is drawn as far from the eye
};

}  // namespace osgAnalyticBin
