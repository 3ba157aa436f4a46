// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/CullStack>
#include <osg/Group>
#include <osg/NodeVisitor>

namespace osgAnalyticBin {

class TileFamily;
struct DatabaseView;

/// Draws what is kept below a group to which OSG's traversal has come: by what was selected before, or, where that does
/// not hold for this traversal, by a selection that is made now.
/// Guarantee: the visitor comes to all that is kept as it would through OSG's nodes, in the same order, with the same
/// states, node paths and culling masks, and with time stamps of the levels on the way; tests: TileFamily.*,
/// FamilyTile.*, PagedFlight.*, Selection.*. Of what callbacks of an application change on nodes meanwhile, masks count
/// at once; all else may count from the next traversal on. Requires: a family that culls in this traversal.
void drawFamily(osg::Group& group, const TileFamily& family, osg::NodeVisitor& visitor, osg::CullStack& cullStack,
                const DatabaseView& view);

}  // namespace osgAnalyticBin
