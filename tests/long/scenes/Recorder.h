// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What a cull traversal delivers, and which files it asks for.

#pragma once

#include "Painter.h"

namespace osgAnalyticBin::test {

/// A drawable at one place in the scene, that a cull traversal delivered.
struct Delivered {
    std::string camera;  ///< names of the cameras in the scene that it is drawn by
    osg::ref_ptr<const osg::Drawable> drawable;
    osg::Matrixd modelView;
    osg::ref_ptr<const osg::RefMatrix> projection;  ///< after the traversal, with its near and far planes
    osg::Matrixd givenProjection;                   ///< before
    bool isFilled = true;                           ///< whether its polygons are
    bool isPlain = true;                            ///< whether it is drawn where it is, and hides what is behind
    bool isCountedCulled = false;                   ///< whether a bin on it was counted as culled all the same
};

/// A database that a cull traversal met.
struct MetDatabase {
    int number = 0;
    std::string camera;
    osg::Matrixd modelView;
};

/// What one cull traversal delivers.
struct Delivery {
    /// By names of nodes on the way to the drawable: nodes that the kit puts in have none.
    std::map<std::string, Delivered> drawables;
    std::vector<MetDatabase> databases;
    osg::Matrixd projection;         ///< of the view, with its near and far planes
    bool arePlanesComputed = false;  ///< by OSG
    /// Where there is a painter.
    Painting painting;
};

/// A PagedLOD by its name, and the file that it pages.
using Request = std::pair<std::string, std::string>;

/// Notes the files that a cull traversal asks for. Applications expect a DatabasePager.
class Requests : public osgDB::DatabasePager {
public:
    void requestNodeFile(const std::string& fileName, osg::NodePath& path, float priority, const osg::FrameStamp* stamp,
                         osg::ref_ptr<osg::Referenced>& request, const osg::Referenced* options) override;

    std::set<Request> files;
};

/// A cull visitor that notes what it delivers.
class Recorder : public osgUtil::CullVisitor {
public:
    Recorder();

    using osgUtil::CullVisitor::apply;
    void apply(osg::Drawable& drawable) override;
    void apply(osg::Billboard& node) override;
    void apply(osg::CoordinateSystemNode& node) override;
    void apply(osg::Group& node) override { enter(node); }
    void apply(osg::Transform& node) override { enter(node); }
    void apply(osg::LOD& node) override { enter(node); }
    void apply(osg::Geode& node) override { enter(node); }

    /// Has drawables drawn in the painter's colours, by their keys in the delivery. nullptr: as they are.
    void setPainter(Painter* painter) { _painter = painter; }

    [[nodiscard]] Delivery takeDelivery() { return std::exchange(_delivery, {}); }
    [[nodiscard]] std::set<Request> takeRequests() { return std::exchange(_requests->files, {}); }

    /// Names of nodes that this visitor does not enter.
    std::set<std::string> leftOut;
    /// Whether states that are pushed above the scene let it be drawn where it is.
    bool isViewPlain = true;

private:
    template <class NodeType>
    void enter(NodeType& node) {
        if (leftOut.empty() || leftOut.count(node.getName()) == 0) osgUtil::CullVisitor::apply(node);
    }
    /// What is in force at the end of the path.
    struct States {
        bool isPlain = true;
        bool hasProgram = false;
    };
    [[nodiscard]] States states(const osg::StateSet* own);

    void deliver(std::string key, const osg::Drawable& drawable, const osg::Matrixd& modelView, bool isPlain,
                 bool isCountedCulled);

    // For what is at the end of the path: a key that no drawable has yet.
    [[nodiscard]] std::string newKey() const;

    const osg::ref_ptr<Requests> _requests = new Requests;
    Delivery _delivery;
    Painter* _painter = nullptr;
};

}  // namespace osgAnalyticBin::test
