// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ForeignTraversal.h"

#include <osgUtil/PositionalStateContainer>
#include <osgUtil/RenderLeaf>
#include <osgUtil/StateGraph>

#include <cstddef>
#include <map>

namespace osgAnalyticBin {

namespace {

using AttributeList = osgUtil::PositionalStateContainer::AttrMatrixList;

// Moves the drawables that the other view collected to the visitor's own view.
class Mover {
public:
    Mover(osgUtil::CullVisitor& visitor, const CullingView& other, const osg::RefMatrix* otherProjection)
        : _visitor(visitor),
          _otherProjection(otherProjection),
          _otherToOwn(osg::Matrixd::inverse(other.view) * *visitor.getModelViewMatrix()) {}

    void moveLeaves(osgUtil::StateGraph& graph) {
        for (const auto& leaf : graph._leaves) moveLeaf(*leaf);
        for (const auto& child : graph._children) moveLeaves(*child.second);
    }

    void moveAttributes(AttributeList& attributes, std::size_t first) {
        for (std::size_t i = first; i < attributes.size(); ++i) {
            if (attributes[i].second) attributes[i].second = moved(*attributes[i].second);
        }
    }

private:
    void moveLeaf(osgUtil::RenderLeaf& leaf) {
        // cameras inside the scene have projections of their own
        if (leaf._projection != _otherProjection || !leaf._modelview) return;
        leaf._projection = _visitor.getProjectionMatrix();
        leaf._modelview = moved(*leaf._modelview);
        if (_visitor.getComputeNearFarMode() == osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR) return;
        // the visitor finds the nearest corner of a box by the matrix that was pushed last
        _visitor.pushModelViewMatrix(leaf._modelview.get(), osg::Transform::RELATIVE_RF);
        (void)_visitor.updateCalculatedNearFar(*leaf._modelview, leaf.getDrawable()->getBoundingBox());
        _visitor.popModelViewMatrix();
    }

    osg::RefMatrix* moved(osg::RefMatrix& matrix) {
        osg::ref_ptr<osg::RefMatrix>& known = _moved[&matrix];
        if (!known) known = new osg::RefMatrix(matrix * _otherToOwn);
        return known.get();
    }

    osgUtil::CullVisitor& _visitor;
    const osg::RefMatrix* const _otherProjection;
    const osg::Matrixd _otherToOwn;
    std::map<osg::ref_ptr<osg::RefMatrix>, osg::ref_ptr<osg::RefMatrix>> _moved;
};

}  // namespace

void traverseBy(const CullingView& view, osgUtil::CullVisitor& visitor, const std::function<void()>& traverse) {
    const osg::ref_ptr<osg::RefMatrix> projection = new osg::RefMatrix(view.projection);
    const osg::ref_ptr<osg::RefMatrix> modelView = new osg::RefMatrix(view.view);
    const osg::ref_ptr<osg::Viewport> viewport = view.viewport ? view.viewport.get() : visitor.getViewport();
    osgUtil::PositionalStateContainer& state = *visitor.getRenderStage()->getPositionalStateContainer();
    AttributeList& attributes = state.getAttrMatrixList();
    const std::size_t firstAttribute = attributes.size();
    std::map<unsigned int, std::size_t> firstTextureAttributes;
    for (const auto& [unit, list] : state.getTexUnitAttrMatrixListMap()) firstTextureAttributes[unit] = list.size();
    const auto nearPlane = visitor.getCalculatedNearPlane();
    const auto farPlane = visitor.getCalculatedFarPlane();

    visitor.pushViewport(viewport);
    visitor.pushProjectionMatrix(projection);
    visitor.pushModelViewMatrix(modelView, osg::Transform::ABSOLUTE_RF);
    traverse();
    visitor.popModelViewMatrix();
    visitor.popProjectionMatrix();
    visitor.popViewport();

    visitor.setCalculatedNearPlane(nearPlane);
    visitor.setCalculatedFarPlane(farPlane);
    Mover mover(visitor, view, projection);
    mover.moveLeaves(*visitor.getRootStateGraph());
    mover.moveAttributes(attributes, firstAttribute);
    for (auto& [unit, list] : state.getTexUnitAttrMatrixListMap()) {
        mover.moveAttributes(list, firstTextureAttributes[unit]);
    }
}

}  // namespace osgAnalyticBin
