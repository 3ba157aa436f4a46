// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../tile/InstalledTile.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <osg/Node>

namespace osgAnalyticBin {

/// What the callback of a bin on the node keeps. Returns: nullptr without such a callback, and for an application's
/// own.
[[nodiscard]] inline InstalledTile* installedTileOf(const osg::Node& node) {
    for (const osg::Callback* at = node.getCullCallback(); at; at = at->getNestedCallback()) {
        if (const auto* bin = dynamic_cast<const AnalyticBinCullCallback*>(at)) return bin->getInstalledTile();
    }
    return nullptr;
}

/// The callback of a bin that an installer made for this very node. Returns: nullptr when there is none.
/// Not inlined, to leave stack for scenes that are nested deep.
[[nodiscard, gnu::noinline]] inline const AnalyticBinCullCallback* installedBinOf(const osg::Node& node) {
    for (const osg::Callback* at = node.getCullCallback(); at; at = at->getNestedCallback()) {
        const auto* const bin = dynamic_cast<const AnalyticBinCullCallback*>(at);
        if (bin && bin->getInstalledTile() && bin->getInstalledTile()->isFor(&node)) return bin;
    }
    return nullptr;
}

}  // namespace osgAnalyticBin
