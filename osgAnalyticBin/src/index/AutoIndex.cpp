// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "AutoIndex.h"

#include "IndexStore.h"

#include <osgAnalyticBin/index/DatabaseWalk.h>
#include <osgAnalyticBin/index/Failure.h>
#include <osgAnalyticBin/index/MadeIndex.h>

#include <osg/Notify>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

namespace {

using indexing::DatabaseFiles;

// An index of more files takes more memory in a viewer than the tiles that are shown.
constexpr std::size_t kMostTiles = 2000000;

// Returns: the path of a database in a local file, outside of archives; else empty.
std::string localRoot(const std::string& databaseFileName, const osgDB::Options* options) {
    const std::string root = osgDB::findDataFile(databaseFileName, options);
    std::error_code ignored;
    const bool isLocal =
        !root.empty() && !osgDB::containsServerAddress(root) && std::filesystem::is_regular_file(root, ignored);
    const auto& archives = osgDB::Registry::instance()->getArchiveExtensions();
    const std::string extension = osgDB::getLowerCaseFileExtension(root);
    return isLocal && std::find(archives.begin(), archives.end(), extension) == archives.end() ? root : std::string();
}

// The index that was kept in the cache folder. What is broken there is made anew.
osg::ref_ptr<BinIndex> readCached(const std::string& root, std::string& error) {
    const std::string cached = indexing::cachedIndexName(root);
    std::error_code ignored;
    if (cached.empty() || !std::filesystem::exists(cached, ignored)) return nullptr;
    osg::ref_ptr<BinIndex> index = BinIndex::read(cached, error);
    const bool isOther = index && (index->source().name != osgDB::getSimpleFileName(root) || index->stamps().empty());
    return isOther ? nullptr : index;
}

}  // namespace

// What the thread does between the files.
class AutoIndex::Observer final : public indexing::WalkObserver {
public:
    explicit Observer(AutoIndex& index) : _index(index) {}

    void beforeFile() override { _index.giveWay(); }
    void done(const indexing::FileRecord& record, bool, double) override { _index.countTiles(record.tiles.size()); }

private:
    AutoIndex& _index;
};

void AutoIndex::countTiles(std::size_t more) {
    _tiles += more;
    if (_tiles <= kMostTiles) return;
    throw indexing::Failure("it has more than " + std::to_string(kMostTiles) + " tiles; run osgbinconv --index");
}

osg::ref_ptr<BinIndex> AutoIndex::makeFrom(const DatabaseFiles& files) {
    _tiles = 0;
    Observer observer(*this);
    indexing::MadeIndex made = indexing::indexFrom(files, indexing::walkDatabase(files, {}, observer, 1));
    BinIndex::Stamps stamps;
    for (const auto& [file, record] : made.records) stamps[file] = record.stamp;
    made.index->setStamps(std::move(stamps));
    return made.index;
}

bool AutoIndex::isUpToDate(const BinIndex& index, const DatabaseFiles& files) const {
    return indexing::areCurrent(index.stamps(), files, [this] { throwIfStopped(); });
}

void AutoIndex::publish(const osg::ref_ptr<const BinIndex>& index) {
    BackgroundIndex::publish([&] { _whole = index; });
}

void AutoIndex::make() {
    const DatabaseFiles files(rootFile());
    const osg::ref_ptr<const BinIndex> kept = std::exchange(_kept, nullptr);
    if (kept && isUpToDate(*kept, files)) return publish(kept);
    constexpr int kMostRounds = 3;
    for (int round = 0; round < kMostRounds; ++round) {
        const osg::ref_ptr<const BinIndex> index = makeFrom(files);
        if (!isUpToDate(*index, files)) continue;  // files were changed meanwhile
        publish(index);
        return keep(*index);
    }
    throw indexing::Failure("its files change all the time");
}

ChosenIndex chooseIndex(const std::string& databaseFileName, const osgDB::Options* readOptions, IndexUse use) {
    if (use == IndexUse::Off || databaseFileName.empty()) return {};
    const std::string root = localRoot(databaseFileName, readOptions);
    std::string error;
    osg::ref_ptr<BinIndex> index = readBinIndex(databaseFileName, readOptions, error);
    const bool isMade = use == IndexUse::Auto && !root.empty();
    std::string cacheError;
    if (!index && isMade) index = readCached(root, cacheError);
    if (error.empty()) error = cacheError;
    if (!error.empty()) {
        OSG_WARN << "osgAnalyticBin: " << error << (isMade ? "; that is done in the background now" : "") << std::endl;
    }
    // stamps of so many files are compared before the first frame
    constexpr std::size_t kFewFiles = 4096;
    if (index && index->stamps().empty()) return {index, nullptr};
    // times of files in archives and on servers are not known
    if (index && root.empty()) return {};
    const bool isSoonCompared = index && (!isMade || index->stamps().size() <= kFewFiles);
    if (isSoonCompared && indexing::areCurrent(index->stamps(), DatabaseFiles(root), [] {})) return {index, nullptr};
    if (isSoonCompared) index = nullptr;
    return {nullptr, isMade ? new AutoIndex(root, index) : nullptr};
}

}  // namespace osgAnalyticBin
