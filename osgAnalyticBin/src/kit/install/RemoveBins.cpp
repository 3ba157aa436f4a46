// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../cull/InstalledBin.h"
#include "../cull/TileFamily.h"
#include "../database/BinReadFileCallback.h"
#include "../database/DatabaseCallbacks.h"
#include "../tile/Carrier.h"
#include "ContentWatch.h"
#include "TileCallback.h"

#include <osgAnalyticBin/InstallBins.h>

#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <osgTerrain/TerrainTile>

#include <vector>

namespace osgAnalyticBin {

namespace {

// Removes what an installer leaves on a scene even with Method::None, so that bins can be installed later: callbacks of
// the database, watches of content, the pager's options, and groups above tiles.
class BinRemover : public osg::NodeVisitor {
public:
    BinRemover() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0u); }

    void apply(osg::Node& node) override {
        if (installedTileOf(node)) removeCallbacks({&node, {}, {}, 0, {}}, _nested);
        TileFamily::remove(node);
        ContentWatch::remove(node);
        if (Database* const database = attachedDatabase(node)) database->setRemoved();
        detachDatabase(node);
        if (auto* const carrier = dynamic_cast<Carrier*>(&node)) _carriers.emplace_back(carrier);
        if (!dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
    }

    void apply(osg::PagedLOD& node) override {
        if (BinReadFileCallback* const callback = readCallbackOf(node)) {
            callback->database()->setRemoved();
            node.setDatabaseOptions(osg::ref_ptr(callback->replaced()).get());
        }
        apply(static_cast<osg::Node&>(node));
    }

    void finish() {
        takeOff(_nested);
        removeCarriers();
    }

private:
    void removeCarriers() {
        for (const auto& carrier : _carriers) {
            const osg::Node::ParentList parents = carrier->getParents();
            const unsigned int children = carrier->getNumChildren();
            for (osg::Group* const parent : parents) {
                // its tile may have been taken away; what the application has added to it stays with it
                if (children == 0) parent->removeChild(carrier);
                if (children == 1) parent->replaceChild(carrier, carrier->getChild(0));
            }
        }
    }

    std::vector<osg::ref_ptr<Carrier>> _carriers;
    NestedCallbacks _nested;
};

}  // namespace

void removeBins(osg::Node& node) {
    CullOptions options;
    options.method = Method::Sphere;
    (void)installBins(node, options);
    BinRemover remover;
    node.accept(remover);
    remover.finish();
}

}  // namespace osgAnalyticBin
