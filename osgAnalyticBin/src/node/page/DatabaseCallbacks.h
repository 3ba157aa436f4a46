// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The callbacks on the CoordinateSystemNode of an installed database. Their class name is that of a plain
// osg::NodeCallback, so that nothing of them is saved with a scene. On a clone of the node the update callback installs
// bins anew; until then all tiles there are visible.

#pragma once

#include "Database.h"

#include <osg/Node>
#include <osg/NodeCallback>

namespace osgAnalyticBin {

/// Tells the tiles below, for the length of a cull traversal, how the terrain is shaped and what its horizon is.
class DatabaseCullCallback : public osg::NodeCallback {
public:
    DatabaseCullCallback(Database* database, const osg::Node* node) : _database(database), _node(node) {}
    DatabaseCullCallback(const DatabaseCullCallback& other, const osg::CopyOp& copyop);
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new DatabaseCullCallback(*this, copyop); }

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

protected:
    ~DatabaseCullCallback() override = default;

private:
    const osg::ref_ptr<Database> _database;
    const osg::Node* const _node;  // that it was attached to
};

/// Brings the loaded tiles up to date: when the Terrain's shape has changed, and when a tile did not fit the index.
class DatabaseUpdateCallback : public osg::NodeCallback {
public:
    DatabaseUpdateCallback(Database* database, const osg::Node* node) : _database(database), _node(node) {}
    DatabaseUpdateCallback(const DatabaseUpdateCallback& other, const osg::CopyOp& copyop);
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new DatabaseUpdateCallback(*this, copyop); }

    [[nodiscard]] Database* database() const { return _database.get(); }

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

protected:
    ~DatabaseUpdateCallback() override = default;

private:
    void runOnClone(osg::Node& node, osg::NodeVisitor& nv);

    const osg::ref_ptr<Database> _database;
    const osg::Node* const _node;  // that it was attached to
};

/// Sets both on the node, in place of those that are there.
void attachDatabase(osg::Node& node, Database& database);

/// Puts the update callback alone on the node, for a database that bins do not cull at present.
void attachUpdate(osg::Node& node, Database& database);

/// Returns: nullptr when neither is on the node.
[[nodiscard]] Database* attachedDatabase(osg::Node& node);

/// Removes both from the node.
void detachDatabase(osg::Node& node);

}  // namespace osgAnalyticBin
