// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Terrain.h"

#include <string>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::paper {

/// Mountains and seas that differ everywhere, from -6000 to 6000 m.
[[nodiscard]] double hills(double latitudeDeg, double longitudeDeg);

/// A raster of the hills as a text file, `spacing` degrees apart, from the south-west corner on.
[[nodiscard]] std::string writeHills(const test::TemporaryFolder& folder, const std::string& name, double west,
                                     double south, int columns, int rows, double spacing);

/// A raster of the hills all round the globe, in a folder of its own.
class TestGlobe {
public:
    TestGlobe();

    [[nodiscard]] const std::string& file() const { return _file; }

    /// Its terrain, with levels 0 to `deepestLevel`.
    [[nodiscard]] Terrain terrain(int deepestLevel) const;

private:
    test::TemporaryFolder _folder;
    std::string _file;
};

}  // namespace osgAnalyticBin::paper
