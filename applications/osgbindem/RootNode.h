// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Settings.h"
#include "TileLayout.h"

#include <osg/CoordinateSystemNode>

namespace osgbindem {

/// The root node of a database, without tiles.
[[nodiscard]] osg::ref_ptr<osg::CoordinateSystemNode> makeRoot(const Settings& settings);

/// Declares below what nothing is drawn: a globe is whole, so that what lies behind it is hidden. Of a region nothing
/// is declared: where its horizon can be used is found out when it is shown.
void declareHorizon(osg::Group& root, const TileLayout& layout);

}  // namespace osgbindem
