// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "KitTest.h"

namespace osgAnalyticBin::test {

inline CullOptions withOcclusion(OcclusionUse use = OcclusionUse::On) {
    CullOptions options;
    options.occlusion = use;
    return options;
}

// A globe of 32 tiles, of which one has a row of tiles of 0.2 degrees along the equator: a plain, and in the third tile
// a ridge, which tile 4 lies behind. The eye is above the middle of tile 0.
struct RidgeGlobe : MeshGlobe {
    explicit RidgeGlobe(double ridgeHeight = 8000.0, int tilesInRow = 10) {
        root->removeChild(tiles[20]);
        const auto add = [this](double south, double north, double west, double east, double height) {
            row.push_back(makePaged(makeMeshTile(extentsDeg(south, north, west, east), height), "no.osgb"));
            // what is below the tiles may have any height
            setStoredBin(*row.back(),
                         AnalyticBin(extentsDeg(south, north, west, east).withAltitude({-12000.0, 9000.0}), 10.0));
            root->addChild(row.back());
        };
        for (int i = 0; i < tilesInRow; ++i) add(0, 0.2, 0.2 * i, 0.2 * i + 0.2, i == 2 ? ridgeHeight : 0.0);
        add(0, 0.2, 0.2 * tilesInRow, 45, 0.0);
        add(0.2, 45, 0, 45, 0.0);
    }

    [[nodiscard]] static CullView alongRow(double altitude = 1000.0) {
        return CullView::lookAt(ecefDeg(0.1, 0.1, altitude), ecefDeg(0.1, 1.0, altitude), {1, 0, 0}, 30.0);
    }
    [[nodiscard]] bool drawsFarTile(const CullView& view = alongRow()) { return draws(*row[4], view); }

    std::vector<osg::ref_ptr<osg::PagedLOD>> row;
};

// With bins that look for what is hidden.
struct InstalledRidge : RidgeGlobe {
    explicit InstalledRidge(double ridgeHeight = 8000.0, int tilesInRow = 10) : RidgeGlobe(ridgeHeight, tilesInRow) {
        installBins(*root, withOcclusion());
    }
};

}  // namespace osgAnalyticBin::test
