// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Group>
#include <osg/Node>

namespace osgAnalyticBin {

/// A group that the kit puts above a tile to hold the tile's callback. Its class name is that of a plain osg::Group: it
/// is saved as one.
class Carrier final : public osg::Group {
public:
    Carrier() = default;
    Carrier(const Carrier& other, const osg::CopyOp& copyop) : osg::Group(other, copyop) {}
    osg::Object* cloneType() const override { return new Carrier; }
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new Carrier(*this, copyop); }

protected:
    ~Carrier() override = default;
};

/// The carrier above a node. Returns: nullptr when there is none.
[[nodiscard]] inline Carrier* carrierOf(osg::Node& node) {
    return node.getNumParents() == 1 ? dynamic_cast<Carrier*>(node.getParent(0)) : nullptr;
}

}  // namespace osgAnalyticBin
