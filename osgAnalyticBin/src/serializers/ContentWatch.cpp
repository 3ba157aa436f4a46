// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../node/ContentWatch.h"

#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>

// A scene that is saved with bins keeps the object, without what it knew.
REGISTER_OBJECT_WRAPPER(osgAnalyticBin_ContentWatch, new osgAnalyticBin::ContentWatch, osgAnalyticBin::ContentWatch,
                        "osg::Object osg::ComputeBoundingSphereCallback osgAnalyticBin::ContentWatch") {}
