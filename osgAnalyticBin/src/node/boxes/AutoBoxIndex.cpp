// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "AutoBoxIndex.h"

#include "BoxSurvey.h"

#include <osgAnalyticBin/PhotogrammetrySet.h>
#include <osgAnalyticBin/index/Failure.h>

#include <osg/Notify>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>

#include <algorithm>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

namespace {

// An index of more files takes more memory in a viewer than the tiles that are shown.
constexpr std::size_t kMostFiles = 1000000;

std::vector<std::string> rootsOf(const std::string& metadataFile) {
    std::string error;
    std::vector<std::string> roots = findPhotogrammetryFiles(metadataFile, error).roots;
    if (roots.empty()) throw indexing::Failure(error);
    return roots;
}

// Returns: null where there is none, or with the reason in `error`, where it is broken.
osg::ref_ptr<BoxIndex> readIfThere(const std::string& path, std::string& error) {
    return !path.empty() && osgDB::fileExists(path) ? BoxIndex::read(path, error) : nullptr;
}

}  // namespace

AutoBoxIndex::AutoBoxIndex(const std::string& metadataFile, osg::ref_ptr<BoxIndex> kept)
    : BackgroundIndex(metadataFile), _kept(std::move(kept)), _known(new BoxIndex) {}

std::optional<BoxIndex::Boxes> AutoBoxIndex::find(const std::string& file) const {
    const auto guard = lock();
    const auto found = _known->files().find(file);
    return found == _known->files().end() ? std::nullopt : std::optional(found->second);
}

osg::ref_ptr<const BoxIndex> AutoBoxIndex::whole() const {
    if (!isWhole()) return nullptr;
    const auto guard = lock();
    return _known;
}

bool AutoBoxIndex::isCurrent(const BoxIndex& index, const indexing::DatabaseFiles& files,
                             const std::function<void()>& checkpoint) {
    std::string error;
    const std::vector<std::string> roots = findPhotogrammetryFiles(files.rootFile(), error).roots;
    const auto isKnown = [&](const std::string& root) { return index.stamps().count(root) > 0; };
    return std::all_of(roots.begin(), roots.end(), isKnown) && indexing::areCurrent(index.stamps(), files, checkpoint);
}

void AutoBoxIndex::make() {
    if (_kept && isCurrent(*_kept, indexing::DatabaseFiles(rootFile()), [this] { throwIfStopped(); })) {
        publish(true, [this] { _known = std::exchange(_kept, nullptr); });
        return;
    }
    _kept = nullptr;
    constexpr int kMostRounds = 3;
    for (int round = 0; round < kMostRounds; ++round) {
        if (makeOnce()) return;
    }
    throw indexing::Failure("its files change all the time");
}

// Returns: whether no file was changed meanwhile.
bool AutoBoxIndex::makeOnce() {
    BoxIndexProgress progress;
    progress.goesOn = [this] {
        giveWay();
        return true;
    };
    BinIndex::Stamps stamps;
    for (const std::string& root : rootsOf(rootFile())) {
        const osg::ref_ptr<BoxIndex> part = surveyBoxes(rootFile(), {root}, 1, progress);
        stamps.insert(part->stamps().begin(), part->stamps().end());
        if (stamps.size() > kMostFiles) {
            throw indexing::Failure("it has more than " + std::to_string(kMostFiles) +
                                    " files; run osgbinconv --index");
        }
        publish(false, [&] {
            for (const auto& [file, boxes] : part->files()) _known->add(file, boxes);
        });
    }
    const BoxIndex& index = *_known;
    publish(false, [&] { _known->setStamps(std::move(stamps)); });
    if (!isCurrent(index, indexing::DatabaseFiles(rootFile()), [this] { throwIfStopped(); })) {
        publish(false, [this] { _known = new BoxIndex; });
        return false;
    }
    publish(true, [] {});
    keep({boxIndexPath(rootFile()), BoxIndex::kMagic, [&](std::ostream& out) { return index.write(out); }},
         std::to_string(index.numBoxes()) + " boxes");
    return true;
}

ChosenBoxIndex chooseBoxIndex(const std::string& metadataFile, IndexUse use) {
    if (use == IndexUse::Off || metadataFile.empty()) return {};
    const bool isMade = use == IndexUse::Auto && osgDB::fileType(metadataFile) == osgDB::REGULAR_FILE;
    std::string error;
    const std::string beside = boxIndexPath(metadataFile);
    osg::ref_ptr<BoxIndex> index = readIfThere(beside, error);
    if (!index && isMade) {
        index = readIfThere(indexing::cachedIndexName(metadataFile, osgDB::getFileExtension(beside)), error);
        if (index && index->stamps().empty()) index = nullptr;
    }
    if (!index && !error.empty()) {
        OSG_WARN << "osgAnalyticBin: " << error
                 << (isMade ? "; that is done in the background now" : "; the set is culled without it") << std::endl;
    }
    return chosenFrom<AutoBoxIndex>(index, metadataFile, isMade);
}

}  // namespace osgAnalyticBin
