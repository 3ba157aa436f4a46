// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

namespace osg {
class Node;
}

namespace osgAnalyticBin {

class AnalyticBinCullCallback;
class InstalledTile;

/// What the callback of a bin on the node keeps. Returns: nullptr without such a callback, and for an application's
/// own.
[[nodiscard]] InstalledTile* installedTileOf(const osg::Node& node);

/// The callback of a bin that an installer made for this very node. Returns: nullptr when there is none.
[[nodiscard]] const AnalyticBinCullCallback* installedBinOf(const osg::Node& node);

}  // namespace osgAnalyticBin
