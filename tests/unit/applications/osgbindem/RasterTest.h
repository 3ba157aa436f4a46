// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// osgbindem as users run it, and its parts; rasters for it.

#pragma once

#include "DemMosaic.h"
#include "LoadedDatabase.h"
#include "RasterFile.h"

#include <support/Programs.h>
#include <support/TemporaryFolder.h>

using osgAnalyticBin::test::Files;
using osgAnalyticBin::test::filesBelow;
using osgAnalyticBin::test::Outcome;
using Words = std::vector<std::string>;

/// One list after the other.
[[nodiscard]] inline Words joined(Words first, const Words& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

/// Runs osgbindem. `fullDisk`: with so many blocks of 512 bytes as the most that a file may have.
[[nodiscard]] inline Outcome run(const Words& arguments, int fullDisk = 0) {
    using namespace osgAnalyticBin::test;
    const std::string command = quoted(joined({OSGBINDEM_PROGRAM}, arguments));
    return runStock(fullDisk > 0 ? onFullDisk(command, fullDisk) : command, Modules::Present);
}

/// Runs osgbindem, which has to succeed in silence.
inline void build(const Words& arguments) {
    const Outcome outcome = run(joined({"--quiet"}, arguments));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    ASSERT_EQ(outcome.text, "");
}

/// Runs osgbindem, which has to fail with one line that says what is wrong.
inline void expectFailure(const Words& arguments, const std::string& what, int code = 1, int fullDisk = 0) {
    expectOneLine(run(joined({"--quiet"}, arguments), fullDisk), "osgbindem", what, code);
}

/// Builds a database by a command line, to which -o is added, and loads it.
[[nodiscard]] inline LoadedDatabase databaseOf(const Words& arguments) {
    const osgAnalyticBin::test::TemporaryFolder folder;
    build(joined(arguments, {"-o", folder / "earth.osgb"}));
    return loadDatabase(folder / "earth.osgb");
}

/// The heights of rasters that a command line names, without a database.
[[nodiscard]] inline osgbindem::DemMosaic mosaicOf(const Words& arguments) {
    GDALAllRegister();
    std::vector<const char*> words{"osgbindem", "-o", "earth.osgb"};
    for (const std::string& word : arguments) words.push_back(word.c_str());
    const auto settings = osgbindem::settingsFrom(static_cast<int>(words.size()), words.data());
    return osgbindem::DemMosaic(osgbindem::withDeclaredRadii(settings.value()));
}

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
