// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RequestAhead.h"

#include "../PerThread.h"
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
    void setPager(DatabaseRequestHandler* pager) { _pager = pager; }

    // priorities are from 0 to 1 unless a database changes them
    void requestNodeFile(const std::string& file, osg::NodePath& path, float priority, const osg::FrameStamp* stamp,
                         osg::ref_ptr<osg::Referenced>& request, const osg::Referenced* options) override {
        _pager->requestNodeFile(file, path, priority - 1.0F, stamp, request, options);
    }

private:
    osg::ref_ptr<DatabaseRequestHandler> _pager;
};

// What is common to visitors that request files in the place of a cull visitor. Each thread has one of each kind: a
// visitor takes longer to make than to ask most tiles.
class Requests : public osg::NodeVisitor {
public:
    Requests() : osg::NodeVisitor(CULL_VISITOR, TRAVERSE_ACTIVE_CHILDREN), _later(new LaterRequests) {
        setDatabaseRequestHandler(_later);
    }

    using osg::NodeVisitor::apply;
    void apply(osg::Node&) override {}

    float getDistanceToEyePoint(const osg::Vec3& point, bool isScaled) const override {
        return _cullVisitor->getDistanceToEyePoint(point, isScaled);
    }
    float getDistanceToViewPoint(const osg::Vec3& point, bool isScaled) const override {
        return _cullVisitor->getDistanceToViewPoint(point, isScaled);
    }

    // `cullVisitor`: at the node, or at its parent.
    void request(osg::Node& node, osg::NodeVisitor& cullVisitor) {
        _cullVisitor = &cullVisitor;
        _later->setPager(cullVisitor.getDatabaseRequestHandler());
        setFrameStamp(const_cast<osg::FrameStamp*>(cullVisitor.getFrameStamp()));  // it is read alone
        setTraversalNumber(cullVisitor.getTraversalNumber());
        setTraversalMask(cullVisitor.getTraversalMask());
        setNodeMaskOverride(cullVisitor.getNodeMaskOverride());
        getNodePath() = cullVisitor.getNodePath();
        if (isAt(node, *this)) getNodePath().pop_back();
        node.accept(*this);
        getNodePath().clear();
        setFrameStamp(nullptr);
        _later->setPager(nullptr);
    }

    [[nodiscard]] static bool isAt(const osg::Node& node, const osg::NodeVisitor& visitor) {
        const osg::NodePath& path = visitor.getNodePath();
        return !path.empty() && path.back() == &node;
    }

protected:
    osg::NodeVisitor* _cullVisitor = nullptr;

private:
    const osg::ref_ptr<LaterRequests> _later;
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
    void setView(const core::HorizonEye* eye, const osg::Node* entered) {
        _eye = eye;
        _entered = entered;
    }

    // PagedLODs that choose by pixels ask it
    osg::CullStack* asCullStack() override { return _cullVisitor->asCullStack(); }

    using Requests::apply;
    void apply(osg::Group& group) override {
        if (isAsking(group) && !dynamic_cast<osgTerrain::TerrainTile*>(&group)) traverse(group);
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

    const core::HorizonEye* _eye = nullptr;
    const osg::Node* _entered = nullptr;
};

}  // namespace

void requestOutOfView(osg::Node& node, osg::NodeVisitor& cullVisitor, const core::HorizonEye* eye) {
    if (!cullVisitor.getDatabaseRequestHandler() || !cullVisitor.asCullStack()) return;
    const bool isEntered = Requests::isAt(node, cullVisitor);
    if (!isEntered && isSphereCulled(*cullVisitor.asCullStack(), node)) return;
    thread_local PerThread<RequestsOutOfView> kept;
    RequestsOutOfView& requests = *kept;
    requests.setView(eye, isEntered ? &node : nullptr);
    requests.request(node, cullVisitor);
}

}  // namespace osgAnalyticBin
