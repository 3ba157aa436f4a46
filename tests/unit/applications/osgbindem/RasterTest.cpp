// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RasterTest.h"

#include "RasterFile.h"

using osgAnalyticBin::test::Modules;
using osgAnalyticBin::test::quoted;

Words joined(Words first, const Words& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

Outcome run(const Words& arguments, int fullDisk) {
    const std::string command = quoted(joined({OSGBINDEM_PROGRAM}, arguments));
    using osgAnalyticBin::test::onFullDisk;
    return runStock(fullDisk > 0 ? onFullDisk(command, fullDisk) : command, Modules::Present);
}

void build(const Words& arguments) {
    const Outcome outcome = run(joined({"--quiet"}, arguments));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    ASSERT_EQ(outcome.text, "");
}

void expectFailure(const Words& arguments, const std::string& what, int code, int fullDisk) {
    expectOneLine(run(joined({"--quiet"}, arguments), fullDisk), "osgbindem", what, code);
}

LoadedDatabase databaseOf(const Words& arguments) {
    const osgAnalyticBin::test::TemporaryFolder folder;
    build(joined(arguments, {"-o", folder / "earth.osgb"}));
    return loadDatabase(folder / "earth.osgb");
}

osgbindem::DemMosaic mosaicOf(const Words& arguments) {
    GDALAllRegister();
    std::vector<const char*> words{"osgbindem", "-o", "earth.osgb"};
    for (const std::string& word : arguments) words.push_back(word.c_str());
    const auto settings = osgbindem::settingsFrom(static_cast<int>(words.size()), words.data());
    return osgbindem::DemMosaic(osgbindem::withDeclaredRadii(settings.value()));
}
