// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PagingExpiry.h"

#include "../OwnUserData.h"
#include "../PagedChildren.h"

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

// Removes user data if they are empty without our last value.
void forgetEmptyValues(osg::Node& node) {
    const osg::UserDataContainer* const values = node.getUserDataContainer();
    const bool isEmpty =
        values && values->getNumUserObjects() == 0 && !values->getUserData() && values->getNumDescriptions() == 0;
    if (isEmpty) node.setUserDataContainer(nullptr);
}

void forget(osg::PagedLOD& node, const std::string& key) {
    osg::UserDataContainer* values = node.getUserDataContainer();
    if (!values || !values->getUserObject(key)) return;
    ownUserData(node);
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
            ownUserData(node);
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
