// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Settings.h"

#include "Failure.h"

#include <osgDB/FileNameUtils>

#include <ostream>

namespace osgAnalyticBin::viewer {

void describe(osg::ApplicationUsage& usage) {
    usage.setDescription("osgbinviewer shows a terrain database culled by its analytic bins, and what the bins do.");
    usage.setCommandLineUsage("osgbinviewer [options] DATABASE ...");
    usage.addCommandLineOption("-h or --help", "Display this information.");
    usage.addCommandLineOption("--version", "Display the version.");
    usage.addCommandLineOption("--options <text>",
                               "Culling, as \"method=exact,horizon=off\"; see osgconv --format analyticbin.");
    usage.addCommandLineOption("--record <file.path>",
                               "Record the camera for osgbinbench from the start; key z stops and starts.");
    usage.addCommandLineOption("-p <file.path>", "Fly along an animation path of OpenSceneGraph.");
    usage.addCommandLineOption("--speed <factor>", "How fast animation paths are flown.");
    usage.addCommandLineOption("--traffic <number>",
                               "Scatter so many models about the camera, and count those that terrain does not hide; "
                               "keys T and G.");
    usage.addCommandLineOption("--poses <file.csv>", "Camera path with the poses that --steps names.");
    usage.addCommandLineOption(
        "--steps <text>",
        "Do this and end: at=POSE (or home), press=KEY, frames=N, picture=FILE, parted by blanks; each waits for the "
        "database's pages.");
}

void printHelp(std::ostream& out, osg::ApplicationUsage& usage, unsigned int helpType) {
    out << usage.getDescription() << '\n';
    usage.write(out, helpType);
    out << "Key h lists the keys. Exit code: 0; 1 when something failed: one line says what; 2 when the command line "
           "is\n"
           "wrong.\n\n"
           "Examples:\n"
           "  osgbinviewer earth.osgb\n"
           "  osgbinviewer earth.ive --options method=exact,heights=-500..4000 --record flight.path\n"
           "  osgbinviewer earth.osgb --steps \"at=home press=B picture=bins.png\""
        << std::endl;
}

Settings settingsFrom(osg::ArgumentParser& arguments) {
    Settings settings;
    const auto readLast = [&arguments](const char* name, auto& value) {
        while (arguments.read(name, value)) {
        }
    };
    std::string text;
    readLast("--options", text);
    std::string error;
    const auto options = cullOptionsFromText(text, error);
    if (!options) throw support::UsageError("--options: " + error);
    settings.cullOptions = *options;
    readLast("--record", settings.record);
    readLast("--poses", settings.poses);
    readLast("--steps", settings.steps);
    readLast("--speed", settings.speed);
    readLast("--traffic", settings.traffic);
    std::string path;
    while (arguments.read("-p", path)) settings.animationPaths.push_back(path);
    for (int i = 1; i < arguments.argc(); ++i) {
        if (arguments.isOption(i))
            throw support::UsageError(std::string("unknown option ") + arguments[i] + "; see --help");
        const std::string name = arguments[i];
        const bool isWhole = osgDB::getLowerCaseFileExtension(name) == "analyticbin";
        settings.databases.push_back({name, isWhole ? name : name + ".(" + toText(*options) + ").analyticbin"});
    }
    if (settings.databases.empty()) throw support::UsageError("no database given; see --help");
    return settings;
}

}  // namespace osgAnalyticBin::viewer
