// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../install/InstalledTile.h"
#include "CullTraversal.h"
#include "PlanarBin.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/CullOptions.h>

#include <osg/NodeCallback>

#include <optional>

namespace osgAnalyticBin {

/// The cull callback of a tile of a map. It culls as AnalyticBinCullCallback does, without a horizon. It says of itself
/// that it is a plain osg::NodeCallback: a scene that is saved holds nothing of it.
/// Guarantee: a tile is never culled if a point of its bin is inside all planes; tests: PlanarDatabase.*.
/// Threads: run() changes nothing in the callback.
class PlanarBinCullCallback final : public osg::NodeCallback {
public:
    /// `shape`: what the bin is for; while the database is shown in another the tile is never culled. nullopt: a mesh
    /// that no Terrain shapes.
    PlanarBinCullCallback(const PlanarBin& bin, const std::optional<TerrainShape>& shape, const CullOptions& options)
        : _bin(bin), _sphere(bin.boundingSphere()), _shape(shape), _options(options) {}

    /// A copy culls nothing, as that of an AnalyticBinCullCallback.
    PlanarBinCullCallback(const PlanarBinCullCallback& other, const osg::CopyOp& copyop);
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new PlanarBinCullCallback(*this, copyop); }

    [[nodiscard]] const CullOptions& getCullOptions() const { return _options; }
    [[nodiscard]] const PlanarBin& getBin() const { return _bin; }

    /// See AnalyticBinCullCallback::getInstalledTile().
    [[nodiscard]] InstalledTile* getInstalledTile() const { return _installed.get(); }
    void setInstalledTile(InstalledTile* tile) { _installed = tile; }

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

protected:
    ~PlanarBinCullCallback() override = default;

private:
    [[nodiscard]] bool isCulled(const osg::Node& node, osg::CullStack& cullStack, osg::NodeVisitor& nv) const;

    osg::ref_ptr<InstalledTile> _installed;
    const PlanarBin _bin;
    const osg::BoundingSphere _sphere;
    const std::optional<TerrainShape> _shape;
    const CullOptions _options;
};

}  // namespace osgAnalyticBin
