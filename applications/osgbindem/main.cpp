// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CommandLine.h"
#include "DatabaseBuilder.h"
#include "DatabaseUpdate.h"
#include "Failure.h"
#include "Interruption.h"
#include "Ranks.h"

#include <cpl_conv.h>
#include <gdal.h>
#include <osg/Notify>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <optional>
#include <string>

namespace {

using osgAnalyticBin::support::Interrupted;
using osgAnalyticBin::support::stopRequested;

using osgbindem::Settings;

constexpr int kInterrupted = 130;

int complain(const std::string& message) {
    // Every rank finds the same faults in the command line, and the first one tells what goes wrong later. The others
    // end in peace: mpirun would end the first before it has spoken.
    if (!osgbindem::Ranks::isSpeaker()) return EXIT_SUCCESS;
    std::cerr << "osgbindem: " + message + "\n" << std::flush;
    return EXIT_FAILURE;
}

void requestStop(int) {
    stopRequested.store(true);
}

/// A setting of GDAL's that the user's environment may have otherwise.
void setUnlessGiven(const char* name, const char* value) {
    if (CPLGetConfigOption(name, nullptr) == nullptr) CPLSetConfigOption(name, value);
}

void prepareProcess(const Settings& settings) {
    GDALAllRegister();
    GDALSetCacheMax64((GIntBig{settings.memoryMib} << 20) / 2);
    setUnlessGiven("GDAL_HTTP_MAX_RETRY", "5");
    setUnlessGiven("GDAL_HTTP_RETRY_DELAY", "1");
    CPLSetErrorHandler(CPLQuietErrorHandler);
    if (std::getenv("OSG_NOTIFY_LEVEL") == nullptr) osg::setNotifyLevel(osg::ALWAYS);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, requestStop);
    std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is an error like a full disk
}

int run(int argc, char** argv) {
    if (!osgbindem::Ranks::isSpeaker()) std::cout.setstate(std::ios::failbit);  // only one rank speaks
    std::optional<Settings> settings = osgbindem::settingsFrom(argc, argv);
    if (!settings) return EXIT_SUCCESS;
    const osgbindem::Ranks ranks;
    if (ranks.count() > 1 && settings->update) {
        throw osgAnalyticBin::support::Failure("--update is the work of one process; run it without mpirun");
    }
    if (!settings->areThreadsGiven) settings->threads = osgbindem::threadsPerRank(ranks);
    prepareProcess(*settings);
    if (settings->update) {
        osgbindem::updateDatabase(*settings);
    } else {
        osgbindem::buildDatabase(*settings, ranks);
    }
    return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const Interrupted& interrupted) {
        complain(interrupted.what());
        return kInterrupted;
    } catch (const std::bad_alloc&) {
        return complain("out of memory; use fewer --threads or fewer --cells");
    } catch (const std::exception& error) {
        return complain(error.what());
    }
}
