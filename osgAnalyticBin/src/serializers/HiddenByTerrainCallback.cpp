// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/HiddenByTerrainCallback.h>

#include <osgDB/ObjectWrapper>

REGISTER_OBJECT_WRAPPER(osgAnalyticBin_HiddenByTerrainCallback, new osgAnalyticBin::HiddenByTerrainCallback,
                        osgAnalyticBin::HiddenByTerrainCallback,
                        "osg::Object osg::Callback osg::NodeCallback osgAnalyticBin::HiddenByTerrainCallback") {}
