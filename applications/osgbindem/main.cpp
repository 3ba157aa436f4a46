// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CommandLine.h"
#include "DatabaseBuilder.h"
#include "DatabaseUpdate.h"
#include "Interruption.h"

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
    std::cerr << "osgbindem: " << message << std::endl;
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
    const std::optional<Settings> settings = osgbindem::settingsFrom(argc, argv);
    if (!settings) return EXIT_SUCCESS;
    prepareProcess(*settings);
    if (settings->update) {
        osgbindem::updateDatabase(*settings);
    } else {
        osgbindem::buildDatabase(*settings);
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
