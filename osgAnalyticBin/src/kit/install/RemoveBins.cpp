// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

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

void detach(osg::Node& node) {
    if (Database* const database = attachedDatabase(node)) database->setRemoved();
    detachDatabase(node);
    auto* const paged = dynamic_cast<osg::PagedLOD*>(&node);
    BinReadFileCallback* const callback = paged ? readCallbackOf(*paged) : nullptr;
    if (!callback) return;
    callback->database()->setRemoved();
    paged->setDatabaseOptions(osg::ref_ptr(callback->replaced()).get());
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

}  // namespace

// An installer leaves some things on a scene even with Method::None, so that bins can be installed later: callbacks of
// the database, watches of content, the pager's options, and groups above tiles.
void removeBins(osg::Node& node) {
    CullOptions options;
    options.method = Method::Sphere;
    (void)installBins(node, options);
    NestedCallbacks nested;
    removeCallbacksBelow(node, nested);
    std::vector<osg::ref_ptr<Carrier>> carriers;
    forEachNode(node, [&carriers](osg::Node& at) {
        detach(at);
        if (auto* const carrier = dynamic_cast<Carrier*>(&at)) carriers.emplace_back(carrier);
    });
    takeOff(nested);
    for (const auto& carrier : carriers) remove(*carrier);
}

}  // namespace osgAnalyticBin
