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

// Returns: null where there is none, or with the reason in `error`, where it is broken.
osg::ref_ptr<BoxIndex> readIfThere(const std::string& path, std::string& error) {
    return !path.empty() && osgDB::fileExists(path) ? BoxIndex::read(path, error) : nullptr;
}

}  // namespace

bool isCurrent(const BoxIndex& index, const indexing::DatabaseFiles& files, const std::function<void()>& checkpoint) {
    std::string error;
    const std::vector<std::string> roots = findPhotogrammetryFiles(files.rootFile(), error).roots;
    const auto isKnown = [&](const std::string& root) { return index.stamps().count(root) > 0; };
    return std::all_of(roots.begin(), roots.end(), isKnown) && indexing::areCurrent(index.stamps(), files, checkpoint);
}

osg::ref_ptr<BoxIndex> AutoBoxIndex::makeFrom(const indexing::DatabaseFiles&) {
    std::size_t files = 0;
    BoxIndexProgress progress;
    progress.goesOn = [&] {
        giveWay();
        if (++files <= kMostFiles) return true;
        throw indexing::Failure("it has more than " + std::to_string(kMostFiles) + " files; run osgbinconv --index");
    };
    std::string error;
    osg::ref_ptr<BoxIndex> index = surveyBoxes(rootFile(), 1, progress, error);
    if (!index) throw indexing::Failure(error);
    return index;
}

void AutoBoxIndex::keepWhole(const BoxIndex& index) {
    keep({boxIndexPath(rootFile()), BoxIndex::kMagic, [&](std::ostream& out) { return index.write(out); }},
         std::to_string(index.numBoxes()) + " boxes");
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
