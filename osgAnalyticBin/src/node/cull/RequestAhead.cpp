// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RequestAhead.h"

#include <osg/Group>
#include <osg/PagedLOD>

#include <string>
#include <typeinfo>

namespace osgAnalyticBin {

namespace {

class LaterRequests : public osg::NodeVisitor::DatabaseRequestHandler {
public:
    explicit LaterRequests(DatabaseRequestHandler& pager) : _pager(&pager) {}

    // priorities are from 0 to 1 unless a database changes them
    void requestNodeFile(const std::string& file, osg::NodePath& path, float priority, const osg::FrameStamp* stamp,
                         osg::ref_ptr<osg::Referenced>& request, const osg::Referenced* options) override {
        _pager->requestNodeFile(file, path, priority - 1.0F, stamp, request, options);
    }

private:
    const osg::ref_ptr<DatabaseRequestHandler> _pager;
};

class RequestVisitor : public osg::NodeVisitor {
public:
    explicit RequestVisitor(osg::NodeVisitor& cullVisitor)
        : osg::NodeVisitor(CULL_VISITOR, TRAVERSE_ACTIVE_CHILDREN), _cullVisitor(cullVisitor) {
        setFrameStamp(const_cast<osg::FrameStamp*>(cullVisitor.getFrameStamp()));  // it is read alone
        setTraversalNumber(cullVisitor.getTraversalNumber());
        setTraversalMask(cullVisitor.getTraversalMask());
        setNodeMaskOverride(cullVisitor.getNodeMaskOverride());
        setDatabaseRequestHandler(new LaterRequests(*cullVisitor.getDatabaseRequestHandler()));
        getNodePath() = cullVisitor.getNodePath();
    }

    using osg::NodeVisitor::apply;
    void apply(osg::Node&) override {}
    void apply(osg::Group& group) override {
        if (typeid(group) == typeid(osg::Group)) traverse(group);
    }
    void apply(osg::PagedLOD& paged) override {
        if (paged.getRangeMode() == osg::LOD::DISTANCE_FROM_EYE_POINT) traverse(paged);
    }

    float getDistanceToEyePoint(const osg::Vec3& point, bool isScaled) const override {
        return _cullVisitor.getDistanceToEyePoint(point, isScaled);
    }
    float getDistanceToViewPoint(const osg::Vec3& point, bool isScaled) const override {
        return _cullVisitor.getDistanceToViewPoint(point, isScaled);
    }

private:
    const osg::NodeVisitor& _cullVisitor;
};

}  // namespace

void requestAhead(osg::Node& node, osg::NodeVisitor& cullVisitor) {
    if (!cullVisitor.getDatabaseRequestHandler()) return;
    RequestVisitor visitor(cullVisitor);
    osg::NodePath& path = visitor.getNodePath();
    if (!path.empty() && path.back() == &node) path.pop_back();
    node.accept(visitor);
}

}  // namespace osgAnalyticBin
