// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// How BinInstaller has the DatabasePager treat what it reads later.

#include "../page/BinReadFileCallback.h"
#include "../page/Database.h"
#include "../page/PagedFiles.h"
#include "BinInstaller.h"

#include <osg/PagedLOD>
#include <osgDB/Registry>

#include <algorithm>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

void BinInstaller::followPaging(osg::PagedLOD& node, const ParentTile* parent, bool isTile) {
    const osg::ref_ptr<osgDB::Options> own = dynamic_cast<osgDB::Options*>(node.getDatabaseOptions());
    const std::vector<PagedFile> files = filesPagedBy(node, frame(), isTile);
    Paging& paging = _paging[own];
    // One file may be paged in several places.
    const bool isTaken = paging.callback && std::any_of(files.begin(), files.end(), [&](const PagedFile& file) {
                             return paging.callback->expectsOtherwise(file.name, file.frame, parent);
                         });
    if (!paging.callback || isTaken) {
        const osgDB::Options* base = own ? own.get() : osgDB::Registry::instance()->getOptions();
        paging.options = base ? base->cloneOptions() : new osgDB::Options;
        paging.callback = new BinReadFileCallback(&database(), frame(), previousCallback(*paging.options));
        paging.callback->setReplaced(optionsWithoutBins(own.get()));
        paging.options->setReadFileCallback(paging.callback);
    }
    for (const PagedFile& file : files) paging.callback->expect(file.name, file.frame, parent);
    node.setDatabaseOptions(paging.options.get());
}

}  // namespace osgAnalyticBin
