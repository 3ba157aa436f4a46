// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgDB/Callbacks>
#include <osgDB/Registry>

namespace osgAnalyticBin::flight {

/// Puts a callback in front of the Registry's. Must not be called while files are read.
/// Returns: the callback that it has to hand reads on to, never null: a plain one does what the Registry does by
/// itself.
[[nodiscard]] inline osg::ref_ptr<osgDB::ReadFileCallback> readInFront(osgDB::ReadFileCallback& callback) {
    osgDB::Registry& registry = *osgDB::Registry::instance();
    osg::ref_ptr<osgDB::ReadFileCallback> next = registry.getReadFileCallback();
    if (!next) next = new osgDB::ReadFileCallback;
    registry.setReadFileCallback(&callback);
    return next;
}

}  // namespace osgAnalyticBin::flight
