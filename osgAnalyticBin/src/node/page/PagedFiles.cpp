// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PagedFiles.h"

#include "BinReadFileCallback.h"
#include "DatabaseCallbacks.h"

#include <osg/NodeVisitor>
#include <osgTerrain/TerrainTile>

namespace osgAnalyticBin {

namespace {

// Looks for the database that the pages below a node belong to.
class DatabaseFinder : public osg::NodeVisitor {
public:
    DatabaseFinder() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Node& node) override {
        if (!_found && !dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
    }
    void apply(osg::PagedLOD& node) override {
        BinReadFileCallback* callback = readCallbackOf(node);
        if (callback && !_found) _found = callback->database();
        apply(static_cast<osg::Node&>(node));
    }

    [[nodiscard]] Database* found() const { return _found.get(); }

private:
    osg::ref_ptr<Database> _found;
};

}  // namespace

std::vector<PagedFile> filesPagedBy(const osg::PagedLOD& node, const TileFrame& frame, bool isTile) {
    std::vector<PagedFile> files;
    for (unsigned int i = 0; i < node.getNumFileNames(); ++i) {
        if (node.getFileName(i).empty()) continue;
        TileFrame inside = frame;
        inside.file = pagedFilePath(frame.file, node.getFileName(i));
        inside.isBelowTile = inside.isBelowTile || isTile;
        files.push_back({node.getDatabasePath() + node.getFileName(i), inside});
    }
    return files;
}

osgDB::ReadFileCallback* previousCallback(const osgDB::Options& options) {
    osgDB::ReadFileCallback* callback = options.getReadFileCallback();
    auto* ours = dynamic_cast<BinReadFileCallback*>(callback);
    return ours ? ours->previous() : callback;
}

BinReadFileCallback* readCallbackOf(osg::PagedLOD& node) {
    const auto* options = dynamic_cast<osgDB::Options*>(node.getDatabaseOptions());
    return options ? dynamic_cast<BinReadFileCallback*>(options->getReadFileCallback()) : nullptr;
}

osgDB::Options* optionsWithoutBins(osgDB::Options* options) {
    auto* const ours = options ? dynamic_cast<BinReadFileCallback*>(options->getReadFileCallback()) : nullptr;
    return ours ? ours->replaced() : options;
}

osg::ref_ptr<Database> databaseOf(osg::Node& node) {
    if (Database* attached = attachedDatabase(node)) return attached;
    DatabaseFinder finder;
    node.accept(finder);
    return finder.found();
}

}  // namespace osgAnalyticBin
