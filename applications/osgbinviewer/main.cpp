// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CameraView.h"
#include "Failure.h"
#include "FrameCapture.h"
#include "Handlers.h"
#include "ModuleFolder.h"
#include "Traffic.h"
#include "ViewTools.h"

#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/Version.h>
#include <osgAnalyticBin/viewer/BinStatsHandler.h>

#include <osg/ArgumentParser>
#include <osg/Notify>
#include <osgDB/FileNameUtils>
#include <osgDB/Registry>
#include <osgGA/DriveManipulator>
#include <osgGA/FirstPersonManipulator>
#include <osgGA/FlightManipulator>
#include <osgGA/KeySwitchMatrixManipulator>
#include <osgGA/OrbitManipulator>
#include <osgGA/SphericalManipulator>
#include <osgGA/StateSetManipulator>
#include <osgGA/TerrainManipulator>
#include <osgGA/TrackballManipulator>
#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

#include <iostream>
#include <optional>
#include <stdexcept>

namespace {

using namespace osgAnalyticBin;
using support::ExitCode;
using support::kSucceeded;

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
    unsigned int traffic = 0;  ///< models
};

// Names the options for --help.
void describe(osg::ApplicationUsage& usage) {
    usage.setDescription("osgbinviewer shows a terrain database culled by its analytic bins, and what the bins do.");
    usage.setCommandLineUsage("osgbinviewer [options] DATABASE ...");
    usage.addCommandLineOption("-h or --help", "Display this information.");
    usage.addCommandLineOption("--version", "Display the version.");
    usage.addCommandLineOption("--options <text>",
                               "Culling, as \"method=exact,horizon=off\"; see osgconv --format analyticbin.");
    usage.addCommandLineOption("--record <file.path>",
                               "Record the camera for osgbinbench from the start; key z stops and starts.");
    usage.addCommandLineOption("--traffic <number>",
                               "Scatter so many models about the camera, and count those that terrain does not hide; "
                               "keys T and G.");
    usage.addCommandLineOption("--poses <file.csv>", "Camera path with the poses that --steps names.");
    usage.addCommandLineOption(
        "--steps <text>",
        "Do this and end: at=POSE (or home), press=KEY, frames=N, picture=FILE, parted by blanks; each waits for the "
        "database's pages.");
}

// `helpType`: as OSG's ArgumentParser reads it.
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

// Throws: std::runtime_error with one line for what cannot be understood.
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
    readLast("--traffic", settings.traffic);
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

// As osgviewer's, but that the one for terrain is the first choice.
osg::ref_ptr<osgGA::CameraManipulator> makeManipulator(osgViewer::Viewer& viewer) {
    osg::ref_ptr<osgGA::KeySwitchMatrixManipulator> keys = new osgGA::KeySwitchMatrixManipulator;
    keys->addMatrixManipulator('1', "Trackball", new osgGA::TrackballManipulator);
    keys->addMatrixManipulator('2', "Flight", new osgGA::FlightManipulator);
    keys->addMatrixManipulator('3', "Drive", new osgGA::DriveManipulator);
    keys->addMatrixManipulator('4', "Terrain", new osgGA::TerrainManipulator);
    keys->addMatrixManipulator('5', "Orbit", new osgGA::OrbitManipulator);
    keys->addMatrixManipulator('6', "FirstPerson", new osgGA::FirstPersonManipulator);
    keys->addMatrixManipulator('7', "Spherical", new osgGA::SphericalManipulator);
    keys->selectMatrixManipulator(3);
    const viewer::HomeView home = viewer::homeViewOf(*viewer.getSceneData(), viewer.getCamera()->getProjectionMatrix());
    keys->setHomePosition(home.eye, home.center, home.up);
    return keys;
}

void addHandlers(osgViewer::Viewer& viewer, const Settings& settings, osg::ApplicationUsage& usage) {
    viewer.addEventHandler(new osgGA::StateSetManipulator(viewer.getCamera()->getOrCreateStateSet()));
    viewer.addEventHandler(new osgViewer::ThreadingHandler);
    viewer.addEventHandler(new osgViewer::WindowSizeHandler);
    viewer.addEventHandler(new osgViewer::LODScaleHandler);
    viewer.addEventHandler(
        new osgViewer::RecordCameraPathHandler(settings.record.empty() ? "saved_animation.path" : settings.record));
    viewer.addEventHandler(new osgViewer::ScreenCaptureHandler);
    viewer.addEventHandler(new osgViewer::HelpHandler(&usage));
    const osg::ref_ptr<osgViewer::StatsHandler> stats = new osgViewer::StatsHandler;
    viewer.addEventHandler(new BinStatsHandler(*stats));
    viewer.addEventHandler(stats);
    viewer.addEventHandler(new viewer::FreezeCullHandler);
    viewer.addEventHandler(new viewer::BinDisplayHandler);
    viewer.addEventHandler(new viewer::CoveredPictureHandler);
    viewer.addEventHandler(new viewer::MethodSwitchHandler(settings.cullOptions));
}

// A display that cannot be opened is one line of ours; OSG's own would come before it.
class WithoutNotes {
public:
    WithoutNotes() { osg::setNotifyLevel(osg::ALWAYS); }
    ~WithoutNotes() { osg::setNotifyLevel(_before); }
    WithoutNotes(const WithoutNotes&) = delete;
    WithoutNotes& operator=(const WithoutNotes&) = delete;

private:
    const osg::NotifySeverity _before = osg::getNotifyLevel();
};

// What is wrong with the display; empty: nothing.
std::string displayError() {
    osg::GraphicsContext::ScreenIdentifier screen;
    screen.readDISPLAY();
    screen.setUndefinedScreenDetailsToDefaultScreen();
    osg::GraphicsContext::WindowingSystemInterface* const system = osg::GraphicsContext::getWindowingSystemInterface();
    const WithoutNotes silence;
    if (system && system->getNumScreens(screen) > 0) return {};
    return "display " + screen.displayName() + " cannot be opened; set DISPLAY, or run it under xvfb-run";
}

void realize(osgViewer::Viewer& viewer) {
    viewer.realize();
    if (!viewer.isRealized()) throw std::runtime_error("no window can be opened on this display");
}

// Named as the user named it.
osg::ref_ptr<osg::Node> readDatabase(const NamedDatabase& database) {
    osgDB::Registry& registry = *osgDB::Registry::instance();
    osgDB::ReaderWriter::ReadResult result = registry.readNode(database.loaded, registry.getOptions());
    if (result.validNode()) return result.getNode();
    throw std::runtime_error(database.given + ": " + result.statusMessage());
}

ExitCode runSteps(osgViewer::Viewer& viewer, const Settings& settings) {
    std::vector<flight::CameraPose> poses;
    if (!settings.poses.empty()) poses = flight::readCameraPathFiles({settings.poses});
    viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    viewer.setRealizeOperation(new flight::WithoutAnisotropy);
    realize(viewer);
    viewer::runSteps(viewer, poses, settings.steps);
    return kSucceeded;
}

ExitCode show(osg::ArgumentParser& arguments) {
    describe(*arguments.getApplicationUsage());
    osgViewer::Viewer viewer(arguments);
    unsigned int helpType = 0;
    if ((helpType = arguments.readHelpType()) != 0) {
        printHelp(std::cout, *arguments.getApplicationUsage(), helpType);
        return kSucceeded;
    }
    if (arguments.read("--version")) {
        std::cout << "osgbinviewer (osgAnalyticBin) " << version() << std::endl;
        return kSucceeded;
    }
    const Settings settings = settingsFrom(arguments);
    const std::string error = displayError();
    const osg::ref_ptr<osg::Group> scene = new osg::Group;
    {
        // a database that cannot be read comes first, and nothing else is said of what is not going to be shown
        const std::optional<WithoutNotes> silence = error.empty() ? std::nullopt : std::make_optional<WithoutNotes>();
        for (const NamedDatabase& database : settings.databases) scene->addChild(readDatabase(database));
    }
    if (!error.empty()) throw std::runtime_error(error);
    const bool isAlone = scene->getNumChildren() == 1 && settings.traffic == 0;
    viewer.setSceneData(isAlone ? scene->getChild(0) : scene.get());
    if (settings.traffic > 0) viewer.addEventHandler(new viewer::TrafficHandler(*scene, settings.traffic));
    addHandlers(viewer, settings, *arguments.getApplicationUsage());
    if (!settings.steps.empty()) return runSteps(viewer, settings);
    realize(viewer);
    viewer.setCameraManipulator(makeManipulator(viewer));
    if (!settings.record.empty()) {
        viewer.getEventQueue()->keyPress('z');
        viewer.getEventQueue()->keyRelease('z');
    }
    return viewer.run() == 0 ? kSucceeded : support::kFailed;
}

}  // namespace

int main(int argc, char** argv) {
    osg::ArgumentParser arguments(&argc, argv);
    arguments.getApplicationUsage()->setApplicationName(arguments.getApplicationName());
    return support::runProgram("osgbinviewer", [&] {
        addModuleFolder();
        return show(arguments);
    });
}
