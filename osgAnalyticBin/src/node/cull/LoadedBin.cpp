// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What AnalyticBinCullCallback does where files below a tile may hold more than what is loaded.

#include "BinCulling.h"
#include "RequestAhead.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

namespace osgAnalyticBin {

AnalyticBin AnalyticBinCullCallback::shownBin() const {
    AnalyticBin bin = _setup->shape ? _bin.exaggerated(_setup->shape->verticalScale) : _bin;
    const core::Interval& altitude = bin.bin().altitude();
    // what is loaded counts with its skirts
    if (bin.valid() && !_declared.valid())
        bin.setBin(bin.bin().withAltitude({altitude.lower - _skirt, altitude.upper}));
    return bin;
}

void AnalyticBinCullCallback::setLoadedBin(const AnalyticBin& bin, const AnalyticBin& declared) {
    _bin = bin;
    _declared = declared;
    changeBin();
}

void AnalyticBinCullCallback::requestFilesOutOfView(osg::Node& node, osg::CullStack& cullStack,
                                                    osg::NodeVisitor& nv) const {
    const DatabaseView* const view = viewOn(cullStack, CullTraversal::of(nv));
    const core::HorizonEye* const eye = view ? view->eye : nullptr;
    if (mayRequestBelow(eye)) requestOutOfView(node, nv, eye);
}

bool AnalyticBinCullCallback::mayRequestBelow(const core::HorizonEye* eye) const {
    if (!_declared.valid()) return false;
    const Prepared& tile = prepared();
    return !eye || !tile.declaredHorizon || !eye->hides(*tile.declaredHorizon);
}

}  // namespace osgAnalyticBin
