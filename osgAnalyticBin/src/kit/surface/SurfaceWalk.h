// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Matrixd>
#include <osg/NodeVisitor>
#include <osgTerrain/TerrainTile>

namespace osgAnalyticBin {

/// Whether a transform stays as it is once it is loaded; others, and those of an application's class, which may turn to
/// the eye, have no fixed place on the globe.
[[nodiscard]] bool hasFixedPlace(const osg::Transform& node);

/// Whether a group of an unknown class has another bound than that of its children: it may draw within it besides them,
/// as osgVolume::VolumeTile does.
[[nodiscard]] bool drawsBesideChildren(const osg::Node& node);

/// Whether a node may draw something that its children do not: such a group, or a node without children, as drawables
/// and osgSim::LightPointNode are.
[[nodiscard]] bool drawsByItself(const osg::Node& node);

/// Visits what one tile draws: terrain tiles, which are not traversed, and drawables, with the frame in which they
/// stand. Masks, ranges and switches are passed over.
class SurfaceWalk : public osg::NodeVisitor {
public:
    explicit SurfaceWalk(const osg::Matrixd& localToEcef);

    void apply(osg::Node& node) override;
    void apply(osg::Billboard& node) override;
    void apply(osg::ProxyNode& node) override;
    void apply(osg::PagedLOD& node) override;
    void apply(osg::Transform& node) override;
    void apply(osg::Drawable& drawable) override;

protected:
    virtual void visit(osgTerrain::TerrainTile& tile) = 0;
    virtual void visit(osg::Drawable& drawable) = 0;
    /// Its drawables turn to the eye, each about its own position. By default: giveUp().
    virtual void visitBillboard(osg::Billboard& node);
    /// It may draw anything within its bound besides its children, as osgSim::LightPointNode, which has none. By
    /// default: giveUp().
    virtual void visitUnknown(osg::Node& node);

    [[nodiscard]] const osg::Matrixd& localToEcef() const { return _localToEcef; }

    /// What the tile draws cannot be told: the walk goes no further.
    void giveUp() { _isKnown = false; }
    [[nodiscard]] bool isKnown() const { return _isKnown; }

private:
    osg::Matrixd _localToEcef;
    bool _isKnown;
};

}  // namespace osgAnalyticBin
