// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PlanarBinCullCallback.h"

#include "../page/Database.h"
#include "BinCulling.h"

#include <osgAnalyticBin/core/edge/HullSeparation.h>

namespace osgAnalyticBin {

PlanarBinCullCallback::PlanarBinCullCallback(const PlanarBinCullCallback& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop),
      osg::Callback(other, copyop),
      osg::NodeCallback(other, copyop),
      _installed(other._installed ? new InstalledTile(*other._installed) : nullptr),
      _bin(other._bin),
      _sphere(other._sphere),
      _shape(other._shape),
      _options(other._options) {}

void PlanarBinCullCallback::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    cullOrTraverse(
        *nv, [&](osg::CullStack& cullStack) { return isCulled(*node, cullStack, *nv); }, [&] { traverse(node, nv); });
}

bool PlanarBinCullCallback::isCulled(const osg::Node& node, osg::CullStack& cullStack, osg::NodeVisitor& nv) const {
    if (_installed && !_installed->mayCull(&node)) return false;
    CullTraversal& traversal = CullTraversal::of(nv);
    if (_shape && !isShownIn(*_shape, traversal)) return false;
    return isCulledByBin(cullStack, nv, traversal, _sphere, [&](const osg::Polytope&, core::PlaneMask& undecided) {
        const core::PlaneSet& planes = traversal.planes(cullStack);
        const core::Side side = _bin.classify(planes, undecided);
        const bool isSeparated = side == core::Side::Straddling && _options.edges.value_or(true) &&
                                 core::isSeparated(_bin, planes, planes.size(), undecided);
        return isSeparated ? Verdict{core::Side::Outside, Verdict::Edge} : Verdict{side, Verdict::Plane};
    });
}

}  // namespace osgAnalyticBin
