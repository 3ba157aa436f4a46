// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BoxInstaller.h"

#include "../CallbackChain.h"
#include "../cull/CullScopes.h"
#include "../cull/InstalledBin.h"
#include "../database/BinReadFileCallback.h"
#include "../database/Database.h"
#include "../database/DatabaseCallbacks.h"
#include "../database/PagingExpiry.h"
#include "../surface/LodContent.h"
#include "../tile/TileBoundsSource.h"
#include "ContentWatch.h"
#include "TileCallback.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/PhotogrammetrySet.h>

#include <osg/NodeCallback>
#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <osg/observer_ptr>

#include <algorithm>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin {

namespace {

// Whether a sphere holds a box. Makers of files round spheres to float.
bool holdsBox(const osg::BoundingSphere& sphere, const MeshBox& box) {
    constexpr double kRounding = 1e-6;
    if (box.isEmpty()) return true;
    if (box.isBoundless()) return false;
    const osg::Vec3d center(sphere.center());
    double farthest = 0.0;
    for (unsigned int i = 0; i < 8; ++i) farthest = std::max(farthest, (box.box().corner(i) - center).length());
    const double radius = sphere.radius();
    return farthest <= radius + kRounding * (center.length() + radius);
}

// A LOD of a set.
struct BoxTile final : public InstalledTile {
    using InstalledTile::InstalledTile;

    // What culls the node besides OSG's test of its sphere, guarded by the set: nothing; a bin of all that the index
    // knows below it; a bin of what is loaded, where the sphere, which stands for the rest, is out of view as well.
    enum class Bin { None, Whole, Loaded };
    Bin bin = Bin::None;
    MeshBox box;  // of the bin; without one, of what is known
    osg::BoundingSphere sphere;
    bool isSphereTested = true;  // by OSG; it holds what is below
    osg::observer_ptr<osg::LOD> node;

    [[nodiscard]] BoxTile* above() const { return static_cast<BoxTile*>(parent.get()); }

protected:
    ~BoxTile() override = default;
};

// The content of a file, and of those below it.
struct FileContent {
    MeshBox box;            // all vertices that are loaded
    bool isMisfit = false;  // whether the index does not know it as it is
};

// Has neither a horizon nor terrain that hides.
CullOptions withoutHiding(CullOptions options) {
    options.horizonUse = HorizonUse::Off;
    options.occlusion = OcclusionUse::Off;
    return options;
}

// On the root of a set.
class WithoutOccluders final : public osg::NodeCallback {
public:
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        std::optional<CullingMaskScope> mask;
        if (osg::CullStack* const cullStack = nv->asCullStack())
            mask.emplace(*cullStack, ~osg::CullingSet::Mask{osg::CullingSet::SHADOW_OCCLUSION_CULLING});
        traverse(node, nv);
    }

protected:
    ~WithoutOccluders() override = default;
};

class BoxSet final : public Database {
public:
    BoxSet(const CullOptions& options, const ChosenIndex& index)
        : Database(withoutHiding(options), mapPlane(), nullptr, index.index.get()) {
        (void)decideGround(*mapPlane());
        setMaking(index.making.get());
    }

    std::size_t install(osg::Node& content, const TileFrame& frame, InstalledTile* parent) override;
    void refit(osg::Node& root) override;
    // a set has no families
    void watch(osg::Group&) override {}
    void installOnClone(osg::Node& root) override { (void)installBoxes(*root.asGroup(), options()); }

    // Installs bins on all that is loaded. Returns: the number of LODs.
    std::size_t installBelow(osg::Group& root);
    void cullByBin(osg::LOD& node, BoxTile& tile);

protected:
    ~BoxSet() override = default;

private:
    void grow(BoxTile& tile, const FileContent& content);

    std::mutex _boxes;
    std::vector<osg::ref_ptr<BoxTile>> _outgrown;  // content has left their spheres; guarded
    osg::ref_ptr<const BinIndex> _fittedTo;
};

// Installs bins on the LODs of files, and on what is loaded below.
class BoxInstaller {
public:
    explicit BoxInstaller(BoxSet& set) : _set(set), _index(set.index()), _options(set.options()) {}

    // `parent`: the LOD that pages the file; null: none.
    FileContent install(osg::Node& node, const std::string& file, BoxTile* parent) {
        const LodContent content = findLods(node);
        std::vector<osg::ref_ptr<BoxTile>> tiles;
        std::vector<FileContent> below;
        PagedReads reads;
        for (const FoundLod& lod : content.lods) {
            BoxTile* const above = lod.parent ? tiles[*lod.parent].get() : parent;
            const osg::ref_ptr<BoxTile> tile = new BoxTile(_set, above, file, tiles.size());
            tiles.push_back(tile);
            below.push_back(installBelow(*lod.node, *tile));
            if (auto* const paged = dynamic_cast<osg::PagedLOD*>(lod.node)) {
                raiseExpiry(*paged, _options.expiry);
                reads.follow(*paged, frameOf(file), _set, tile.get(), true);
            }
        }
        const FileContent all = place(content, below, tiles, file);
        watch(content, tiles, parent);
        if (all.isMisfit && !tiles.empty()) Database::report(*tiles.front(), Finding::OtherThanIndexed);
        return all;
    }

    [[nodiscard]] std::size_t installed() const { return _installed; }

private:
    static TileFrame frameOf(const std::string& file) {
        TileFrame frame;
        frame.ellipsoid = mapPlane();
        frame.file = file;
        return frame;
    }

    FileContent installBelow(osg::LOD& node, BoxTile& tile) {
        FileContent below;
        for (unsigned int i = 0; i < node.getNumChildren(); ++i) {
            if (!isPagedChildOf(node, i)) continue;
            const std::string& name = static_cast<osg::PagedLOD&>(node).getFileName(i);
            const FileContent content = install(*node.getChild(i), pagedFilePath(tile.file, name), &tile);
            below.box.expandBy(content.box);
            below.isMisfit = below.isMisfit || content.isMisfit;
        }
        return below;
    }

    // Gives the tiles of a file their bins.
    FileContent place(const LodContent& content, const std::vector<FileContent>& below,
                      const std::vector<osg::ref_ptr<BoxTile>>& tiles, const std::string& file) {
        std::vector<MeshBox> loaded;
        for (const FileContent& files : below) loaded.push_back(files.box);
        const std::vector<MeshBox> boxes = content.boxes(loaded);
        const std::vector<BinIndex::Entry>* const known = _index ? _index->tilesOf(file) : nullptr;
        const bool isKnown = known && known->size() == tiles.size();
        FileContent all{content.all(boxes), _index && !isKnown};
        std::vector<bool> fits(tiles.size(), isKnown);
        for (std::size_t i = tiles.size(); i-- > 0;) {
            const MeshBox whole = isKnown ? MeshBox((*known)[i].bin) : MeshBox();
            fits[i] = fits[i] && !below[i].isMisfit && whole.contains(boxes[i]);
            if (!fits[i] && content.lods[i].parent) fits[*content.lods[i].parent] = false;
            all.isMisfit = all.isMisfit || (_index && !fits[i]);
        }
        for (std::size_t i = 0; i < tiles.size(); ++i)
            fit(*content.lods[i].node, *tiles[i], fits[i] ? MeshBox((*known)[i].bin) : boxes[i], fits[i]);
        return all;
    }

    // All that the index knows below a tile; empty: it does not know the tile.
    [[nodiscard]] MeshBox wholeBelow(const BoxTile* tile) const {
        const std::vector<BinIndex::Entry>* const known = tile && _index ? _index->tilesOf(tile->file) : nullptr;
        return known && *tile->ordinal < known->size() ? MeshBox((*known)[*tile->ordinal].bin) : MeshBox();
    }

    // Whether a bin that is not needed is worth its test: it is much smaller than that above, and keeps files from
    // being loaded. OSG tests the boxes of drawables by itself.
    [[nodiscard]] bool isWorthABin(const osg::LOD& node, const BoxTile& tile) const {
        constexpr double kMuch = 0.9;
        const auto* const paged = dynamic_cast<const osg::PagedLOD*>(&node);
        bool hasFile = false;
        for (unsigned int i = 0; paged && i < paged->getNumFileNames(); ++i)
            hasFile = hasFile || !paged->getFileName(i).empty();
        const MeshBox above = wholeBelow(tile.above());
        return hasFile && (above.isEmpty() || tile.box.box().radius() < kMuch * above.box().radius());
    }

    void fit(osg::LOD& node, BoxTile& tile, const MeshBox& box, bool isWhole) {
        tile.node = &node;
        tile.sphere = node.getBound();
        tile.isSphereTested = holdsBox(tile.sphere, box);
        tile.box = box;
        if (!tile.isSphereTested) tile.bin = BoxTile::Bin::Loaded;
        if (isWhole && (!tile.isSphereTested || isWorthABin(node, tile))) tile.bin = BoxTile::Bin::Whole;
        if (tile.bin != BoxTile::Bin::None) _set.cullByBin(node, tile);
        ++_installed;
    }

    // What an application adds where bins cull is noticed.
    void watch(const LodContent& content, const std::vector<osg::ref_ptr<BoxTile>>& tiles, BoxTile* parent) const {
        const auto hasBin = [](const auto& tile) { return tile->bin != BoxTile::Bin::None; };
        if (!_index && std::none_of(tiles.begin(), tiles.end(), hasBin)) return;
        const auto above = [&](std::optional<std::size_t> lod) { return lod ? tiles[*lod].get() : parent; };
        for (const auto& [group, lod] : content.groups) ContentWatch::place(*group, {}, above(lod), above(lod));
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            const FoundLod& lod = content.lods[i];
            std::vector<osg::ref_ptr<osg::Node>> meshes;
            for (unsigned int child = 0; child < lod.node->getNumChildren(); ++child) {
                if (!isPagedChildOf(*lod.node, child)) meshes.emplace_back(lod.node->getChild(child));
            }
            ContentWatch::place(*lod.node, meshes, above(lod.parent), tiles[i].get());
        }
    }

    BoxSet& _set;
    const osg::ref_ptr<const BinIndex> _index;
    const CullOptions _options;
    std::size_t _installed = 0;
};

// Takes off what was installed on the tiles of a set.
class BoxRemover : public osg::NodeVisitor {
public:
    BoxRemover() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0u); }

    void apply(osg::PagedLOD& node) override {
        if (BinReadFileCallback* const callback = readCallbackOf(node)) {
            restoreExpiry(node, callback->database()->options().expiry);
            node.setDatabaseOptions(osg::ref_ptr(callback->replaced()).get());
        }
        traverse(node);
    }
};

void removeBelow(osg::Group& root) {
    NestedCallbacks nested;
    removeCallbacksBelow(root, nested);
    takeOff(nested);
    BoxRemover remover;
    root.accept(remover);
}

std::size_t BoxSet::install(osg::Node& content, const TileFrame& frame, InstalledTile* parent) {
    auto* const tile = static_cast<BoxTile*>(parent);
    BoxInstaller installer(*this);
    const FileContent found = installer.install(content, frame.file, tile);
    if (tile) grow(*tile, found);
    return installer.installed();
}

void BoxSet::cullByBin(osg::LOD& node, BoxTile& tile) {
    const osg::ref_ptr<AnalyticBinCullCallback> callback =
        new AnalyticBinCullCallback(tile.box.bin(), *mapPlane(), options());
    tile.setNode(&node);
    if (tile.bin == BoxTile::Bin::Loaded) tile.doubt(InstalledTile::NeedsSphere);
    if (!tile.isSphereTested) tile.switchOffSphere(node);
    callback->setInstalledTile(&tile);
    putInFront(node, *callback);
}

// What was read does not fit into what the tile and those above it hold.
void BoxSet::grow(BoxTile& tile, const FileContent& content) {
    const AnalyticBin bin = content.box.bin();
    const Widening by{bin, !bin.valid() && !content.box.isEmpty()};
    const std::lock_guard<std::mutex> lock(_boxes);
    for (BoxTile* at = &tile; at; at = at->above()) {
        const bool isHeld = at->box.contains(content.box);
        at->box.expandBy(content.box);
        if (at->isSphereTested && !holdsBox(at->sphere, content.box)) {
            at->isSphereTested = false;
            if (at->bin == BoxTile::Bin::None) at->bin = BoxTile::Bin::Loaded;
            _outgrown.emplace_back(at);
            requestRefit();
        }
        if (at->bin == BoxTile::Bin::None || (isHeld && !(content.isMisfit && at->bin == BoxTile::Bin::Whole)))
            continue;
        at->bin = BoxTile::Bin::Loaded;
        at->doubt(InstalledTile::NeedsSphere);
        widen(*at, by);
    }
}

std::size_t BoxSet::installBelow(osg::Group& root) {
    BoxInstaller installer(*this);
    _fittedTo = index();
    for (unsigned int i = 0; i < root.getNumChildren(); ++i) {
        osg::Node& tile = *root.getChild(i);
        (void)installer.install(tile, photogrammetryFileOf(tile), nullptr);
    }
    setCulling(_fittedTo.valid());
    return installer.installed();
}

void BoxSet::refit(osg::Node& root) {
    std::vector<osg::ref_ptr<BoxTile>> outgrown;
    {
        const std::lock_guard<std::mutex> lock(_boxes);
        outgrown.swap(_outgrown);
    }
    // a file that was on its way may refer to tiles of an earlier fit
    const auto hasBin = [](const osg::ref_ptr<BoxTile>& tile) {
        osg::ref_ptr<osg::LOD> node;
        return tile->node.lock(node) && installedTileOf(*node);
    };
    if (outgrown.empty() || _fittedTo != index() || std::any_of(outgrown.begin(), outgrown.end(), hasBin)) {
        removeBelow(*root.asGroup());
        (void)installBelow(*root.asGroup());
        return;
    }
    for (const osg::ref_ptr<BoxTile>& tile : outgrown) {
        osg::ref_ptr<osg::LOD> node;
        if (!tile->node.lock(node)) continue;
        const std::lock_guard<std::mutex> lock(_boxes);
        cullByBin(*node, *tile);
    }
}

// `before`: the bins that the set has; null: none. An index that is being made for them goes on.
ChosenIndex indexFor(const osg::Node& set, const CullOptions& options, const Database* before) {
    const osg::ref_ptr<TileBoundsSource> making = before ? before->making() : nullptr;
    if (making && options.index == IndexUse::Auto) return {making->whole(), making};
    ChosenIndex chosen = chooseIndex(metadataFileOf(set), nullptr, options.index);
    if (chosen.making) chosen.making->start();
    return chosen;
}

}  // namespace

std::size_t installBoxes(osg::Group& root, const CullOptions& options) {
    const osg::ref_ptr<BoxSet> set = new BoxSet(options, indexFor(root, options, attachedDatabase(root)));
    removeBoxes(root);
    const std::size_t installed = set->installBelow(root);
    attachDatabase(root, *set, set->isCulling());
    // OSG's tests of occluders need the spheres that are switched off
    const osg::ref_ptr<osg::Callback> withoutOccluders = new WithoutOccluders;
    putInFront(root, *withoutOccluders);
    return installed;
}

void removeBoxes(osg::Group& root) {
    takeOffFirst<WithoutOccluders>(root);
    removeDatabase(root);
    removeBelow(root);
}

}  // namespace osgAnalyticBin
