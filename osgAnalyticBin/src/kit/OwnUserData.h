// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Object>
#include <osg/UserDataContainer>
#include <osg/ref_ptr>

namespace osgAnalyticBin {

/// Gives an object that shares its user data, as clones do, a copy of its own.
inline void ownUserData(osg::Object& object) {
    const osg::UserDataContainer* const shared = object.getUserDataContainer();
    if (!shared || shared->referenceCount() == 1) return;
    const osg::ref_ptr<osg::UserDataContainer> own = osg::clone(shared, osg::CopyOp::SHALLOW_COPY);
    object.setUserDataContainer(own);
}

}  // namespace osgAnalyticBin
