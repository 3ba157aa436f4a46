// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../Classes.h"
#include "../Inverse.h"
#include "../PagedChildren.h"

#include <osg/Group>
#include <osg/LOD>
#include <osg/Matrixd>
#include <osg/PagedLOD>
#include <osg/Switch>
#include <osgUtil/CullVisitor>

#include <optional>

namespace osgAnalyticBin {

/// Calls `visit` for the children of a group that OSG may enter, until it returns false. Of levels of detail these are
/// the levels that are due at their distance, give or take its rounding, and the level that OSG shows while it waits
/// for a file. `toEye`: from inside the group. Returns: whether `visit` returned true for all.
template <class Visit>
[[nodiscard]] bool forEachShown(osg::Group& group, const osg::Matrixd& toEye, const osgUtil::CullVisitor& visitor,
                                const Visit& visit) {
    const auto* const lod = isOneOf<osg::LOD, osg::PagedLOD>(group) ? static_cast<osg::LOD*>(&group) : nullptr;
    const bool byDistance = lod && choosesByDistance(*lod, visitor) && visitor.getReferenceViewPoint() == osg::Vec3();
    const std::optional<osg::Matrixd> fromEye = byDistance ? affineInverse(toEye) : std::nullopt;
    const unsigned int children = group.getNumChildren();
    if (!fromEye) {
        const bool isActive = visitor.getTraversalMode() == osg::NodeVisitor::TRAVERSE_ACTIVE_CHILDREN;
        const auto* const choice = isActive && isOneOf<osg::Switch>(group) ? group.asSwitch() : nullptr;
        for (unsigned int i = 0; i < children; ++i)
            if ((!choice || choice->getValue(i)) && !visit(*group.getChild(i))) return false;
        return true;
    }
    constexpr double kRounding = 1e-6;  // of positions in floats
    const osg::Vec3d center = lod->getCenter(), eye = fromEye->getTrans();
    const double scale = static_cast<double>(visitor.getLODScale());
    const double distance = scale * (center - eye).length(),
                 room = scale * kRounding * (center.length() + eye.length());
    bool isOneAwaited = false;
    for (unsigned int i = 0; i < lod->getNumRanges(); ++i) {
        const double nearest = static_cast<double>(lod->getMinRange(i)), end = static_cast<double>(lod->getMaxRange(i));
        // written so that NaN is in range
        if (distance + room < nearest || distance - room >= end) continue;
        isOneAwaited = isOneAwaited || i >= children;
        if (i < children && !visit(*group.getChild(i))) return false;
    }
    return !isOneAwaited || children == 0 || visit(*group.getChild(children - 1));
}

}  // namespace osgAnalyticBin
