// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Commands.h"
#include "Failure.h"
#include "Interruption.h"
#include "Progress.h"

#include <osgAnalyticBin/BoxIndex.h>

#include <osgDB/FileNameUtils>

#include <iostream>

namespace osgbinconv {

using osgAnalyticBin::BoxIndex;
using osgAnalyticBin::boxIndexPath;
using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::stopRequested;
using osgAnalyticBin::support::throwIfStopRequested;

namespace {

osg::ref_ptr<BoxIndex> indexOf(const std::string& metadataFile, const WalkOptions& options) {
    Progress progress("read", options.isQuiet);
    osgAnalyticBin::BoxIndexProgress told;
    told.fileDone = [&](std::size_t boxes, double share) { progress.add(boxes, share); };
    told.unreadable = [](const std::string& line) { std::cerr << "osgbinconv: " << line << std::endl; };
    told.goesOn = [] { return !stopRequested.load(); };
    std::string error;
    osg::ref_ptr<BoxIndex> index = osgAnalyticBin::makeBoxIndex(metadataFile, options.threads, told, error);
    throwIfStopRequested();
    if (!index) throw Failure(error);
    progress.finish();
    return index;
}

}  // namespace

bool isPhotogrammetry(const std::string& file) {
    return osgDB::getLowerCaseFileExtension(file) == "xml";
}

void writeBoxIndex(const std::string& metadataFile, const WalkOptions& options) {
    const osg::ref_ptr<BoxIndex> index = indexOf(metadataFile, options);
    std::string error;
    if (!index->write(boxIndexPath(metadataFile), error)) throw Failure(error);
    std::cout << boxIndexPath(metadataFile) << ": " << index->numBoxes() << " boxes of " << index->numFiles()
              << " files" << std::endl;
}

void checkBoxIndex(const std::string& metadataFile, const WalkOptions& options) {
    std::string error;
    const osg::ref_ptr<BoxIndex> known = BoxIndex::read(boxIndexPath(metadataFile), error);
    if (!known) throw Failure(error);
    const osg::ref_ptr<BoxIndex> index = indexOf(metadataFile, options);
    for (const auto& [file, boxes] : index->files()) {
        const auto found = known->files().find(file);
        if (found == known->files().end() || found->second != boxes)
            throw Failure("\"" + boxIndexPath(metadataFile) + "\" does not fit \"" + file +
                          "\"; make it again: osgbinconv --index");
    }
    std::cout << boxIndexPath(metadataFile) << " fits " << index->numFiles() << " files" << std::endl;
}

}  // namespace osgbinconv
