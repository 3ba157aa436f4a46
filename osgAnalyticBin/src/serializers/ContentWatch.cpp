// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../kit/install/ContentWatch.h"

#undef OBJECT_CAST
#define OBJECT_CAST dynamic_cast

#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>

using osgAnalyticBin::ContentWatch;

// Stores nothing. OSG calls it before it writes the node's cull callback, which has to know what was added meanwhile.
static bool checkContent(const ContentWatch& watch) {
    watch.look();
    return false;
}

static bool readContent(osgDB::InputStream&, ContentWatch&) {
    return true;
}

static bool writeContent(osgDB::OutputStream&, const ContentWatch&) {
    return true;
}

// A scene that is saved with bins keeps the object without its data.
REGISTER_OBJECT_WRAPPER(osgAnalyticBin_ContentWatch, new osgAnalyticBin::ContentWatch, osgAnalyticBin::ContentWatch,
                        "osg::Object osg::ComputeBoundingSphereCallback osgAnalyticBin::ContentWatch") {
    ADD_USER_SERIALIZER(Content);
}
