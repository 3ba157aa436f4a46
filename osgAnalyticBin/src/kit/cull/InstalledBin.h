// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../CallbackChain.h"
#include "../tile/InstalledTile.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <osg/Node>

namespace osgAnalyticBin {

/// What the callback of a bin on the node keeps. Returns: nullptr without such a callback, and for an application's
/// own.
[[nodiscard]] inline InstalledTile* installedTileOf(const osg::Node& node) {
    const auto* const bin = findCallback<const AnalyticBinCullCallback>(node.getCullCallback());
    return bin ? bin->getInstalledTile() : nullptr;
}

/// The callback of a bin that an installer made for this very node. Returns: nullptr when there is none.
/// Not inlined: deeply nested scenes need the stack.
[[nodiscard, gnu::noinline]] inline const AnalyticBinCullCallback* installedBinOf(const osg::Node& node) {
    for (const osg::Callback* at = node.getCullCallback(); at; at = at->getNestedCallback()) {
        const auto* const bin = callbackAs<const AnalyticBinCullCallback>(*at);
        if (bin && bin->getInstalledTile() && bin->getInstalledTile()->isFor(&node)) return bin;
    }
    return nullptr;
}

}  // namespace osgAnalyticBin
