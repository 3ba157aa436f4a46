// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TextProperty.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

using osgAnalyticBin::AnalyticBinCullCallback;

OSGANALYTICBIN_TEXT_PROPERTY(AnalyticBinCullCallback, Options)
OSGANALYTICBIN_TEXT_PROPERTY(AnalyticBinCullCallback, Radii)
OSGANALYTICBIN_TEXT_PROPERTY(AnalyticBinCullCallback, LocalToEcef)
OSGANALYTICBIN_TEXT_PROPERTY(AnalyticBinCullCallback, Bin)

REGISTER_OBJECT_WRAPPER(osgAnalyticBin_AnalyticBinCullCallback, new osgAnalyticBin::AnalyticBinCullCallback,
                        osgAnalyticBin::AnalyticBinCullCallback,
                        "osg::Object osg::Callback osg::NodeCallback osgAnalyticBin::AnalyticBinCullCallback") {
    ADD_USER_SERIALIZER(Options);
    ADD_USER_SERIALIZER(Radii);
    ADD_USER_SERIALIZER(LocalToEcef);
    ADD_USER_SERIALIZER(Bin);
}
