// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The callbacks on the CoordinateSystemNode of an installed database. Their class name is that of a plain
// osg::NodeCallback, so that nothing of them is saved with a scene. On a clone of the node they install bins anew;
// until then all tiles there are visible. The cull callback is always there, the update callback until a cull traversal
// has found nothing for it to do: viewers that draw on demand draw frames as long as there is one.

#pragma once

#include "CullComparison.h"
#include "Database.h"

#include <osg/CullStack>
#include <osg/Group>
#include <osg/Node>
#include <osg/NodeCallback>

#include <memory>

namespace osgAnalyticBin {

/// Tells the tiles below, for the length of a cull traversal, how the terrain is shaped and what its horizon is. Then
/// puts the update callback on the node if the database has work for it.
class DatabaseCullCallback : public osg::NodeCallback {
public:
    DatabaseCullCallback(Database* database, const osg::Node* node) : _database(database), _node(node) {}
    DatabaseCullCallback(const DatabaseCullCallback& other, const osg::CopyOp& copyop);
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new DatabaseCullCallback(*this, copyop); }

    [[nodiscard]] Database* database() const { return _database.get(); }

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

protected:
    ~DatabaseCullCallback() override = default;

private:
    void cull(osg::Group& node, osg::NodeVisitor& nv, osg::CullStack& cullStack, const TerrainShape& shape);
    void leaveToOsg(osg::Node& node, osg::NodeVisitor& nv);

    const osg::ref_ptr<Database> _database;
    const osg::Node* const _node;  // that it was attached to
    const std::unique_ptr<CullComparison> _comparison = CullComparison::fromEnvironment();
};

/// Does what a database was asked for, in the update traversal: loaded tiles are fitted again when the Terrain's shape
/// has changed, when a tile did not fit the index, and when an index is complete. `node`: the one that it is attached
/// to.
void bringUpToDate(osg::Node& node, Database& database);

/// Calls bringUpToDate(). It takes itself off the node when nothing is left to do: after a cull traversal, which finds
/// most of that, or when none comes.
class DatabaseUpdateCallback : public osg::NodeCallback {
public:
    DatabaseUpdateCallback(Database* database, const osg::Node* node) : _database(database), _node(node) {}
    DatabaseUpdateCallback(const DatabaseUpdateCallback& other, const osg::CopyOp& copyop);
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new DatabaseUpdateCallback(*this, copyop); }

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

protected:
    ~DatabaseUpdateCallback() override = default;

private:
    void runOnClone(osg::Node& node, osg::NodeVisitor& nv);

    const osg::ref_ptr<Database> _database;
    const osg::Node* const _node;  // that it was attached to
    unsigned int _unseen = 0;      // updates without a cull traversal before
};

/// Attaches a database to the node, in place of one that is there. `isCulling`: see Database.
void attachDatabase(osg::Node& node, Database& database, bool isCulling);

/// Returns: nullptr when none is attached.
[[nodiscard]] Database* attachedDatabase(osg::Node& node);

/// Removes all callbacks of databases from the node.
void detachDatabase(osg::Node& node);

/// The same for good: the database's bins cull nothing any more.
void removeDatabase(osg::Node& node);

}  // namespace osgAnalyticBin
