// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Settings.h"

#include <osg/CoordinateSystemNode>

namespace osgbindem {

/// The root node of a database, without tiles.
[[nodiscard]] osg::ref_ptr<osg::CoordinateSystemNode> makeRoot(const Settings& settings);

/// Declares below what nothing is drawn: the globe is whole, so that what lies behind it is hidden.
void declareHorizon(osg::Group& root);

}  // namespace osgbindem
