// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraPath.h"
#include "CameraView.h"
#include "FlightOptions.h"
#include "FrameCapture.h"
#include "PoseTable.h"
#include "ReadCounter.h"

#include <osg/Callback>
#include <osg/Timer>
#include <osg/observer_ptr>
#include <osgViewer/Viewer>

#include <string>
#include <vector>

namespace osgAnalyticBin::flight {

/// An event callback that flies the viewer's camera along a path: at each pose it waits until every file is loaded,
/// counts tiles, times OSG's cull traversal and saves a picture; at the end it writes poses.csv and stops the viewer.
/// So that the pictures of all culling methods can be compared to the pixel, it takes the camera from the
/// manipulator, fixes near and far, and switches multisampling and small-feature culling off and drawing in traversal
/// order on (coplanar surfaces then come out alike). poses.csv is there only when everything went well; what
/// went wrong is one line on OSG's warning channel.
/// Requires: an osgViewer::Viewer, any threading model; the camera must not have drawn a frame yet.
class CameraFlight : public osg::Callback {
public:
    CameraFlight(std::vector<CameraPose> path, const FlightOptions& options);

    bool run(osg::Object* object, osg::Object* data) override;

protected:
    ~CameraFlight() override;

private:
    enum class Phase { Begin, Load, Time, Picture, Over };

    // Each takes its phase one frame further.
    void flyOn(osgViewer::Viewer& viewer);
    void begin(osgViewer::Viewer& viewer);
    void load(osgViewer::Viewer& viewer);
    void time(osgViewer::Viewer& viewer);
    void picture(osgViewer::Viewer& viewer);

    [[nodiscard]] bool prepareFolder();
    void prepareCamera(osg::Camera& camera);
    void setPose(osg::Camera& camera) const;
    void arrive();
    [[nodiscard]] bool isPagerIdle(osgViewer::Viewer& viewer);
    [[nodiscard]] bool isTimeOver(osgViewer::Viewer& viewer, const std::string& waitingFor);
    [[nodiscard]] bool savePicture(const osg::Image& picture);
    void land(osgViewer::Viewer& viewer);
    void fail(osgViewer::Viewer& viewer, const std::string& text);
    void stop(osgViewer::Viewer& viewer);
    [[nodiscard]] const CameraPose& pose() const { return _path[_records.size()]; }

    std::vector<CameraPose> _path;
    FlightOptions _options;
    Globe _globe;
    osg::ref_ptr<ReadCounter> _reads;
    osg::ref_ptr<FrameCapture> _capture;

    Phase _phase = Phase::Begin;
    unsigned int _frameNumber = 0;
    osg::Timer_t _arrival = 0;
    std::uint64_t _filesAtArrival = 0;
    std::uint64_t _filesLastFrame = 0;
    int _idleFrames = 0;
    std::vector<double> _cullMs, _frameMs;
    osg::Timer_t _lastFrame = 0;  // 0: the one before was not timed
    PoseRecord _record;
    std::vector<PoseRecord> _records;
};

}  // namespace osgAnalyticBin::flight
