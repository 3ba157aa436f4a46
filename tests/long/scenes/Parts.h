// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What scenes are made of: meshes and models; states that an application may set, attributes and modes of all kinds
// that OpenSceneGraph has, harmless ones too; what an application hangs on its nodes, and nodes of its own; parts that
// are put on, or happen to, a scene that is built already; copies of scenes. What callbacks do depends on the frame
// number alone. They survive osg::clone(), and are saved as plain callbacks that do nothing, and plain groups.

#pragma once

#include "Description.h"

namespace osgAnalyticBin::test {

/// Extents of a tile: radians, in a map metres.
struct Extents {
    double south, north, west, east;
};

[[nodiscard]] Extents extentsOf(const DatabaseSpec& database, const TileKey& tile);

/// The height of a post at vertical scale 1, metres.
[[nodiscard]] double surfaceHeight(const DatabaseSpec& database, double latitude, double longitude);

/// A place in the database's own frame.
[[nodiscard]] osg::Vec3d place(const DatabaseSpec& database, double latitude, double longitude, double altitude);

/// From east, north and up at a place to the database's own frame.
[[nodiscard]] osg::Matrixd localFrame(const DatabaseSpec& database, double latitude, double longitude, double altitude);

/// Turns a globe about its axis, or moves a map to the east.
[[nodiscard]] osg::Matrixd turned(const DatabaseSpec& database, double amount);

/// The depth of chords between the posts of a tile below the surface at most, metres.
[[nodiscard]] double sagOf(const DatabaseSpec& database, int level);

/// What meshes of one tile differ in.
struct MeshShape {
    int posts = 5;
    std::string name = "#";     ///< comes before the tile's key in the names of nodes
    double narrower = 0.0;      ///< this part of the tile is left free, in the east
    bool drawsNothing = false;  ///< not for osgTerrain
};

/// The mesh of a tile. `turn`: the angle by which its frame is turned.
[[nodiscard]] osg::ref_ptr<osg::Node> makeMesh(const DatabaseSpec& database, const TileKey& tile, double turn,
                                               const MeshShape& shape);

/// How many variants of MeshHole there are.
constexpr int kHoles = 5;

/// Alters a mesh as a part of kind MeshHole, ReversedFaces or Raise says.
void alterMesh(const Part& part, const DatabaseSpec& database, double turn, osg::Drawable& drawable);

/// A tower or a vehicle. `toDatabase`: from the frame in which it stands to that of the database.
[[nodiscard]] osg::ref_ptr<osg::Node> makeModel(const DatabaseSpec& database, const Part& part,
                                                const osg::Matrixd& toDatabase);

/// States have the numbers from 0 on.
[[nodiscard]] int stateCount();
[[nodiscard]] std::string stateName(int number);
/// Returns: the number of a name that is there.
[[nodiscard]] int stateOf(const std::string& name);

/// Sets a state. `value`: of its attribute and modes; OFF switches modes off, and sets the attribute all the same.
void setState(int number, osg::StateAttribute::GLModeValue value, osg::StateSet& states);

/// Whether a picture shows the same drawables in the same places whatever these states are.
[[nodiscard]] bool isHarmless(const osg::StateSet& states);

/// Moves a MatrixTransform by the same step in every frame, in its own frame.
[[nodiscard]] osg::ref_ptr<osg::NodeCallback> makeMover(const osg::Matrixd& start, const osg::Vec3d& step, int frame);

/// Adds to a node the callback that a part describes; nothing, if the part describes none.
void addCallback(const Part& part, osg::Node& node);

/// Looks at every visitor that it meets as applications do: one of the cull traversal is a CullVisitor, and the handler
/// of its requests is a DatabasePager. takeComplaint() tells of others.
class CastingGroup : public osg::Group {
public:
    CastingGroup() = default;
    CastingGroup(const CastingGroup& other, const osg::CopyOp& copyop) : osg::Group(other, copyop) {}
    [[nodiscard]] osg::Object* cloneType() const override { return new CastingGroup; }
    [[nodiscard]] osg::Object* clone(const osg::CopyOp& copyop) const override {
        return new CastingGroup(*this, copyop);
    }

    void traverse(osg::NodeVisitor& nv) override;
};

/// Undoes what callbacks of kind Meddles did in the last traversal.
void undoMeddling();

/// Returns: what a CastingGroup or a callback has met since the last call that OSG alone would not show it, or nothing.
[[nodiscard]] std::string takeComplaint();

/// Calls `visit(node)` with all nodes, whatever is switched off; it returns whether to go on below the node. A terrain
/// tile that is traversed before it has its Terrain never finds it afterwards.
template <class Visit>
void walk(osg::Node& subgraph, const Visit& visit) {
    struct Walker : osg::NodeVisitor {
        explicit Walker(const Visit& what) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), visit(what) {
            setNodeMaskOverride(~0u);
        }
        void apply(osg::Node& node) override {
            if (visit(node) && !dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
        }
        const Visit& visit;
    } walker(visit);
    subgraph.accept(walker);
}

/// The first node of this name, whatever is switched off. Returns: nullptr when there is none.
[[nodiscard]] osg::Node* findNode(osg::Node& subgraph, const std::string& name);

/// From the frame of houses in a file of their own to that of their database.
[[nodiscard]] osg::Matrixd frameOfHouses(const Part& part, const Description& description);

/// Does to a subgraph what a part says, if the node that it is for is in there. Parts that are for the whole scene, or
/// built in, are left alone.
void applyPart(const Part& part, const Description& description, osg::Node& subgraph);

/// Takes a model out again.
void removePart(const Part& part, osg::Node& scene);

/// The scene as it comes back from a file, .osgt or .osgb.
[[nodiscard]] osg::ref_ptr<osg::Group> savedAndLoaded(const osg::Group& scene, bool asText);

/// `variant`: what is copied, and what is shared.
[[nodiscard]] osg::ref_ptr<osg::Group> clonedScene(const osg::Group& scene, int variant);

}  // namespace osgAnalyticBin::test
