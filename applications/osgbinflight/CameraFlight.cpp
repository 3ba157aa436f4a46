// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CameraFlight.h"

#include "CsvTable.h"
#include "Failure.h"
#include "Quantiles.h"
#include "ThreadingName.h"
#include "TileCensus.h"

#include <osg/Notify>
#include <osg/Version>
#include <osgDB/DatabasePager>
#include <osgDB/WriteFile>
#include <osgGA/EventVisitor>

#include <algorithm>
#include <filesystem>

namespace osgAnalyticBin::flight {

namespace {

// Frames without a request or a merge after which the pager counts as idle: a request made in one frame may be
// on its way from a queue to a thread in the next.
constexpr int kIdleFrames = 20;
constexpr double kMillisecondsPerSecond = 1000.0;
constexpr const char* kCullTime = "Cull traversal time taken";

bool isFrameEvent(const osgGA::EventVisitor& visitor) {
    const auto& events = visitor.getEvents();
    return std::any_of(events.begin(), events.end(), [](const auto& event) {
        const osgGA::GUIEventAdapter* const gui = event->asGUIEventAdapter();
        return gui && gui->getEventType() == osgGA::GUIEventAdapter::FRAME;
    });
}

std::string remarkOn(const osgViewer::Viewer& viewer, const FlightOptions& options) {
    const osg::Viewport& viewport = *viewer.getCamera()->getViewport();
    return std::string("OpenSceneGraph ") + osgGetVersion() + ", " + threadingName(viewer.getThreadingModel()) + ", " +
           textFrom(viewport.width()) + "x" + textFrom(viewport.height()) + " pixels, cull time: median of " +
           std::to_string(options.frames) + " frames";
}

}  // namespace

CameraFlight::CameraFlight(std::vector<CameraPose> path, const FlightOptions& options)
    : _path(std::move(path)), _options(options), _capture(new FrameCapture) {}

CameraFlight::~CameraFlight() {
    if (_reads) _reads->uninstall();
}

bool CameraFlight::run(osg::Object* object, osg::Object* data) {
    osg::NodeVisitor* const visitor = data->asNodeVisitor();
    osgGA::EventVisitor* const events = visitor ? visitor->asEventVisitor() : nullptr;
    auto* const viewer = events ? dynamic_cast<osgViewer::Viewer*>(events->getActionAdapter()) : nullptr;
    if (viewer && _phase != Phase::Over && isFrameEvent(*events)) flyOn(*viewer);
    return traverse(object, data);
}

void CameraFlight::flyOn(osgViewer::Viewer& viewer) {
    _frameNumber = viewer.getFrameStamp()->getFrameNumber();
    switch (_phase) {
        case Phase::Begin:
            begin(viewer);
            break;
        case Phase::Load:
            load(viewer);
            break;
        case Phase::Time:
            time(viewer);
            break;
        case Phase::Picture:
            picture(viewer);
            break;
        case Phase::Over:
            break;
    }
    if (_phase != Phase::Over) setPose(*viewer.getCamera());
}

void CameraFlight::begin(osgViewer::Viewer& viewer) {
    if (!viewer.getCamera()->getGraphicsContext() || !viewer.getCamera()->getViewport())
        return fail(viewer, "the viewer's camera has no window");
    if (!viewer.getSceneData()->getBound().valid()) return fail(viewer, "the database is empty");
    if (!prepareFolder()) return fail(viewer, "folder \"" + _options.out + "\" cannot be made or emptied");
    viewer.setCameraManipulator(nullptr);
    prepareCamera(*viewer.getCamera());
    _globe = globeOf(*viewer.getSceneData());
    _reads = new ReadCounter;
    _reads->install();
    arrive();
}

// An old table must not pass for the table of a flight that failed.
bool CameraFlight::prepareFolder() {
    std::error_code problem;
    std::filesystem::create_directories(_options.out, problem);
    if (problem) return false;
    std::filesystem::remove(std::filesystem::path(_options.out) / kPoseTableName, problem);
    return !problem;
}

void CameraFlight::prepareCamera(osg::Camera& camera) {
    makeComparable(camera);
    camera.setCullingMode(camera.getCullingMode() & ~osg::CullSettings::SMALL_FEATURE_CULLING);
    camera.addFinalDrawCallback(_capture);
    camera.getStats()->collectStats("rendering", true);
}

// Every frame, because a window manager may change the window's size.
void CameraFlight::setPose(osg::Camera& camera) const {
    placeCamera(camera, pose(), _globe);
}

void CameraFlight::arrive() {
    _phase = Phase::Load;
    _arrival = osg::Timer::instance()->tick();
    _filesAtArrival = _reads->nodeFiles();
    _idleFrames = 0;
    _cullMs.clear();
    _frameMs.clear();
    _lastFrame = 0;
    _record = PoseRecord();
    _record.name = pose().name;
}

void CameraFlight::load(osgViewer::Viewer& viewer) {
    if (isTimeOver(viewer, "files to load")) return;
    _idleFrames = isPagerIdle(viewer) ? _idleFrames + 1 : 0;
    if (_idleFrames < kIdleFrames) return;
    _idleFrames = 0;
    _record.tiles = TileCensus::take(*viewer.getCamera(), *viewer.getFrameStamp());
    if (_record.tiles.wanted == 0) _phase = Phase::Time;
}

bool CameraFlight::isPagerIdle(osgViewer::Viewer& viewer) {
    const std::uint64_t files = _reads->nodeFiles();
    const bool quiet = files == _filesLastFrame;
    _filesLastFrame = files;
    const osgDB::DatabasePager* const pager = viewer.getDatabasePager();
    return quiet && (!pager || (!pager->getRequestsInProgress() && !pager->requiresUpdateSceneGraph()));
}

// The frame before this one is culled by now, under every threading model.
void CameraFlight::time(osgViewer::Viewer& viewer) {
    if (isTimeOver(viewer, "cull times")) return;
    double seconds = 0.0;
    if (viewer.getCamera()->getStats()->getAttribute(_frameNumber - 1, kCullTime, seconds))
        _cullMs.push_back(seconds * kMillisecondsPerSecond);
    const osg::Timer& timer = *osg::Timer::instance();
    const osg::Timer_t now = timer.tick();
    if (_lastFrame != 0) _frameMs.push_back(timer.delta_m(_lastFrame, now));
    _lastFrame = now;
    if (_cullMs.size() < static_cast<std::size_t>(_options.frames)) return;
    _capture->request(_frameNumber);
    _phase = Phase::Picture;
}

void CameraFlight::picture(osgViewer::Viewer& viewer) {
    if (isTimeOver(viewer, "the picture")) return;
    const osg::ref_ptr<osg::Image> picture = _capture->take();
    if (!picture) return;
    _record.cullMs = support::Quantiles(_cullMs).at(1, 2);
    _record.frameMs = support::Quantiles(_frameMs).at(1, 2);
    _record.files = _reads->nodeFiles() - _filesAtArrival;
    _record.tiles = TileCensus::take(*viewer.getCamera(), *viewer.getFrameStamp());
    if (_record.tiles.wanted > 0) return fail(viewer, pose().name + ": the database changed before the picture");
    if (!savePicture(*picture)) return fail(viewer, pose().name + ": the picture cannot be saved");
    OSG_NOTICE << "binflight: " << _record.name << ": " << _record.tiles.drawn << " tiles drawn, " << _record.files
               << " files, cull " << _record.cullMs << " ms, frame " << _record.frameMs << " ms" << std::endl;
    _records.push_back(_record);
    if (_records.size() == _path.size()) return land(viewer);
    arrive();
}

bool CameraFlight::savePicture(const osg::Image& picture) {
    _record.picture = _record.name + ".png";
    const std::filesystem::path file = std::filesystem::path(_options.out) / _record.picture;
    return osgDB::writeImageFile(picture, file.string());
}

bool CameraFlight::isTimeOver(osgViewer::Viewer& viewer, const std::string& waitingFor) {
    const double seconds = osg::Timer::instance()->delta_s(_arrival, osg::Timer::instance()->tick());
    if (seconds <= _options.timeout) return false;
    fail(viewer, pose().name + ": still waiting for " + waitingFor + " after " + textFrom(_options.timeout) + " s (" +
                     std::to_string(_record.tiles.wanted) + " files wanted when the pager was last idle)");
    return true;
}

void CameraFlight::land(osgViewer::Viewer& viewer) {
    try {
        writePoseTable(_options.out, _records, remarkOn(viewer, _options));
    } catch (const support::Failure& failure) {
        return fail(viewer, failure.what());
    }
    OSG_NOTICE << "binflight: " << _records.size() << " poses in " << _options.out << std::endl;
    stop(viewer);
}

void CameraFlight::fail(osgViewer::Viewer& viewer, const std::string& text) {
    OSG_WARN << "binflight: " << text << "; the flight ends without " << kPoseTableName << std::endl;
    stop(viewer);
}

// The pager's threads have to be at rest before the Registry's callback may change.
void CameraFlight::stop(osgViewer::Viewer& viewer) {
    _phase = Phase::Over;
    if (osgDB::DatabasePager* const pager = viewer.getDatabasePager()) pager->cancel();
    if (_reads) _reads->uninstall();
    _reads = nullptr;
    viewer.setDone(true);
}

}  // namespace osgAnalyticBin::flight
