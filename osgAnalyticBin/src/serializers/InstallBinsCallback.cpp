// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TextProperty.h"

#include <osgAnalyticBin/InstallBinsCallback.h>

using osgAnalyticBin::InstallBinsCallback;

OSGANALYTICBIN_TEXT_PROPERTY(InstallBinsCallback, Options)

REGISTER_OBJECT_WRAPPER(osgAnalyticBin_InstallBinsCallback, new osgAnalyticBin::InstallBinsCallback,
                        osgAnalyticBin::InstallBinsCallback,
                        "osg::Object osg::Callback osg::NodeCallback osgAnalyticBin::InstallBinsCallback") {
    ADD_USER_SERIALIZER(Options);
}
