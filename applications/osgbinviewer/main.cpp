// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Failure.h"
#include "FrameCapture.h"
#include "Handlers.h"
#include "ModuleFolder.h"
#include "PathFiles.h"
#include "Settings.h"
#include "Traffic.h"
#include "ViewTools.h"

#include <osgAnalyticBin/Version.h>
#include <osgAnalyticBin/viewer/BinStatsHandler.h>

#include <osgDB/Registry>
#include <osgGA/AnimationPathManipulator>
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

// As osgviewer's, but that the one for terrain is the first choice.
osg::ref_ptr<osgGA::CameraManipulator> makeManipulator(const viewer::Settings& settings, osgViewer::Viewer& viewer) {
    osg::ref_ptr<osgGA::KeySwitchMatrixManipulator> keys = new osgGA::KeySwitchMatrixManipulator;
    keys->addMatrixManipulator('1', "Trackball", new osgGA::TrackballManipulator);
    keys->addMatrixManipulator('2', "Flight", new osgGA::FlightManipulator);
    keys->addMatrixManipulator('3', "Drive", new osgGA::DriveManipulator);
    keys->addMatrixManipulator('4', "Terrain", new osgGA::TerrainManipulator);
    keys->addMatrixManipulator('5', "Orbit", new osgGA::OrbitManipulator);
    keys->addMatrixManipulator('6', "FirstPerson", new osgGA::FirstPersonManipulator);
    keys->addMatrixManipulator('7', "Spherical", new osgGA::SphericalManipulator);
    keys->selectMatrixManipulator(3);
    char key = '8';
    for (const std::string& path : settings.animationPaths) {
        const osg::ref_ptr<osgGA::AnimationPathManipulator> manipulator = new osgGA::AnimationPathManipulator(path);
        if (!manipulator->valid()) throw std::runtime_error(path + ": not an animation path");
        manipulator->setTimeScale(settings.speed);
        keys->addMatrixManipulator(key++, "Path", manipulator);
        keys->selectMatrixManipulator(keys->getNumMatrixManipulators() - 1);
    }
    const viewer::HomeView home = viewer::homeViewOf(*viewer.getSceneData(), viewer.getCamera()->getProjectionMatrix());
    keys->setHomePosition(home.eye, home.center, home.up);
    return keys;
}

void addHandlers(osgViewer::Viewer& viewer, const viewer::Settings& settings, osg::ApplicationUsage& usage) {
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
    WithoutNotes() : _before(osg::getNotifyHandler()) { osg::setNotifyHandler(new Nothing); }
    ~WithoutNotes() { osg::setNotifyHandler(_before); }
    WithoutNotes(const WithoutNotes&) = delete;
    WithoutNotes& operator=(const WithoutNotes&) = delete;

private:
    struct Nothing : public osg::NotifyHandler {
        void notify(osg::NotifySeverity, const char*) override {}
    };
    const osg::ref_ptr<osg::NotifyHandler> _before;
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
osg::ref_ptr<osg::Node> readDatabase(const viewer::NamedDatabase& database) {
    osgDB::Registry& registry = *osgDB::Registry::instance();
    osgDB::ReaderWriter::ReadResult result = registry.readNode(database.loaded, registry.getOptions());
    if (result.validNode()) return result.getNode();
    throw std::runtime_error(database.given + ": " + result.statusMessage());
}

ExitCode runSteps(osgViewer::Viewer& viewer, const viewer::Settings& settings) {
    std::vector<flight::CameraPose> poses;
    if (!settings.poses.empty()) poses = flight::readCameraPathFiles({settings.poses});
    viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    viewer.setRealizeOperation(new flight::WithoutAnisotropy);
    realize(viewer);
    viewer::runSteps(viewer, poses, settings.steps);
    return kSucceeded;
}

ExitCode show(osg::ArgumentParser& arguments) {
    viewer::describe(*arguments.getApplicationUsage());
    osgViewer::Viewer viewer(arguments);
    unsigned int helpType = 0;
    if ((helpType = arguments.readHelpType()) != 0) {
        viewer::printHelp(std::cout, *arguments.getApplicationUsage(), helpType);
        return kSucceeded;
    }
    if (arguments.read("--version")) {
        std::cout << "osgbinviewer (osgAnalyticBin) " << version() << std::endl;
        return kSucceeded;
    }
    const viewer::Settings settings = viewer::settingsFrom(arguments);
    const std::string error = displayError();
    const osg::ref_ptr<osg::Group> scene = new osg::Group;
    {
        // a database that cannot be read comes first, and nothing else is said of what is not going to be shown
        const std::optional<WithoutNotes> silence = error.empty() ? std::nullopt : std::make_optional<WithoutNotes>();
        for (const viewer::NamedDatabase& database : settings.databases) scene->addChild(readDatabase(database));
    }
    if (!error.empty()) throw std::runtime_error(error);
    const bool isAlone = scene->getNumChildren() == 1 && settings.traffic == 0;
    viewer.setSceneData(isAlone ? scene->getChild(0) : scene.get());
    if (settings.traffic > 0) viewer.addEventHandler(new viewer::TrafficHandler(*scene, settings.traffic));
    addHandlers(viewer, settings, *arguments.getApplicationUsage());
    if (!settings.steps.empty()) return runSteps(viewer, settings);
    realize(viewer);
    viewer.setCameraManipulator(makeManipulator(settings, viewer));
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
