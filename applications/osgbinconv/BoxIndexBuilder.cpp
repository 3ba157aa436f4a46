// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Commands.h"
#include "Failure.h"
#include "Interruption.h"
#include "Progress.h"

#include <osgAnalyticBin/BoxIndex.h>
#include <osgAnalyticBin/PhotogrammetrySet.h>

#include <algorithm>
#include <iostream>

namespace osgbinconv {

using osgAnalyticBin::BinIndex;
using osgAnalyticBin::binIndexName;
using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::stopRequested;
using osgAnalyticBin::support::throwIfStopRequested;

namespace {

osg::ref_ptr<BinIndex> indexOf(const std::string& metadataFile, const WalkOptions& options) {
    Progress progress("read", options.isQuiet);
    osgAnalyticBin::BoxIndexProgress told;
    told.fileDone = [&](std::size_t boxes, double share) { progress.add(boxes, share); };
    told.unreadable = [](const std::string& line) { std::cerr << "osgbinconv: " << line << std::endl; };
    told.goesOn = [] { return !stopRequested.load(); };
    std::string error;
    osg::ref_ptr<BinIndex> index = osgAnalyticBin::makeBoxIndex(metadataFile, options.threads, told, error);
    throwIfStopRequested();
    if (!index) throw Failure(error);
    progress.finish();
    return index;
}

bool areSame(const std::vector<BinIndex::Entry>& a, const std::vector<BinIndex::Entry>& b) {
    return std::equal(
        a.begin(), a.end(), b.begin(), b.end(),
        [](const BinIndex::Entry& one, const BinIndex::Entry& two) { return one.bin.bin() == two.bin.bin(); });
}

}  // namespace

bool isPhotogrammetry(const std::string& file) {
    return osgAnalyticBin::isMetadataName(file);
}

void writeBoxIndex(const std::string& metadataFile, const WalkOptions& options) {
    const osg::ref_ptr<BinIndex> index = indexOf(metadataFile, options);
    std::string error;
    if (!index->write(binIndexName(metadataFile), error)) throw Failure(error);
    std::cout << binIndexName(metadataFile) << ": " << index->tileCount() << " boxes of " << index->fileCount()
              << " files" << std::endl;
}

void checkBoxIndex(const std::string& metadataFile, const WalkOptions& options) {
    std::string error;
    const osg::ref_ptr<BinIndex> known = BinIndex::read(binIndexName(metadataFile), error);
    if (!known) throw Failure(error);
    const osg::ref_ptr<BinIndex> index = indexOf(metadataFile, options);
    for (const auto& [file, boxes] : index->files()) {
        const std::vector<BinIndex::Entry>* const found = known->tilesOf(file);
        if (!found || !areSame(*found, boxes))
            throw Failure("\"" + binIndexName(metadataFile) + "\" does not fit \"" + file +
                          "\"; make it again: osgbinconv --index");
    }
    std::cout << binIndexName(metadataFile) << " fits " << index->fileCount() << " files" << std::endl;
}

}  // namespace osgbinconv
