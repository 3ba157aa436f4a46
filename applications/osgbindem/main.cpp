// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DatabaseBuilder.h"
#include "Failure.h"
#include "Interruption.h"
#include "ProgramRun.h"

#include <cpl_conv.h>
#include <gdal.h>
#include <osg/Notify>

#include <cstdlib>
#include <iostream>
#include <memory>
#include <new>
#include <optional>

namespace {

using osgAnalyticBin::support::ExitCode;
using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::kSucceeded;

using osgbindem::Settings;

/// A setting of GDAL's that the user's environment may have otherwise.
void setUnlessGiven(const char* name, const char* value) {
    if (CPLGetConfigOption(name, nullptr) == nullptr) CPLSetConfigOption(name, value);
}

void prepareProcess(const Settings& settings) {
    for (std::size_t i = 0; i + 1 < settings.config.size(); i += 2) {
        CPLSetConfigOption(settings.config[i].c_str(), settings.config[i + 1].c_str());
    }
    GDALAllRegister();
    GDALSetCacheMax64((GIntBig{settings.memoryMib} << 20) / 2);
    setUnlessGiven("GDAL_HTTP_MAX_RETRY", "5");
    setUnlessGiven("GDAL_HTTP_RETRY_DELAY", "1");
    CPLSetErrorHandler(CPLQuietErrorHandler);
    if (std::getenv("OSG_NOTIFY_LEVEL") == nullptr) osg::setNotifyLevel(osg::ALWAYS);
    osgAnalyticBin::support::stopOnSignals();
}

ExitCode run(int argc, char** argv) {
    std::optional<Settings> settings = osgbindem::settingsFrom(argc, argv);
    if (!settings) return kSucceeded;
    const std::unique_ptr<osgbindem::Ranks> ranks = osgbindem::joinRanks();
    if (ranks->count() > 1 && settings->update) {
        throw osgAnalyticBin::support::UsageError("--update is the work of one process; run it without mpirun");
    }
    if (!settings->threads) settings->threads = osgbindem::threadsPerRank(*ranks);
    prepareProcess(*settings);
    if (settings->update) {
        osgbindem::updateDatabase(*settings);
    } else {
        osgbindem::buildDatabase(*settings, *ranks);
    }
    return kSucceeded;
}

}  // namespace

int main(int argc, char** argv) {
    const bool isSpeaker = osgbindem::isSpeaker();
    if (!isSpeaker) {
        for (std::ostream* stream : {&std::cout, &std::cerr}) stream->setstate(std::ios::failbit);
    }
    const ExitCode code = osgAnalyticBin::support::runProgram("osgbindem", [&] {
        try {
            return run(argc, argv);
        } catch (const std::bad_alloc&) {
            throw Failure("out of memory; use fewer --threads or fewer --cells");
        }
    });
    // Every rank finds the same faults in the command line, and the first one tells what goes wrong later. The others
    // end in peace: mpirun would end the first before it has spoken.
    return isSpeaker || code == osgAnalyticBin::support::kInterrupted ? code : kSucceeded;
}
