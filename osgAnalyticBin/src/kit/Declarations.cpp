// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/Declarations.h>

#include <osg/NodeCallback>
#include <osg/UserDataContainer>
#include <osg/ValueObject>

#include <typeinfo>

namespace osgAnalyticBin {

namespace {

constexpr const char* kTraversesAlways = "osgAnalyticBin.traversesAlways";
constexpr const char* kDrawsAsCullVisitor = "osgAnalyticBin.drawsAsCullVisitor";
constexpr const char* kDrawsTriangles = "osgAnalyticBin.drawsTriangles";
constexpr const char* kPhotogrammetrySet = "osgAnalyticBin.photogrammetrySet";

}  // namespace

void setTraversesAlways(osg::Callback& callback, bool always) {
    callback.setUserValue(kTraversesAlways, always);
}

bool traversesAlways(const osg::Callback& callback) {
    bool does = typeid(callback) == typeid(osg::NodeCallback);
    if (!does && callback.getUserDataContainer()) (void)callback.getUserValue(kTraversesAlways, does);
    return does;
}

void setDrawsTriangles(osg::Program& program) {
    program.setUserValue(kDrawsTriangles, true);
}

bool drawsTriangles(const osg::Program& program) {
    bool does = false;
    if (program.getUserDataContainer()) (void)program.getUserValue(kDrawsTriangles, does);
    return does;
}

void setDrawsAsCullVisitor(osg::NodeVisitor& visitor) {
    visitor.setUserValue(kDrawsAsCullVisitor, true);
}

bool drawsAsCullVisitor(const osg::NodeVisitor& visitor) {
    bool does = false;
    if (visitor.getUserDataContainer()) (void)visitor.getUserValue(kDrawsAsCullVisitor, does);
    return does;
}

void markPhotogrammetrySet(osg::Group& set) {
    set.setUserValue(kPhotogrammetrySet, true);
}

bool isPhotogrammetrySet(const osg::Node& node) {
    const osg::UserDataContainer* const values = node.getUserDataContainer();
    return values && node.asGroup() && values->getUserObject(kPhotogrammetrySet);
}

}  // namespace osgAnalyticBin
