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

// Without values nothing is looked up: that would make a string of the name each time.
bool isDeclared(const osg::Object& object, const char* name) {
    bool is = false;
    if (object.getUserDataContainer()) (void)object.getUserValue(name, is);
    return is;
}

}  // namespace

void setTraversesAlways(osg::Callback& callback, bool always) {
    callback.setUserValue(kTraversesAlways, always);
}

bool traversesAlways(const osg::Callback& callback) {
    return typeid(callback) == typeid(osg::NodeCallback) || isDeclared(callback, kTraversesAlways);
}

void setDrawsTriangles(osg::Program& program) {
    program.setUserValue(kDrawsTriangles, true);
}

bool drawsTriangles(const osg::Program& program) {
    return isDeclared(program, kDrawsTriangles);
}

void setDrawsAsCullVisitor(osg::NodeVisitor& visitor) {
    visitor.setUserValue(kDrawsAsCullVisitor, true);
}

bool drawsAsCullVisitor(const osg::NodeVisitor& visitor) {
    return isDeclared(visitor, kDrawsAsCullVisitor);
}

void markPhotogrammetrySet(osg::Group& set) {
    set.setUserValue(kPhotogrammetrySet, true);
}

bool isPhotogrammetrySet(const osg::Node& node) {
    const osg::UserDataContainer* const values = node.getUserDataContainer();
    return values && node.asGroup() && values->getUserObject(kPhotogrammetrySet);
}

}  // namespace osgAnalyticBin
