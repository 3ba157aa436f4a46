// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// How BinInstaller treats what the DatabasePager reads later.

#include "../database/Database.h"
#include "../database/DatabaseCallbacks.h"
#include "BinInstaller.h"

namespace osgAnalyticBin {

// The database whose tiles this installer puts bins on.
class BinInstaller::InstallingDatabase final : public Database {
public:
    using Database::Database;

    std::size_t install(osg::Node& content, const TileFrame& frame, InstalledTile* parent) override {
        BinInstaller installer(options());
        installer.continueBelow(this, frame, parent);
        content.accept(installer);
        installer.finish();
        return installer.installed();
    }
    void watch(osg::Group& group) override { watchFamily(group); }
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

}  // namespace osgAnalyticBin
