// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// osgbindem as users run it, and its parts; images and rasters for it.

#pragma once

#include "DemMosaic.h"
#include "LoadedDatabase.h"
#include "TestRaster.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <support/FailureText.h>
#include <support/TemporaryFolder.h>
#include <vector>

/// Red, green, blue.
using Colour = std::array<int, 3>;

/// How a file says that it has no pixel somewhere.
enum class Hole { Alpha, Mask, Nodata, Palette };

/// An image, square degree by square degree: `pixels` by `pixels` from the north-west corner on.
struct TestImage {
    TestImage(double westDeg, double northDeg, double pixelDeg, int side, const Colour& colour);

    /// Round the globe: twice as many columns as rows.
    [[nodiscard]] static TestImage globe(double spacingDeg, const Colour& colour);

    /// Writes a file. Returns: its path.
    std::string write(const std::string& path) const;

    double west, north, spacingDeg;
    int pixels;
    /// nullopt: a hole. With a palette there is one colour.
    std::function<std::optional<Colour>(double latitudeDeg, double longitudeDeg)> colourAt;
    Hole hole = Hole::Alpha;
};

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
