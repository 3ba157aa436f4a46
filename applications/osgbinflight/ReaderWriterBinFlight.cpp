// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CameraView.h"
#include "CommandLine.h"
#include "CsvTable.h"
#include "Failure.h"
#include "FrameCapture.h"
#include "Quantiles.h"
#include "ReadCounter.h"
#include "TextFile.h"
#include "ThreadingName.h"
#include "TileCensus.h"

#include <osgAnalyticBin/NameParameters.h>

#include <osg/Group>
#include <osg/Notify>
#include <osg/Timer>
#include <osg/Version>
#include <osgDB/DatabasePager>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/ReaderWriter>
#include <osgDB/Registry>
#include <osgDB/WriteFile>
#include <osgGA/EventVisitor>
#include <osgViewer/Viewer>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace osgAnalyticBin::flight {

namespace {

// Frames without a request or a merge after which the pager counts as idle: a request made in one frame may be
// on its way from a queue to a thread in the next.
constexpr int kIdleFrames = 20;
constexpr double kMillisecondsPerSecond = 1000.0;
constexpr const char* kTableName = "poses.csv";
constexpr const char* kColumns =
    "name,tested_tiles,kept_tiles,drawn_tiles,drawables,triangles,files_requested,cull_ms,frame_ms,picture\n";
constexpr const char* kCullTime = "Cull traversal time taken";

/// How a camera path is flown.
struct FlightOptions {
    std::string out = "binflight";  ///< folder of the pictures and of poses.csv; made if missing
    int frames = 15;                ///< frames whose cull time is measured at each pose, 1 to 1000
    double timeout = 120.0;         ///< seconds that one pose may take to load and draw

    /// Declares what reads "out=DIR,frames=15,timeout=120" into these. A folder's name may hold blanks, but no comma.
    void declare(CLI::App& app) {
        app.set_help_flag();
        app.add_option("--out", out, "Folder of the pictures and of poses.csv (default: binflight)")
            ->option_text("FOLDER");
        app.add_option("--frames", frames, "Frames whose cull time is measured at each pose (default: 15)")
            ->option_text("1..1000")
            ->check(CLI::Range(1, 1000));
        app.add_option("--timeout", timeout, "Longest time that one pose may take (default: 120)")
            ->option_text("SECONDS")
            ->check(support::within(std::numeric_limits<double>::min(), 86400.0));
    }
};

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

/// An event callback that flies the viewer's camera along a path: at each pose it waits until every file is loaded,
/// counts tiles, times OSG's cull traversal and saves a picture; at the end it writes poses.csv and stops the viewer.
/// So that the pictures of all culling methods can be compared to the pixel, it takes the camera from the
/// manipulator, fixes near and far, and switches multisampling and small-feature culling off and drawing in traversal
/// order on (coplanar surfaces then come out alike). poses.csv is there only when everything went well; what
/// went wrong is one line on OSG's warning channel.
/// Requires: an osgViewer::Viewer, any threading model; the camera must not have drawn a frame yet.
class CameraFlight : public osg::Callback {
public:
    CameraFlight(std::vector<CameraPose> path, const FlightOptions& options)
        : _path(std::move(path)), _options(options), _capture(new FrameCapture) {}

    bool run(osg::Object* object, osg::Object* data) override {
        osg::NodeVisitor* const visitor = data->asNodeVisitor();
        osgGA::EventVisitor* const events = visitor ? visitor->asEventVisitor() : nullptr;
        auto* const viewer = events ? dynamic_cast<osgViewer::Viewer*>(events->getActionAdapter()) : nullptr;
        if (viewer && _phase && isFrameEvent(*events)) flyOn(*viewer);
        return traverse(object, data);
    }

protected:
    ~CameraFlight() override {
        if (_reads) _reads->uninstall();
    }

private:
    // What is done at the next frame; nullptr: nothing any more.
    using Phase = void (CameraFlight::*)(osgViewer::Viewer&);

    void flyOn(osgViewer::Viewer& viewer) {
        _frameNumber = viewer.getFrameStamp()->getFrameNumber();
        (this->*_phase)(viewer);
        if (_phase) setPose(*viewer.getCamera());
    }

    void begin(osgViewer::Viewer& viewer) {
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

    void load(osgViewer::Viewer& viewer) {
        if (isTimeOver(viewer, "files to load")) return;
        _idleFrames = isPagerIdle(viewer) ? _idleFrames + 1 : 0;
        if (_idleFrames < kIdleFrames) return;
        _idleFrames = 0;
        _tiles = TileCensus::take(*viewer.getCamera(), *viewer.getFrameStamp());
        if (_tiles.wanted == 0) _phase = &CameraFlight::time;
    }

    // The frame before this one is culled by now, under every threading model.
    void time(osgViewer::Viewer& viewer) {
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
        _phase = &CameraFlight::picture;
    }

    void picture(osgViewer::Viewer& viewer) {
        if (isTimeOver(viewer, "the picture")) return;
        const osg::ref_ptr<osg::Image> picture = _capture->take();
        if (!picture) return;
        const double cullMs = support::Quantiles(_cullMs).at(1, 2), frameMs = support::Quantiles(_frameMs).at(1, 2);
        const std::uint64_t files = _reads->nodeFiles() - _filesAtArrival;
        const std::string& name = pose().name;
        _tiles = TileCensus::take(*viewer.getCamera(), *viewer.getFrameStamp());
        if (_tiles.wanted > 0) return fail(viewer, name + ": the database changed before the picture");
        const std::filesystem::path file = std::filesystem::path(_options.out) / (name + ".png");
        if (!osgDB::writeImageFile(*picture, file.string()))
            return fail(viewer, name + ": the picture cannot be saved");
        OSG_NOTICE << "binflight: " << name << ": " << _tiles.drawn << " tiles drawn, " << files << " files, cull "
                   << cullMs << " ms, frame " << frameMs << " ms" << std::endl;
        std::ostringstream row;
        row << name << ',' << _tiles.tested << ',' << _tiles.kept << ',' << _tiles.drawn << ',' << _tiles.drawables
            << ',' << _tiles.triangles << ',' << files << ',' << textFrom(cullMs) << ',' << textFrom(frameMs) << ','
            << name << ".png\n";
        _rows.push_back(row.str());
        if (_rows.size() == _path.size()) return land(viewer);
        arrive();
    }

    // An old table must not pass for the table of a flight that failed.
    [[nodiscard]] bool prepareFolder() {
        std::error_code problem;
        std::filesystem::create_directories(_options.out, problem);
        if (problem) return false;
        std::filesystem::remove(std::filesystem::path(_options.out) / kTableName, problem);
        return !problem;
    }

    void prepareCamera(osg::Camera& camera) {
        makeComparable(camera);
        camera.setCullingMode(camera.getCullingMode() & ~osg::CullSettings::SMALL_FEATURE_CULLING);
        camera.addFinalDrawCallback(_capture);
        camera.getStats()->collectStats("rendering", true);
    }

    // Every frame, because a window manager may change the window's size.
    void setPose(osg::Camera& camera) const { placeCamera(camera, pose(), _globe); }

    void arrive() {
        _phase = &CameraFlight::load;
        _arrival = osg::Timer::instance()->tick();
        _filesAtArrival = _reads->nodeFiles();
        _idleFrames = 0;
        _cullMs.clear();
        _frameMs.clear();
        _lastFrame = 0;
        _tiles = {};
    }

    [[nodiscard]] bool isPagerIdle(osgViewer::Viewer& viewer) {
        const std::uint64_t files = _reads->nodeFiles();
        const bool quiet = files == _filesLastFrame;
        _filesLastFrame = files;
        const osgDB::DatabasePager* const pager = viewer.getDatabasePager();
        return quiet && (!pager || (!pager->getRequestsInProgress() && !pager->requiresUpdateSceneGraph()));
    }

    [[nodiscard]] bool isTimeOver(osgViewer::Viewer& viewer, const std::string& waitingFor) {
        const double seconds = osg::Timer::instance()->delta_s(_arrival, osg::Timer::instance()->tick());
        if (seconds <= _options.timeout) return false;
        fail(viewer, pose().name + ": still waiting for " + waitingFor + " after " + textFrom(_options.timeout) +
                         " s (" + std::to_string(_tiles.wanted) + " files wanted when the pager was last idle)");
        return true;
    }

    void land(osgViewer::Viewer& viewer) {
        try {
            std::string text = "# " + remarkOn(viewer, _options) + "\n" + kColumns;
            for (const std::string& row : _rows) text += row;
            support::writeFile((std::filesystem::path(_options.out) / kTableName).string(), text);
        } catch (const support::Failure& failure) {
            return fail(viewer, failure.what());
        }
        OSG_NOTICE << "binflight: " << _rows.size() << " poses in " << _options.out << std::endl;
        stop(viewer);
    }

    void fail(osgViewer::Viewer& viewer, const std::string& text) {
        OSG_WARN << "binflight: " << text << "; the flight ends without " << kTableName << std::endl;
        stop(viewer);
    }

    // The pager's threads have to be at rest before the Registry's callback may change.
    void stop(osgViewer::Viewer& viewer) {
        _phase = nullptr;
        if (osgDB::DatabasePager* const pager = viewer.getDatabasePager()) pager->cancel();
        if (_reads) _reads->uninstall();
        _reads = nullptr;
        viewer.setDone(true);
    }

    [[nodiscard]] const CameraPose& pose() const { return _path[_rows.size()]; }

    std::vector<CameraPose> _path;
    FlightOptions _options;
    Globe _globe;
    osg::ref_ptr<ReadCounter> _reads;
    osg::ref_ptr<FrameCapture> _capture;

    Phase _phase = &CameraFlight::begin;
    unsigned int _frameNumber = 0;
    osg::Timer_t _arrival = 0;
    std::uint64_t _filesAtArrival = 0;
    std::uint64_t _filesLastFrame = 0;
    int _idleFrames = 0;
    std::vector<double> _cullMs, _frameMs;
    osg::Timer_t _lastFrame = 0;  // 0: the one before was not timed
    TileCounts _tiles;
    std::vector<std::string> _rows;  // of the table
};

}  // namespace

/// Reads "path.csv.(out=DIR,frames=15,timeout=120).binflight": a camera path, as a node that draws nothing, flies the
/// viewer's camera.
class ReaderWriterBinFlight : public osgDB::ReaderWriter {
public:
    ReaderWriterBinFlight() {
        supportsExtension("binflight",
                          "Camera path: path.csv.(out=DIR,frames=15,timeout=120).binflight flies the viewer along "
                          "path.csv, and leaves pictures and poses.csv in DIR");
        CLI::App app;
        FlightOptions options;
        options.declare(app);
        for (const CLI::Option* option : app.get_options())
            supportsOption(support::parameterText(*option), option->get_description());
    }

    const char* className() const override { return "Camera path of osgAnalyticBin"; }

    ReadResult readObject(const std::string& fileName, const Options* options) const override {
        return readNode(fileName, options);
    }

    ReadResult readNode(const std::string& fileName, const Options* options) const override {
        if (!acceptsExtension(osgDB::getLowerCaseFileExtension(fileName))) return ReadResult::FILE_NOT_HANDLED;
        const auto name = nameParametersFrom(osgDB::getNameLessExtension(fileName));
        const std::string pathFile = osgDB::findDataFile(name.name, options);
        if (pathFile.empty()) return ReadResult(name.name + ": no such camera path");

        FlightOptions flightOptions;
        CLI::App app;
        flightOptions.declare(app);
        try {
            support::parseParameters(app, name.parameters);
            return ReadResult(nodeOf(readCameraPathFiles({pathFile}), flightOptions).get());
        } catch (const support::Failure& failure) {
            return ReadResult(failure.what());
        }
    }

private:
    // A named group with a callback, declared dynamic: osgUtil::Optimizer leaves it alone.
    static osg::ref_ptr<osg::Node> nodeOf(std::vector<CameraPose> path, const FlightOptions& options) {
        osg::ref_ptr<osg::Group> node = new osg::Group;
        node->setName("camera flight");
        node->setDataVariance(osg::Object::DYNAMIC);
        node->setEventCallback(new CameraFlight(std::move(path), options));
        return node;
    }
};

}  // namespace osgAnalyticBin::flight

using osgAnalyticBin::flight::ReaderWriterBinFlight;
REGISTER_OSGPLUGIN(binflight, ReaderWriterBinFlight)
