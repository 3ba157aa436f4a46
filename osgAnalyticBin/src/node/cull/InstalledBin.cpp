// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "InstalledBin.h"

#include "../tile/InstalledTile.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <osg/Node>

namespace osgAnalyticBin {

InstalledTile* installedTileOf(const osg::Node& node) {
    for (const osg::Callback* at = node.getCullCallback(); at; at = at->getNestedCallback()) {
        if (const auto* bin = dynamic_cast<const AnalyticBinCullCallback*>(at)) return bin->getInstalledTile();
    }
    return nullptr;
}

const AnalyticBinCullCallback* installedBinOf(const osg::Node& node) {
    for (const osg::Callback* at = node.getCullCallback(); at; at = at->getNestedCallback()) {
        const auto* const bin = dynamic_cast<const AnalyticBinCullCallback*>(at);
        if (bin && bin->getInstalledTile() && bin->getInstalledTile()->isFor(&node)) return bin;
    }
    return nullptr;
}

}  // namespace osgAnalyticBin
