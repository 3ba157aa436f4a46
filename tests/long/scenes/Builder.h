// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Description.h"

namespace osgAnalyticBin::test {

/// Builds the scene of a description, and the files of its databases, as often as one likes.
class Builder {
public:
    explicit Builder(const Description& description) : _description(description) {}

    /// The scene in its first frame. Bins are not installed.
    [[nodiscard]] osg::ref_ptr<osg::Group> scene() const;

    /// The content of a file of a tile, or of a name. Returns: nullptr when no database has it.
    [[nodiscard]] osg::ref_ptr<osg::Node> file(const TileKey& parent) const;
    [[nodiscard]] osg::ref_ptr<osg::Node> file(const std::string& name) const;

private:
    [[nodiscard]] const DatabaseSpec& spec(const TileKey& tile) const { return _description.database(tile.database); }
    [[nodiscard]] osg::ref_ptr<osg::Node> database(int number) const;
    void addTiles(int number, osg::Group& globe) const;
    [[nodiscard]] const Part* find(PartKind kind, const TileKey& tile) const;
    [[nodiscard]] osg::ref_ptr<osg::Node> mesh(const TileKey& tile, int posts, const std::string& name = "#") const;
    [[nodiscard]] osg::ref_ptr<osg::Node> houses(const Part& part) const;
    [[nodiscard]] osg::ref_ptr<osg::Node> rootTile(const TileKey& tile, const std::vector<osg::Node*>& row) const;
    [[nodiscard]] osg::ref_ptr<osg::Node> wrappedTile(const TileKey& tile) const;
    [[nodiscard]] osg::ref_ptr<osg::Node> tile(const TileKey& tile) const;
    [[nodiscard]] osg::ref_ptr<osg::Node> content(const TileKey& parent) const;
    [[nodiscard]] osg::ref_ptr<osg::Node> wrap(const Part& part, osg::Node& node) const;
    [[nodiscard]] osg::ref_ptr<osg::Node> other(const TileKey& tile) const;
    void decorate(osg::Node& subgraph) const;

    const Description& _description;
};

}  // namespace osgAnalyticBin::test
