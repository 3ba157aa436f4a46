// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/bin/QuadraticBin.h>

#include <osg/BoundingSphere>
#include <osg/NodeCallback>

#include <optional>

namespace osg {
class CullStack;
}

namespace osgAnalyticBin {

/// The cull callback of a node that holds any mapped box: the piece of a pipe, a curved panel, a map tile. It culls as
/// AnalyticBinCullCallback does. It is not stored in files; the application installs it after loading.
/// Leave culling active on the node: OSG's own sphere test runs first, and the bin tests the nodes that pass. With
/// setCullingActive(false) only the bin is tested, and OSG stops testing the groups above the node. This takes up to
/// 2.8 times as long (doc/theory/accuracy.md). Use it only where the sphere does not hold what the node draws, for
/// example with paged children.
/// Frame: the bin is in the frame of the node's children; transforms above the node need nothing.
/// Guarantee: a node is never culled by its bin if a point of the bin is inside all planes;
/// tests: QuadraticBinCullCallback.*.
/// Threads: run() changes nothing in the callback.
/// Cost: no allocation, no trigonometry.
class QuadraticBinCullCallback : public osg::NodeCallback {
public:
    /// Without a bin: never culls.
    QuadraticBinCullCallback() = default;

    /// The sphere is for small-feature culling, and has to hold what the node draws; an invalid one
    /// leaves these out.
    explicit QuadraticBinCullCallback(const core::QuadraticBin& bin,
                                      const osg::BoundingSphere& sphere = osg::BoundingSphere());
    /// A copy, bin included.
    QuadraticBinCullCallback(const QuadraticBinCullCallback& other,
                             const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);

    META_Object(osgAnalyticBin, QuadraticBinCullCallback)

        /// nullopt: never culls.
        [[nodiscard]] const std::optional<core::QuadraticBin>& getBin() const {
        return _bin;
    }

    /// Called by OSG's cull traversal: goes on below the node unless it is culled.
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

protected:
    ~QuadraticBinCullCallback() override;

private:
    [[nodiscard]] bool isCulled(osg::CullStack& cullStack, osg::NodeVisitor& nv) const;

    std::optional<core::QuadraticBin> _bin;
    osg::BoundingSphere _sphere;
};

}  // namespace osgAnalyticBin
