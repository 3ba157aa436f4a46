// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "LodContent.h"

#include "../Classes.h"
#include "../PagedChildren.h"
#include "../Scoped.h"
#include "SurfaceMesh.h"
#include "SurfaceWalk.h"

#include <osg/Geode>
#include <osg/PagedLOD>
#include <osg/Switch>

namespace osgAnalyticBin {

namespace {

bool staysInPlace(osg::Node& node) {
    return !node.getUpdateCallback() && !node.getComputeBoundingSphereCallback();
}

// No real file is deeper; the recursion must end before the stack overflows.
constexpr int kDeepest = 1000;

class LodFinder {
public:
    void visit(osg::Node& node) {
        const Scoped depth(_depth, _depth + 1);
        if (_depth > kDeepest || !staysInPlace(node)) return add(MeshBox::boundless());
        if (osg::Drawable* const drawable = node.asDrawable()) return add(boxOf(*drawable));
        if (isOneOf<osg::LOD, osg::PagedLOD>(node)) return visitLod(static_cast<osg::LOD&>(node));
        osg::Transform* const transform = node.asTransform();
        if (transform && hasFixedPlace(*transform)) return visitTransform(*transform);
        if (!isOneOf<osg::Group, osg::Geode, osg::Switch>(node)) return add(MeshBox::boundless());
        if (isOneOf<osg::Group>(node)) content.groups.push_back({node.asGroup(), _lod});
        visitChildren(*node.asGroup());
    }

    LodContent content;

private:
    static MeshBox boxOf(osg::Drawable& drawable) {
        if (!isDrawnByItsVertices(drawable)) return MeshBox::boundless();
        // an initial bound makes it larger, at most
        return MeshBox(drawable.getBoundingBox());
    }

    void add(const MeshBox& box) {
        const MeshBox here = _toFrame ? box.moved(*_toFrame) : box;
        (_lod ? content.lods[*_lod].own : content.beside).expandBy(here);
    }

    void visitChildren(osg::Group& group) {
        for (unsigned int i = 0; i < group.getNumChildren(); ++i) visit(*group.getChild(i));
    }

    void visitLod(osg::LOD& node) {
        if (_toFrame) return add(MeshBox::boundless());
        const Scoped lod(_lod, std::optional(content.lods.size()));
        content.lods.push_back({&node, _parent, {}});
        const Scoped parent(_parent, _lod);
        for (unsigned int i = 0; i < node.getNumChildren(); ++i) {
            if (!isPagedChildOf(node, i)) visit(*node.getChild(i));
        }
    }

    void visitTransform(osg::Transform& node) {
        osg::Matrixd matrix = _toFrame.value_or(osg::Matrixd());
        node.computeLocalToWorldMatrix(matrix, nullptr);
        const Scoped toFrame(_toFrame, std::optional(matrix));
        visitChildren(node);
    }

    std::optional<osg::Matrixd> _toFrame;
    std::optional<std::size_t> _lod, _parent;
    int _depth = 0;
};

}  // namespace

std::vector<MeshBox> LodContent::boxes(const std::vector<MeshBox>& below) const {
    std::vector<MeshBox> boxes(lods.size());
    // children stand behind their parents
    for (std::size_t i = lods.size(); i-- > 0;) {
        boxes[i].expandBy(lods[i].own);
        boxes[i].expandBy(below[i]);
        if (lods[i].parent) boxes[*lods[i].parent].expandBy(boxes[i]);
    }
    return boxes;
}

MeshBox LodContent::all(const std::vector<MeshBox>& boxes) const {
    MeshBox all = beside;
    for (std::size_t i = 0; i < lods.size(); ++i) {
        if (!lods[i].parent) all.expandBy(boxes[i]);
    }
    return all;
}

LodContent findLods(osg::Node& node) {
    LodFinder finder;
    finder.visit(node);
    return std::move(finder.content);
}

bool isPagedChildOf(const osg::LOD& node, unsigned int child) {
    const auto* const paged = dynamic_cast<const osg::PagedLOD*>(&node);
    return paged && isPaged(*paged, child);
}

}  // namespace osgAnalyticBin
