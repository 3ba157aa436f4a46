// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RivalBins.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <osg/Callback>
#include <osg/CullStack>
#include <osg/NodeVisitor>

#include <optional>
#include <string>
#include <variant>

namespace osgAnalyticBin::rivals {

/// Rules for culling that others use or have published, to be compared with bins.
enum class Rule {
    Paper,       ///< the published nine-point rule: unsound
    Corners,     ///< the eight corners of the bin: unsound
    Box,         ///< the bin's box along the axes of ECEF: sound
    OrientedBox  ///< the bin's box along east, north and up, and a horizon point: sound
};

/// Of "paper", "corners", "box" and "orientedbox", one of which is required.
[[nodiscard]] Rule ruleNamed(const std::string& name);

/// How a rule culls.
struct RivalOptions {
    Rule rule = Rule::Paper;
    bool usesHorizon = false;  ///< of the lowest surface shown, as the kit finds it
    bool testsEdges = false;   ///< also against edges of the frustum; boxes: by their faces
};

/// Culls a tile by one of the rules in place of the kit's own callback, which is nested in it and not run: it says what
/// the tile's bin is. What is nested in the kit's callback runs when the tile is kept.
/// Requires: a tile that is tested by itself (BinStatistics::setTileByTile()), without OSG's sphere test.
/// Threads: run() changes nothing.
class RivalCullCallback final : public osg::Callback {
public:
    /// `tile`: the kit's callback, with a valid bin.
    RivalCullCallback(AnalyticBinCullCallback& tile, const RivalOptions& options);

    /// Whether the rule is that for the tile's present bin.
    [[nodiscard]] bool isFor(const AnalyticBinCullCallback& tile) const;

    bool run(osg::Object* object, osg::Object* data) override;

private:
    using RivalBin = std::variant<PaperBin, CornersBin, Box>;

    [[nodiscard]] static RivalBin rivalBin(const AnalyticBin& bin, const core::Ellipsoid& ellipsoid,
                                           const RivalOptions& options);
    [[nodiscard]] bool isHidden(osg::NodeVisitor& visitor) const;
    [[nodiscard]] core::Side test(osg::NodeVisitor& visitor, osg::CullStack& cullStack,
                                  core::PlaneMask& undecided) const;

    const AnalyticBin _shown;
    const RivalBin _bin;
    std::optional<core::ExactGeodeticBin> _exact;  // for the test against edges, where the bin is no box
    std::optional<core::HorizonBin> _horizon;
    std::optional<HorizonPoint> _horizonPoint;  // for boxes, in place of the bin's horizon
    bool _testsEdges;
    bool _isInEcef;
    osg::Matrixd _fromEcef;
};

/// Culls the tiles of a database by a rule in place of the bins that the kit has installed on it, those that are paged
/// in later from the update traversal on in which they arrive. The root's callbacks see to that; nothing takes the rule
/// off again. `root`: the node that installBins() was called for.
/// Returns: how many tiles have the rule now.
std::size_t installRivals(osg::Node& root, const RivalOptions& options);

}  // namespace osgAnalyticBin::rivals
