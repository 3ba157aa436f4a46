// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/Export.h>

#include <osg/CoordinateSystemNode>
#include <osg/Matrixd>
#include <osg/NodeVisitor>
#include <osgDB/Options>

#include <cstddef>
#include <map>

namespace osgAnalyticBin {

/// Puts AnalyticBinCullCallbacks on the tiles of a geocentric database, switches OSG's sphere test off on them and
/// below (drawables keep their boxes), and arranges that tiles that the DatabasePager loads later are treated in the
/// pager's thread. A tile is a node with a stored bin; where a PagedLOD has none, its bin is found from its own
/// geometry and a range of altitudes that terrain on earth does not leave. Everything else is left as it is. Transforms
/// between the CoordinateSystemNode (or, without one, the start) and a tile are followed; below one that is declared
/// DYNAMIC or has an update callback nothing is installed. Method::Sphere installs nothing. Running it again replaces
/// what it installed before.
class OSGANALYTICBIN_EXPORT BinInstaller : public osg::NodeVisitor {
public:
    explicit BinInstaller(const CullOptions& options = {});
    ~BinInstaller() override;

    META_NodeVisitor(osgAnalyticBin, BinInstaller)

        /// For a subgraph that stands in a known frame: the tiles of a file that the pager has read.
        void setFrame(const osg::EllipsoidModel* ellipsoid, const osg::Matrixd& localToEcef);

    /// Number of callbacks installed so far.
    [[nodiscard]] std::size_t installed() const { return _installed; }

    void apply(osg::Node& node) override;
    void apply(osg::CoordinateSystemNode& node) override;
    void apply(osg::Transform& node) override;
    void apply(osg::PagedLOD& node) override;
    void apply(osg::Drawable& drawable) override;

private:
    // The options that PagedLODs came with (null: none), and those that they get for it.
    using PagingOptions = std::map<osg::ref_ptr<osgDB::Options>, osg::ref_ptr<osgDB::Options>>;

    void treatTile(osg::Node& node, const AnalyticBin& bin);
    void treatOther(osg::Node& node);
    void traverseChildren(osg::Node& node);
    void followPaging(osg::PagedLOD& node);
    [[nodiscard]] AnalyticBin boundsOfOwnGeometry(osg::PagedLOD& node) const;

    CullOptions _options;
    osg::ref_ptr<const osg::EllipsoidModel> _ellipsoid;  // null outside of any CoordinateSystemNode
    osg::Matrixd _localToEcef;
    PagingOptions _pagingOptions;
    bool _insideTile = false;  // below a tile that has, or had, a callback
    std::size_t _installed = 0;
};

/// Installs bins below the node. Returns: the number of callbacks installed.
OSGANALYTICBIN_EXPORT std::size_t installBins(osg::Node& node, const CullOptions& options = {});

}  // namespace osgAnalyticBin
