// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "IndexAdoption.h"

#include "../install/InstalledTile.h"
#include "../install/TileFit.h"
#include "Database.h"

#include <algorithm>
#include <utility>

namespace osgAnalyticBin {

namespace {

// Where no update traversal ever comes.
constexpr std::size_t kMostContents = 65536;

// Returns: whether the tile waits for more.
bool adoptTile(const AwaitingTile& waiting, const AutoIndex& index, Database& database) {
    osg::ref_ptr<const ParentTile> link;
    osg::ref_ptr<AnalyticBinCullCallback> callback;
    if (!waiting.tile.lock(link) || !link->callback.lock(callback)) return false;
    const ParentTile& tile = *link;
    const bool isWhole = index.isWhole();
    const auto entry = index.find(tile.file, tile.ordinal);
    if (!entry || entry->fingerprint != waiting.fingerprint) {
        if (isWhole) Database::reportMisfit(tile, callback->getBin());
        return !isWhole;
    }
    // the index has no bin for this tile: it keeps the one that was made from the declared heights
    if (!entry->bin.valid()) return false;
    const TerrainShape shape = callback->getTerrainShape().value_or(TerrainShape());
    const IndexedFit fit = fitByEntry(*entry, isWhole, waiting.skirt, database, shape, tile);
    if (callback->getInstalledTile()) callback->getInstalledTile()->setTestsSphere(false);
    if (fit.bin.valid()) {
        callback->setSkirt(fit.skirt);
        callback->setBin(fit.bin);
    } else {
        callback->setBin({});
    }
    return !isWhole;
}

}  // namespace

void IndexAdoption::setIndex(AutoIndex* index) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _index = index;
    _isExpected = index != nullptr;
    if (!index) _contents.clear();
}

osg::ref_ptr<AutoIndex> IndexAdoption::index() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _index;
}

bool IndexAdoption::isAwaited() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _isExpected;
}

bool IndexAdoption::hasNews() const {
    const osg::ref_ptr<AutoIndex> index = this->index();
    if (!index || !index->isWhole()) return false;
    const std::lock_guard<std::mutex> lock(_mutex);
    return !_contents.empty() && (_next != 0 || _hasUnseen || _adoptedGeneration != index->generation());
}

bool IndexAdoption::hasWaiting() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return std::any_of(_contents.begin(), _contents.end(), [](const Content& content) {
        return std::any_of(content.tiles.begin(), content.tiles.end(),
                           [](const AwaitingTile& tile) { return tile.isPaged; });
    });
}

void IndexAdoption::await(osg::Node* content, std::vector<AwaitingTile> tiles) {
    const std::lock_guard<std::mutex> lock(_mutex);
    if (tiles.empty() || !_isExpected || _contents.size() > kMostContents) return;
    _contents.push_back({content == nullptr, content, std::move(tiles)});
    _hasUnseen = true;
}

void IndexAdoption::adopt(Database& database, std::size_t mostTiles) {
    const osg::ref_ptr<AutoIndex> index = this->index();
    if (!index) return;
    for (std::size_t looked = 0; looked < mostTiles;) {
        Content content;
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            if (_next == 0) {
                const bool isKnown = !_hasUnseen && _adoptedGeneration == index->generation();
                if (_contents.empty() || isKnown || index->generation() == 0) return;
                _roundGeneration = index->generation();
                _hasUnseen = false;
                _next = _contents.size();
            }
            // from the end: what is on its way is behind
            std::swap(_contents[--_next], _contents.back());
            content = std::move(_contents.back());
            _contents.pop_back();
            if (_next == 0) _adoptedGeneration = _roundGeneration;
        }
        ++looked;
        osg::ref_ptr<osg::Node> root;
        if (!content.isInScene && !content.root.lock(root)) continue;
        content.isInScene = content.isInScene || root->getNumParents() > 0;
        bool isWaiting = !content.isInScene;
        if (content.isInScene) {
            looked += content.tiles.size();
            const auto isDone = [&](const AwaitingTile& tile) { return !adoptTile(tile, *index, database); };
            content.tiles.erase(std::remove_if(content.tiles.begin(), content.tiles.end(), isDone),
                                content.tiles.end());
            isWaiting = !content.tiles.empty();
        }
        const std::lock_guard<std::mutex> lock(_mutex);
        if (!isWaiting) continue;
        _hasUnseen = _hasUnseen || !content.isInScene;
        _contents.push_back(std::move(content));
    }
}

}  // namespace osgAnalyticBin
