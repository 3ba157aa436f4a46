// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// How BinInstaller treats what the DatabasePager reads later.

#include "../page/BinReadFileCallback.h"
#include "../page/Database.h"
#include "../page/DatabaseCallbacks.h"
#include "BinInstaller.h"

#include <osg/PagedLOD>
#include <osgDB/Registry>

#include <algorithm>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

// The database whose tiles this installer puts bins on.
class BinInstaller::InstallingDatabase final : public Database {
public:
    using Database::Database;

    void install(osg::Node& content, const TileFrame& frame, const ParentTile* parent) override {
        BinInstaller installer(options());
        installer.continueBelow(this, frame, parent);
        content.accept(installer);
        installer.finish();
    }
    void refit(osg::Node& root) override {
        BinInstaller installer(options());
        installer.refit(root, *this);
    }
    void installOnClone(osg::Node& root) override {
        BinInstaller installer(options());
        installer.setIndex(index().get());
        installer.installAt(root);
        if (const osg::ref_ptr<Database> own = attachedDatabase(root)) own->setMaking(making().get());
    }

protected:
    ~InstallingDatabase() override = default;
};

osg::ref_ptr<Database> BinInstaller::newDatabase(const osg::EllipsoidModel* ellipsoid,
                                                 osgTerrain::Terrain* terrain) const {
    return new InstallingDatabase(_options, ellipsoid, terrain, _index.get());
}

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
