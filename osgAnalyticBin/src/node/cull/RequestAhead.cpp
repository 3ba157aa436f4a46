// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RequestAhead.h"

#include "../install/TileCallback.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <osg/Camera>
#include <osg/CullStack>
#include <osg/Group>
#include <osg/PagedLOD>
#include <osg/Transform>
#include <osgTerrain/TerrainTile>

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

// What is common to visitors that request files in the place of a cull visitor.
class Requests : public osg::NodeVisitor {
public:
    explicit Requests(osg::NodeVisitor& cullVisitor)
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

    float getDistanceToEyePoint(const osg::Vec3& point, bool isScaled) const override {
        return _cullVisitor.getDistanceToEyePoint(point, isScaled);
    }
    float getDistanceToViewPoint(const osg::Vec3& point, bool isScaled) const override {
        return _cullVisitor.getDistanceToViewPoint(point, isScaled);
    }

protected:
    osg::NodeVisitor& _cullVisitor;
};

class RequestsAhead final : public Requests {
public:
    using Requests::apply;
    using Requests::Requests;
    void apply(osg::Group& group) override {
        if (typeid(group) == typeid(osg::Group)) traverse(group);
    }
    void apply(osg::PagedLOD& paged) override {
        if (paged.getRangeMode() == osg::LOD::DISTANCE_FROM_EYE_POINT) traverse(paged);
    }
};

// Whether OSG would cull a node by its sphere.
bool isSphereCulled(osg::CullStack& cullStack, const osg::Node& node) {
    osg::CullingSet& cullingSet = cullStack.getCurrentCullingSet();
    const osg::Polytope::ClippingMask before = cullingSet.getFrustum().getResultMask();
    const bool isCulled = cullingSet.isCulled(node.getBound());
    cullingSet.getFrustum().setResultMask(before);
    return isCulled;
}

class RequestsOutOfView final : public Requests {
public:
    // `entered`: the node whose frame the cull visitor is in already; null: it is at the parent.
    RequestsOutOfView(osg::NodeVisitor& cullVisitor, const core::HorizonEye* eye, const osg::Node* entered)
        : Requests(cullVisitor), _eye(eye), _entered(entered) {}

    // PagedLODs that choose by pixels ask it
    osg::CullStack* asCullStack() override { return _cullVisitor.asCullStack(); }

    using Requests::apply;
    void apply(osg::Group& group) override {
        if (!dynamic_cast<osgTerrain::TerrainTile*>(&group) && isAsking(group)) traverse(group);
    }
    void apply(osg::Transform& transform) override {
        if (&transform == _entered) return traverse(transform);
        if (!isAsking(transform)) return;
        osg::CullStack& stack = *asCullStack();
        const osg::ref_ptr<osg::RefMatrix> matrix = new osg::RefMatrix(*stack.getModelViewMatrix());
        transform.computeLocalToWorldMatrix(*matrix, this);
        stack.pushModelViewMatrix(matrix, transform.getReferenceFrame());
        traverse(transform);
        stack.popModelViewMatrix();
    }
    // it has another eye
    void apply(osg::Camera&) override {}

private:
    // A node is passed over where OSG's sphere culls it, and a tile where nothing unknown in view is below it.
    [[nodiscard]] bool isAsking(const osg::Node& node) {
        const AnalyticBinCullCallback* const tile = installedBinOf(node);
        if (tile && !tile->mayRequestBelow(_eye)) return false;
        return !isSphereCulled(*asCullStack(), node);
    }

    const core::HorizonEye* const _eye;
    const osg::Node* const _entered;
};

bool isAt(const osg::Node& node, const osg::NodeVisitor& visitor) {
    const osg::NodePath& path = visitor.getNodePath();
    return !path.empty() && path.back() == &node;
}

void request(osg::Node& node, Requests& requests) {
    if (isAt(node, requests)) requests.getNodePath().pop_back();
    node.accept(requests);
}

}  // namespace

void requestAhead(osg::Node& node, osg::NodeVisitor& cullVisitor) {
    if (!cullVisitor.getDatabaseRequestHandler()) return;
    RequestsAhead requests(cullVisitor);
    request(node, requests);
}

void requestOutOfView(osg::Node& node, osg::NodeVisitor& cullVisitor, const core::HorizonEye* eye) {
    if (!cullVisitor.getDatabaseRequestHandler() || !cullVisitor.asCullStack()) return;
    const bool isEntered = isAt(node, cullVisitor);
    // a visitor takes longer to make than a sphere to test
    if (!isEntered && isSphereCulled(*cullVisitor.asCullStack(), node)) return;
    RequestsOutOfView requests(cullVisitor, eye, isEntered ? &node : nullptr);
    request(node, requests);
}

}  // namespace osgAnalyticBin
