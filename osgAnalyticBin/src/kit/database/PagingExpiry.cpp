// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PagingExpiry.h"

#include "../PagedChildren.h"
#include "../tile/MeshCulling.h"

#include <osg/PagedLOD>
#include <osg/UserDataContainer>
#include <osg/ValueObject>

#include <string>

namespace osgAnalyticBin {

namespace {

// Nearly every child's time is 0 at first and is restored to 0: only other times are recorded.
std::string keyOf(unsigned int child) {
    return "osgAnalyticBin expiry " + std::to_string(child);
}

void forget(osg::PagedLOD& node, const std::string& key) {
    osg::UserDataContainer* values = node.getUserDataContainer();
    if (!values || !values->getUserObject(key)) return;
    ownValues(node);
    values = node.getUserDataContainer();
    values->removeUserObject(values->getUserObjectIndex(key));
    forgetEmptyValues(node);
}

}  // namespace

void raiseExpiry(osg::PagedLOD& node, double seconds) {
    for (unsigned int i = 0; i < node.getNumMinimumExpiryTimes(); ++i) {
        const double own = node.getMinimumExpiryTime(i);
        if (!isPaged(node, i) || own > seconds) continue;
        if (own != 0.0 && seconds != 0.0) {
            ownValues(node);
            node.setUserValue(keyOf(i), own);
        }
        node.setMinimumExpiryTime(i, seconds);
    }
}

void restoreExpiry(osg::PagedLOD& node, double seconds) {
    for (unsigned int i = 0; i < node.getNumMinimumExpiryTimes(); ++i) {
        if (!isPaged(node, i) || node.getMinimumExpiryTime(i) != seconds) continue;
        double own = 0.0;
        node.getUserValue(keyOf(i), own);
        node.setMinimumExpiryTime(i, own);
        forget(node, keyOf(i));
    }
}

}  // namespace osgAnalyticBin
