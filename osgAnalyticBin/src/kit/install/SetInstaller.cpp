// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SetInstaller.h"

#include "../CallbackChain.h"
#include "../cull/CullScopes.h"
#include "../database/BinReadFileCallback.h"
#include "../database/Database.h"
#include "../database/DatabaseCallbacks.h"
#include "ContentWatch.h"

#include <osg/ComputeBoundsVisitor>
#include <osg/LOD>
#include <osg/NodeCallback>
#include <osg/PagedLOD>

#include <vector>

namespace osgAnalyticBin {

namespace {

// Whether a sphere holds a box. Makers of files round spheres to float.
bool holdsBox(const osg::BoundingSphere& sphere, const osg::BoundingBox& box) {
    constexpr double kRounding = 1e-6;
    const osg::Vec3d center(sphere.center());
    const double reach = sphere.radius() + kRounding * (center.length() + sphere.radius());
    bool holds = true;
    for (unsigned int i = 0; box.valid() && i < 8; ++i)
        holds = holds && (osg::Vec3d(box.corner(i)) - center).length() <= reach;
    return holds;
}

// Knows the box of all that is loaded below a LOD. OSG calls it where something there has changed. With a scene it is
// saved as a ContentWatch that watches nothing.
class LodWatch final : public ContentWatch {
public:
    explicit LodWatch(osg::Node& node) { _previous = node.getComputeBoundingSphereCallback(); }

    [[nodiscard]] static const LodWatch* of(const osg::Node& node) {
        return dynamic_cast<const LodWatch*>(node.getComputeBoundingSphereCallback());
    }
    [[nodiscard]] const osg::BoundingBox& loaded() const { return _loaded; }
    // Whether the application asks OSG not to cull something below: not where only LODs of ours ask for it, which are
    // culled by their callbacks. `node`: the watched one.
    [[nodiscard]] bool isKept(const osg::Node& node) const {
        return _isKept || node.getNumChildrenWithCullingDisabled() != _withOurs;
    }

    osg::BoundingSphere computeBound(const osg::Node& node) const override;

protected:
    ~LodWatch() override = default;

private:
    mutable osg::BoundingBox _loaded;
    mutable bool _isKept = false;
    mutable unsigned int _withOurs = 0;  // children without OSG's culling when that was found
};

class LodCullCallback final : public osg::NodeCallback {
public:
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        const auto isCulled = [node](osg::CullStack& cullStack) {
            const osg::BoundingSphere& sphere = node->getBound();
            const LodWatch* const watch = LodWatch::of(*node);
            if (!watch || watch->isKept(*node) || !cullStack.isCulled(sphere)) return false;
            return !watch->loaded().valid() || cullStack.isCulled(watch->loaded());
        };
        cullOrTraverse(*nv, isCulled, [&] { traverse(node, nv); });
    }

protected:
    ~LodCullCallback() override = default;
};

// What is drawn below a LOD. Other LODs know it of themselves.
class LoadedBox : public osg::ComputeBoundsVisitor {
public:
    using osg::ComputeBoundsVisitor::apply;

    LoadedBox() { setNodeMaskOverride(~0u); }
    void apply(osg::Node& node) override {
        const LodWatch* const watch = LodWatch::of(node);
        const bool isOurs = watch && findCallback<LodCullCallback>(node.getCullCallback());
        isKept = isKept || (!node.getCullingActive() && !isOurs) || (watch && watch->isKept(node));
        if (!watch) return traverse(node);
        applyBoundingBox(watch->loaded());
    }
    void apply(osg::Drawable& drawable) override {
        isKept = isKept || !drawable.getCullingActive();
        osg::ComputeBoundsVisitor::apply(drawable);
    }

    bool isKept = false;
};

osg::BoundingSphere LodWatch::computeBound(const osg::Node& node) const {
    auto& lod = const_cast<osg::Node&>(node);
    const osg::BoundingSphere bound = boundOf(node);
    // otherwise OSG does not call this again when something below changes
    for (unsigned int i = 0; i < lod.asGroup()->getNumChildren(); ++i) (void)lod.asGroup()->getChild(i)->getBound();
    LoadedBox box;
    lod.traverse(box);
    _loaded = box.getBoundingBox();
    _isKept = box.isKept;
    _withOurs = lod.getNumChildrenWithCullingDisabled();
    // OSG culls no node above one that it does not cull
    const bool isBelow = _withOurs > 0 && !_isKept;
    if (lod.getCullingActive() && (isBelow || !holdsBox(bound, _loaded))) {
        lod.setCullingActive(false);
        const osg::ref_ptr<LodCullCallback> callback = new LodCullCallback;
        putInFront(lod, *callback);
    }
    return bound;
}

class LodSearch : public osg::NodeVisitor {
public:
    LodSearch() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0u); }

    void apply(osg::LOD& node) override {
        lods.push_back(&node);
        traverse(node);
    }
    void apply(osg::Transform&) override {}

    std::vector<osg::LOD*> lods;
};

class SetDatabase final : public Database {
public:
    explicit SetDatabase(const CullOptions& options) : Database(options, mapPlane(), nullptr, nullptr) {
        (void)decideGround(*mapPlane());
    }

    std::size_t install(osg::Node& content, const TileFrame& frame, InstalledTile*) override {
        const Method method = options().method;
        const bool isOff = method == Method::Sphere || method == Method::None;
        LodSearch found;
        content.accept(found);
        PagedReads reads;
        for (osg::LOD* const lod : found.lods) {
            removeFromLod(*lod);
            if (!isOff) lod->setComputeBoundingSphereCallback(new LodWatch(*lod));
            lod->dirtyBound();
            if (auto* const paged = dynamic_cast<osg::PagedLOD*>(lod))
                reads.follow(*paged, frame, *this, nullptr, false);
        }
        return isOff ? 0 : found.lods.size();
    }
    void refit(osg::Node&) override {}
    void watch(osg::Group&) override {}
    void installOnClone(osg::Node& root) override { (void)installOnSet(*root.asGroup(), options()); }

protected:
    ~SetDatabase() override = default;
};

}  // namespace

std::size_t installOnSet(osg::Group& set, const CullOptions& options) {
    const osg::ref_ptr<SetDatabase> database = new SetDatabase(options);
    std::size_t installed = 0;
    for (unsigned int i = 0; i < set.getNumChildren(); ++i)
        installed += database->install(*set.getChild(i), {}, nullptr);
    detachDatabase(set);
    if (installed == 0) return 0;
    // clones have the flags of what is known now, and watches of their own after their first update
    (void)set.getBound();
    attachDatabase(set, *database, false);
    return installed;
}

void removeFromLod(osg::Node& node) {
    ContentWatch::remove(node);
    if (!findCallback<LodCullCallback>(node.getCullCallback())) return;
    takeOffFirst<LodCullCallback>(node);
    node.setCullingActive(true);
}

}  // namespace osgAnalyticBin
