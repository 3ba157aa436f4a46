// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DatabaseCallbacks.h"

#include "CullTraversal.h"
#include "GlmBridge.h"
#include "ShownDepth.h"
#include "Viewpoint.h"

#include <osgAnalyticBin/BinInstaller.h>

#include <osg/CoordinateSystemNode>
#include <osg/CullStack>

#include <algorithm>
#include <limits>
#include <optional>

namespace osgAnalyticBin {

namespace {

std::optional<core::HorizonEye> eyeOver(osg::Group& node, osg::NodeVisitor& nv, osg::CullStack& cullStack,
                                        Database& database, const DatabaseView& view) {
    const CullOptions options = database.options();
    const HorizonUse horizonUse = options.effectiveHorizonUse();
    if (horizonUse == HorizonUse::Off) return std::nullopt;
    // an eye below the terrain looks through the backs of the faces that would hide
    const bool isAboveTerrain = options.skirts == SkirtUse::Cracks;
    if (horizonUse == HorizonUse::Declared && !isAboveTerrain) return std::nullopt;
    const auto viewpoint = Viewpoint::of(cullStack, nv, options.inheritViewpoint);
    if (!viewpoint) return std::nullopt;
    const bool isGiven = horizonUse == HorizonUse::Given;
    const double deepest = isGiven ? std::max(0.0, -options.horizon) : std::numeric_limits<double>::infinity();
    if (isGiven && (!isAboveTerrain || database.hasGap())) return viewpoint->above(view.ellipsoid, deepest);
    if (database.hasGap()) return std::nullopt;
    // Starting from the last frame's depth is quick, and sound, but may stay deeper than a fresh start: what is shown
    // shall not depend on where the camera has been.
    constexpr unsigned int kFreshStart = 16;
    double& depth = CullTraversal::of(nv).lastDepth(database);
    if (nv.getTraversalNumber() % kFreshStart == 0) depth = 0.0;
    return eyeAboveWhatIsShown(node, nv, cullStack, *viewpoint, view.ellipsoid, view.shape, deepest, depth);
}

template <class Callback>
Callback* findCallback(osg::Callback* first) {
    for (osg::Callback* callback = first; callback; callback = callback->getNestedCallback()) {
        if (auto* found = dynamic_cast<Callback*>(callback)) return found;
    }
    return nullptr;
}

}  // namespace

void DatabaseCullCallback::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    osg::CullStack* cullStack = nv->asCullStack();
    osg::Group* group = node->asGroup();
    if (!cullStack || !group) {
        traverse(node, nv);
        return;
    }
    CullTraversal& traversal = CullTraversal::of(*nv);
    DatabaseView view{_database.get(),
                      toCore(*_database->ellipsoid()),
                      _database->shape(),
                      nullptr,
                      cullStack->getModelViewMatrix(),
                      cullStack->getProjectionMatrix(),
                      traversal.planes(*cullStack)};
    const auto eye = eyeOver(*group, *nv, *cullStack, *_database, view);
    if (eye) view.eye = &*eye;
    const CullTraversal::DatabaseScope scope(*nv, traversal, view);
    traverse(node, nv);
}

void DatabaseUpdateCallback::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    _database->update();
    if (_database->takeShapeChange()) {
        BinInstaller installer(_database->options());
        installer.refit(*node, *_database);
    }
    traverse(node, nv);
}

void attachDatabase(osg::Node& node, Database& database) {
    attachUpdate(node, database);
    // in front: what is nested runs in the scope of the database
    const osg::ref_ptr<DatabaseCullCallback> cull = new DatabaseCullCallback(&database);
    cull->setNestedCallback(node.getCullCallback());
    node.setCullCallback(cull);
}

void attachUpdate(osg::Node& node, Database& database) {
    detachDatabase(node);
    const osg::ref_ptr<DatabaseUpdateCallback> update = new DatabaseUpdateCallback(&database);
    node.addUpdateCallback(update);
}

Database* attachedDatabase(osg::Node& node) {
    const auto* update = findCallback<DatabaseUpdateCallback>(node.getUpdateCallback());
    return update ? update->database() : nullptr;
}

void detachDatabase(osg::Node& node) {
    if (const osg::ref_ptr<osg::Callback> cull = findCallback<DatabaseCullCallback>(node.getCullCallback())) {
        node.removeCullCallback(cull.get());
    }
    if (const osg::ref_ptr<osg::Callback> update = findCallback<DatabaseUpdateCallback>(node.getUpdateCallback())) {
        node.removeUpdateCallback(update.get());
    }
}

}  // namespace osgAnalyticBin
