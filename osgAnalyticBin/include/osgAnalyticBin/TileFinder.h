// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>

#include <osg/CoordinateSystemNode>
#include <osg/Matrixd>
#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <osg/Transform>

#include <cstddef>
#include <string>
#include <vector>

namespace osgAnalyticBin {

/// The coordinate frame of a file's content, and the file that it comes from.
struct TileFrame {
    /// mapPlane() for a tile in a map. Null where there is neither a globe above nor a stored bin, and for a tile
    /// without a stored bin of which it is not known whether it is on a globe or in a map.
    osg::ref_ptr<const osg::EllipsoidModel> ellipsoid;
    osg::Matrixd localToEcef;  ///< in a map: to the map
    /// Whether the coordinate system's text names a map projection. Without an ellipsoid, the tiles are in that map;
    /// with one, their meshes decide.
    bool isProjected = false;
    /// The file that the content was read from: its path relative to the folder of the database's root file, "" for the
    /// root file itself.
    std::string file;
    bool isBelowTile = false;  ///< Whether the file is paged below a tile: then plain meshes in it are leaf tiles.

    /// Whether the frame is that of a globe or of a map.
    [[nodiscard]] bool isKnown() const { return ellipsoid || isProjected; }
};

/// A tile: a node with a stored bin (no drawable), a PagedLOD with a mesh of its own, an osgTerrain tile, or a mesh
/// beside them.
struct FoundTile {
    osg::ref_ptr<osg::Node> node;                 ///< the node that is culled
    std::vector<osg::ref_ptr<osg::Node>> meshes;  ///< what it draws itself: children that are not paged, or the node
    TileFrame frame;                              ///< the frame of `node`; its file is the one that `node` is in
    std::size_t ordinal = 0;                      ///< number of tiles before it in that file
    /// The files that are paged below it, as paths relative to the folder of the root file.
    std::vector<std::string> pagedFiles;
};

/// "a/b.osgb" and "../c/d.osgb" make "c/d.osgb": the path of a file as its referring file names it. A path that
/// leaves the folder starts with ".."; one that has a server address or is absolute stays as it is.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::string pagedFilePath(const std::string& referringFile,
                                                              const std::string& name);

/// Whether an ellipsoid's radii, metres, are finite and positive. A CoordinateSystemNode with other radii is not
/// treated as a globe, and the nodes below it are not its tiles.
[[nodiscard]] OSGANALYTICBIN_EXPORT bool hasValidRadii(const osg::EllipsoidModel& ellipsoid);
/// The same test for two radii.
[[nodiscard]] OSGANALYTICBIN_EXPORT bool areValidRadii(double equatorial, double polar);

/// The model that represents the plane of a map, like core::Ellipsoid::plane(): both radii are infinite.
[[nodiscard]] OSGANALYTICBIN_EXPORT const osg::EllipsoidModel* mapPlane();
/// Whether the model stands for a map, where positions have no altitudes above a globe.
[[nodiscard]] OSGANALYTICBIN_EXPORT bool isMapPlane(const osg::EllipsoidModel& ellipsoid);

/// The frame of the children of a transform that is in `frame`.
[[nodiscard]] OSGANALYTICBIN_EXPORT osg::Matrixd frameInside(const osg::Transform& node, const TileFrame& frame);

/// Visits the tiles of a scene graph in preorder, always in the same order. It changes nothing and does not traverse
/// osgTerrain tiles. It does not go below transforms that may move.
class OSGANALYTICBIN_EXPORT TileFinder : public osg::NodeVisitor {
public:
    /// Starts in this frame. Use it for a file that is paged below a known database.
    explicit TileFinder(const TileFrame& frame = {});

    /// Visits a node; called by OSG's traversal.
    void apply(osg::Node& node) override;
    /// Enters a globe or a map.
    void apply(osg::CoordinateSystemNode& node) override;
    /// Enters another frame, unless it may move.
    void apply(osg::Transform& node) override;
    /// Tells whether it is a tile, and numbers the files paged below it.
    void apply(osg::PagedLOD& node) override;

protected:
    /// Called for each tile. The default visits the nodes below it.
    virtual void visitTile(FoundTile& tile) { traverseBelow(*tile.node); }

    /// Called for every other node. The default visits the nodes below it.
    virtual void visitOther(osg::Node& node) { traverseBelow(node); }

    /// Called for a node below too many nested tiles and PagedLODs (a paged tile counts twice). The node and all below
    /// it are skipped, so that the recursion ends before the stack overflows; real databases are not nested so deep.
    virtual void visitTooDeep(osg::Node&) {}
    /// The depth of nesting at which the search ends, counted in tiles and PagedLODs on one path.
    static constexpr int kDeepest = 400;

    /// Called for a transform that may move. It is skipped, with all below it.
    virtual void visitMoving(osg::Transform&) {}

    /// Visits the children. Paged children are visited as content of their own files.
    void traverseBelow(osg::Node& node);

    /// The frame of the node that is being visited.
    [[nodiscard]] const TileFrame& frame() const { return _frame; }
    /// The frame of a CoordinateSystemNode's children, where that is visited.
    [[nodiscard]] TileFrame frameInside(const osg::CoordinateSystemNode& node) const;
    /// Changes the frame for all nodes that are visited from then on.
    void setFrame(const TileFrame& frame) { _frame = frame; }

private:
    void visit(osg::Node& node, bool isTile);
    void traverseTransform(osg::Transform& node);
    void traversePaged(osg::PagedLOD& node);
    [[nodiscard]] bool isTile(osg::Node& node) const;

    TileFrame _frame;
    std::size_t _ordinal = 0;
    const osg::Node* _tile = nullptr;  // the tile being visited
    int _depth = 0;                    // of tiles and PagedLODs
};

/// The tiles below a node.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::vector<FoundTile> findTiles(osg::Node& node, const TileFrame& frame = {});

}  // namespace osgAnalyticBin
