// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../cull/TileFamily.h"
#include "../database/BinReadFileCallback.h"
#include "../database/DatabaseCallbacks.h"
#include "../tile/Carrier.h"
#include "../tile/EachNode.h"
#include "TileCallback.h"

#include <osgAnalyticBin/InstallBins.h>

#include <osg/PagedLOD>

#include <vector>

namespace osgAnalyticBin {

namespace {

// Files below a PagedLOD are read without bins from now on. Returns: the database that they belonged to; may be null.
osg::ref_ptr<Database> detachReads(osg::Node& node) {
    auto* const paged = dynamic_cast<osg::PagedLOD*>(&node);
    BinReadFileCallback* const callback = paged ? readCallbackOf(*paged) : nullptr;
    if (!callback) return nullptr;
    osg::ref_ptr<Database> database = callback->database();
    paged->setDatabaseOptions(osg::ref_ptr(callback->replaced()).get());
    return database;
}

void detach(osg::Node& node) {
    removeDatabase(node);
    if (const osg::ref_ptr<Database> database = detachReads(node)) database->setRemoved();
}

void remove(Carrier& carrier) {
    const osg::Node::ParentList parents = carrier.getParents();
    const unsigned int children = carrier.getNumChildren();
    for (osg::Group* const parent : parents) {
        // its tile may have been taken away; what the application has added to it stays with it
        if (children == 0) parent->removeChild(&carrier);
        if (children == 1) parent->replaceChild(&carrier, carrier.getChild(0));
    }
}

// Takes off callbacks of tiles and groups above tiles, and has `detach` do the rest with each node.
template <class Detach>
void removeBelow(osg::Node& node, const Detach& detach) {
    NestedCallbacks nested;
    removeCallbacksBelow(node, nested);
    std::vector<osg::ref_ptr<Carrier>> carriers;
    forEachNode(node, [&](osg::Node& at) {
        detach(at);
        if (auto* const carrier = dynamic_cast<Carrier*>(&at)) carriers.emplace_back(carrier);
    });
    takeOff(nested);
    for (const auto& carrier : carriers) remove(*carrier);
}

}  // namespace

// An installer leaves some things on a scene even with Method::None, so that bins can be installed later: callbacks of
// the database, watches of content, the pager's options, and groups above tiles.
void removeBins(osg::Node& node) {
    CullOptions options;
    options.method = Method::Sphere;
    (void)installBins(node, options);
    removeBelow(node, detach);
}

void removeTile(osg::Node& database, osg::Node& tile) {
    removeBelow(tile, detachReads);
    const osg::ref_ptr<Database> attached = attachedDatabase(database);
    for (osg::Group* const parent : tile.getParents()) {
        // while it is still there: tiles that are taken away without a word are missed
        TileFamily::renew(*parent);
        // its siblings have other numbers then
        if (attached) attached->noteChanged(*parent);
    }
}

}  // namespace osgAnalyticBin
