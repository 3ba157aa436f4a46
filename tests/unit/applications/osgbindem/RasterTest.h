// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// osgbindem as users run it, and its parts.

#pragma once

#include "DemMosaic.h"
#include "LoadedDatabase.h"
#include "TestRaster.h"

#include <gtest/gtest.h>

#include <string>
#include <support/FailureText.h>
#include <support/TemporaryFolder.h>
#include <vector>

using osgAnalyticBin::test::Files;
using osgAnalyticBin::test::filesBelow;
using osgAnalyticBin::test::Outcome;
using Words = std::vector<std::string>;

/// One list after the other.
[[nodiscard]] Words joined(Words first, const Words& second);

/// Runs osgbindem. `fullDisk`: with so many blocks of 512 bytes as the most that a file may have.
[[nodiscard]] Outcome run(const Words& arguments, int fullDisk = 0);

/// Runs osgbindem, which has to succeed in silence.
void build(const Words& arguments);

/// Runs osgbindem, which has to fail with one line that says what is wrong.
void expectFailure(const Words& arguments, const std::string& what, int code = 1, int fullDisk = 0);

/// Builds a database by a command line, to which -o is added, and loads it.
[[nodiscard]] LoadedDatabase databaseOf(const Words& arguments);

/// The heights of rasters that a command line names, without a database.
[[nodiscard]] osgbindem::DemMosaic mosaicOf(const Words& arguments);

/// Rasters, and what is made of them, in a folder of their own.
class RasterTest : public testing::Test {
protected:
    [[nodiscard]] std::string file(const std::string& name) const { return _folder / name; }

    /// Writes a raster into a new file. Returns: the file.
    std::string saved(const TestRaster& raster) {
        return raster.write(file("raster" + std::to_string(_rasters++) + ".tif"));
    }
    std::string savedGlobe(double spacingDeg, const TestRaster::Height& height) {
        return saved(TestRaster::globe(spacingDeg, height));
    }

    const osgAnalyticBin::test::TemporaryFolder _folder;

private:
    int _rasters = 0;
};
