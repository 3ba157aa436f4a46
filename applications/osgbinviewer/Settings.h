// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/CullOptions.h>

#include <osg/ArgumentParser>

#include <iosfwd>
#include <string>
#include <vector>

namespace osgAnalyticBin::viewer {

/// A database on the command line.
struct NamedDatabase {
    std::string given;   ///< as the user wrote it
    std::string loaded;  ///< as the pseudo-loader takes it
};

/// What the command line says beside what osgViewer itself reads from it.
struct Settings {
    std::vector<NamedDatabase> databases;
    CullOptions cullOptions;
    std::string record;
    std::string poses;
    std::string steps;
    std::vector<std::string> animationPaths;
    double speed = 1.0;
    unsigned int traffic = 0;  ///< models
};

/// Names the options for --help.
void describe(osg::ApplicationUsage& usage);

/// Writes what --help says; `helpType` as OSG's ArgumentParser reads it.
void printHelp(std::ostream& out, osg::ApplicationUsage& usage, unsigned int helpType);

/// Throws: std::runtime_error with one line for what cannot be understood.
[[nodiscard]] Settings settingsFrom(osg::ArgumentParser& arguments);

}  // namespace osgAnalyticBin::viewer
