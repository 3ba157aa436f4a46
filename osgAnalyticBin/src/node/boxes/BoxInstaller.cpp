// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BoxInstaller.h"

#include "../CallbackChain.h"
#include "../page/CarefulRead.h"
#include "../page/PagingExpiry.h"
#include "BoxCullCallback.h"
#include "BoxFamily.h"

#include <osgAnalyticBin/PhotogrammetrySet.h>
#include <osgAnalyticBin/TileFrame.h>

#include <osg/NodeVisitor>
#include <osg/Notify>
#include <osgDB/FileUtils>
#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <algorithm>
#include <typeinfo>

namespace osgAnalyticBin {

// Installs boxes on what the DatabasePager reads below a photogrammetry set, in the thread that reads it. A file that
// could not be read is not tried again for a while (FailedReads).
class BoxReadFileCallback final : public osgDB::ReadFileCallback {
public:
    // `replaced`: the options that the PagedLODs came with; null: none.
    BoxReadFileCallback(BoxSet* set, osgDB::Options* replaced, osgDB::ReadFileCallback* previous)
        : _set(set), _replaced(replaced), _previous(previous) {}

    // Announces a file: the name by which it will be requested, its name in the index, and the tile that pages it. Do
    // not call once the pager may read.
    void expect(const std::string& fileName, const std::string& file, BoxTile* parent) {
        _expected[fileName] = {file, parent};
    }
    [[nodiscard]] bool expects(const std::string& fileName) const { return _expected.count(fileName) > 0; }

    [[nodiscard]] osgDB::Options* replaced() const { return _replaced.get(); }
    // The expiry times that the PagedLODs were given.
    [[nodiscard]] double expiry() const { return _set->options().expiry; }

    osgDB::ReaderWriter::ReadResult readNode(const std::string& fileName, const osgDB::Options* options) override {
        using ReadResult = osgDB::ReaderWriter::ReadResult;
        const BusyPager busy(_set->making());
        return readCarefully(fileName, _failures, [&] {
            ReadResult read = readPlain(fileName, options, _previous.get());
            const auto found = _expected.find(fileName);
            if (read.validNode() && found != _expected.end()) install(*read.getNode(), found->second);
            return read;
        });
    }

protected:
    ~BoxReadFileCallback() override = default;

private:
    struct Expected {
        std::string file;
        osg::ref_ptr<BoxTile> parent;
    };

    void install(osg::Node& node, const Expected& expected) const {
        if (_set->isRemoved()) return;
        BoxInstaller installer(*_set);
        // nodes that others refer to as well keep OSG's spheres
        const bool isOwn = node.referenceCount() == 1;
        const auto content =
            isOwn ? installer.install(node, expected.file, expected.parent.get()) : installer.survey(node);
        _set->grow(*expected.parent, content.box, content.isMisfit);
    }

    const osg::ref_ptr<BoxSet> _set;
    const osg::ref_ptr<osgDB::Options> _replaced;
    const osg::ref_ptr<osgDB::ReadFileCallback> _previous;
    std::map<std::string, Expected> _expected;
    FailedReads _failures;
};

namespace {

// Removes the boxes of all LODs.
class BoxRemover : public osg::NodeVisitor {
public:
    BoxRemover() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0u); }

    void apply(osg::Group& node) override {
        BoxFamily::remove(node);
        traverse(node);
    }

    void apply(osg::LOD& node) override {
        BoxCullCallback::remove(node);
        traverse(node);
    }

    void apply(osg::PagedLOD& node) override {
        const auto* const options = dynamic_cast<osgDB::Options*>(node.getDatabaseOptions());
        auto* const callback = options ? dynamic_cast<BoxReadFileCallback*>(options->getReadFileCallback()) : nullptr;
        if (callback) {
            restoreExpiry(node, callback->expiry());
            node.setDatabaseOptions(osg::ref_ptr(callback->replaced()).get());
        }
        apply(static_cast<osg::LOD&>(node));
    }
};

// `before`: the boxes that the set has; null: none. An index that is being made for them goes on.
ChosenIndex indexFor(const osg::Node& set, const CullOptions& options, const BoxSet* before) {
    if (before && before->making() && options.index == IndexUse::Auto) return {nullptr, before->making()};
    return chooseIndex(metadataFileOf(set), nullptr, options.index);
}

// Boxes are tested, and files read, without osgDB's cache of nodes: each tile stands in one place.
osg::ref_ptr<osgDB::Options> readingOptions(const osgDB::Options* own) {
    const osgDB::Options* const base = own ? own : osgDB::Registry::instance()->getOptions();
    osg::ref_ptr<osgDB::Options> options = base ? base->cloneOptions() : new osgDB::Options;
    options->setObjectCacheHint(
        static_cast<osgDB::Options::CacheHintOptions>(options->getObjectCacheHint() & ~osgDB::Options::CACHE_NODES));
    return options;
}

}  // namespace

bool BoxInstaller::isKnown(const std::string& file, std::size_t lods) const {
    if (!_index) return false;
    const auto found = _index->files().find(file);
    return found != _index->files().end() && found->second.size() == lods;
}

BoxInstaller::Content BoxInstaller::survey(osg::Node& node) const {
    const LodContent content = findLods(node);
    return {content.all(content.boxes(std::vector<MeshBox>(content.lods.size()))), true};
}

BoxInstaller::Content BoxInstaller::install(osg::Node& node, const std::string& file, BoxTile* parent) {
    const LodContent content = findLods(node);
    std::vector<osg::ref_ptr<BoxTile>> tiles;
    std::vector<Content> below;
    Pagings pagings;
    for (const FoundLod& lod : content.lods) {
        tiles.emplace_back(new BoxTile(lod.parent ? tiles[*lod.parent].get() : parent));
        below.push_back(installBelow(*lod.node, file, *tiles.back()));
        if (auto* const paged = dynamic_cast<osg::PagedLOD*>(lod.node)) {
            followPaging(*paged, file, *tiles.back(), pagings);
        }
    }
    const Content all = place(content, below, file, tiles);
    if (!_index) _set.awaitIndex(node, file, parent, tiles);
    return all;
}

// Gives the tiles of a file their boxes.
BoxInstaller::Content BoxInstaller::place(const LodContent& content, const std::vector<Content>& below,
                                          const std::string& file, const std::vector<osg::ref_ptr<BoxTile>>& tiles) {
    std::vector<MeshBox> loaded;
    for (const Content& files : below) loaded.push_back(files.box);
    const std::vector<MeshBox> boxes = content.boxes(loaded);
    std::vector<bool> fits(tiles.size(), isKnown(file, tiles.size()));
    Content all{content.all(boxes), _index && !isKnown(file, tiles.size())};
    for (std::size_t i = tiles.size(); i-- > 0;) {
        MeshBox box = boxes[i];
        if (fits[i]) {
            const MeshBox whole(_index->find(file, i)->bin);
            fits[i] = !below[i].isMisfit && whole.contains(box);
            box.expandBy(whole);
        }
        if (!fits[i] && content.lods[i].parent) fits[*content.lods[i].parent] = false;
        all.isMisfit = all.isMisfit || (_index && !fits[i]);
        tiles[i]->set(box, fits[i]);
    }
    placeCallbacks(content, tiles);
    if (all.isMisfit) _set.noteMisfit(file);
    return all;
}

bool BoxInstaller::isInGroup(const osg::Node& node) const {
    if (node.getNumParents() != 1) return false;
    const osg::Group& parent = *node.getParent(0);
    return &parent == _root || typeid(parent) == typeid(osg::Group);
}

// Children of groups are tested by their families.
void BoxInstaller::placeCallbacks(const LodContent& content, const std::vector<osg::ref_ptr<BoxTile>>& tiles) {
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        osg::LOD& node = *content.lods[i].node;
        if (isInGroup(node)) {
            _members[&node] = tiles[i];
        } else {
            BoxCullCallback::place(node, _set, *tiles[i]);
        }
    }
    for (osg::Group* const group : content.groups) placeFamily(*group);
    _installed += tiles.size();
}

void BoxInstaller::placeFamily(osg::Group& group) const {
    BoxFamily::place(group, _set, [this](const osg::Node& node) -> BoxTile* {
        const auto found = _members.find(&node);
        return found == _members.end() ? nullptr : found->second.get();
    });
}

BoxInstaller::Content BoxInstaller::installBelow(osg::LOD& node, const std::string& file, BoxTile& tile) {
    Content below;
    for (unsigned int i = 0; i < node.getNumChildren(); ++i) {
        if (!isPagedChildOf(node, i)) continue;
        const std::string& name = static_cast<osg::PagedLOD&>(node).getFileName(i);
        const Content content = install(*node.getChild(i), pagedFilePath(file, name), &tile);
        below.box.expandBy(content.box);
        below.isMisfit = below.isMisfit || content.isMisfit;
    }
    return below;
}

BoxInstaller::Paging BoxInstaller::makePaging(osgDB::Options* own) const {
    const osg::ref_ptr<osgDB::Options> options = readingOptions(own);
    const osg::ref_ptr<BoxReadFileCallback> callback =
        new BoxReadFileCallback(&_set, own, options->getReadFileCallback());
    options->setReadFileCallback(callback);
    return {own, options, callback.get()};
}

// One callback for all PagedLODs of a file, unless they came with several options, or name a file twice.
void BoxInstaller::followPaging(osg::PagedLOD& node, const std::string& file, BoxTile& tile, Pagings& pagings) const {
    raiseExpiry(node, _set.options().expiry);
    const osg::ref_ptr<osgDB::Options> own = dynamic_cast<osgDB::Options*>(node.getDatabaseOptions());
    const auto takes = [&](const Paging& paging) {
        if (paging.own != own) return false;
        for (unsigned int i = 0; i < node.getNumFileNames(); ++i) {
            if (isPagedChildOf(node, i) && paging.callback->expects(node.getDatabasePath() + node.getFileName(i)))
                return false;
        }
        return true;
    };
    auto paging = std::find_if(pagings.begin(), pagings.end(), takes);
    if (paging == pagings.end()) paging = pagings.insert(pagings.end(), makePaging(own.get()));
    for (unsigned int i = 0; i < node.getNumFileNames(); ++i) {
        if (!isPagedChildOf(node, i)) continue;
        paging->callback->expect(node.getDatabasePath() + node.getFileName(i), pagedFilePath(file, node.getFileName(i)),
                                 &tile);
    }
    node.setDatabaseOptions(paging->options.get());
}

std::size_t installBoxes(osg::Group& root, const CullOptions& options) {
    const osg::ref_ptr<BoxSet> before = boxSetOf(root);
    const osg::ref_ptr<BoxSet> set = new BoxSet(options, indexFor(root, options, before.get()));
    removeBoxes(root);
    BoxInstaller installer(*set, &root);
    for (unsigned int i = 0; i < root.getNumChildren(); ++i) {
        osg::Node& tile = *root.getChild(i);
        (void)installer.install(tile, photogrammetryFileOf(tile), nullptr);
    }
    installer.placeFamily(root);
    const osg::ref_ptr<BoxSetCullCallback> cull = new BoxSetCullCallback;
    cull->setNestedCallback(root.getCullCallback());
    root.setCullCallback(cull);
    root.addUpdateCallback(new BoxSetUpdateCallback(set));
    const bool isStarted = before && before->making() == set->making();
    if (set->making() && !isStarted) set->making()->start();
    return installer.installed();
}

BoxSet* boxSetOf(osg::Node& node) {
    const osg::ref_ptr<BoxSetUpdateCallback> update = findCallback<BoxSetUpdateCallback>(node.getUpdateCallback());
    return update ? &update->set() : nullptr;
}

void removeBoxes(osg::Group& root) {
    if (const osg::ref_ptr<osg::Callback> cull = findCallback<BoxSetCullCallback>(root.getCullCallback()))
        takeOff(root, *cull);
    BoxFamily::remove(root);
    const osg::ref_ptr<BoxSetUpdateCallback> update = findCallback<BoxSetUpdateCallback>(root.getUpdateCallback());
    if (!update) return;
    update->set().setRemoved();
    root.removeUpdateCallback(update);
    BoxRemover remover;
    root.accept(remover);
}

}  // namespace osgAnalyticBin
