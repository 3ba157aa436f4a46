// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/viewer/Export.h>

#include <osg/Camera>
#include <osgGA/GUIEventHandler>

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin {

/// A pose of a camera on a globe. Radians, metres and seconds; altitudes above the ellipsoid.
struct RecordedPose {
    double time = 0.0;         ///< of the viewer's clock, growing
    core::Geodetic eye;        ///< where the camera stands
    core::Geodetic look;       ///< a point on the line of sight
    double verticalFov = 0.0;  ///< the whole angle
    double nearPlane = 0.0;    ///< from the eye along the line of sight
    double farPlane = 0.0;     ///< as nearPlane
    double roll = 0.0;         ///< of up, clockwise about the line of sight, from the local vertical
};

/// The present pose of a camera over the globe of its scene; near and far planes are those of the last frame, with some
/// room.
/// Returns: nullopt for views that are not perspective or from near the globe's centre, and where there is no globe.
[[nodiscard]] OSGANALYTICBINVIEWER_EXPORT std::optional<RecordedPose> recordedPose(osg::Camera& camera, double time);

/// Which columns a camera path has.
enum class PathColumns {
    Poses,       ///< name, eyeLatDeg, eyeLonDeg, eyeAlt, lookLatDeg, lookLonDeg, lookAlt, fovDeg, near, far
    PosesInTime  ///< and time, rollDeg
};

/// Writes the poses as the camera path that osgbinbench plays, exact to the last bit.
OSGANALYTICBINVIEWER_EXPORT void writeCameraPath(std::ostream& out, const std::vector<RecordedPose>& path,
                                                 PathColumns columns);

/// Writes a file under a temporary name beside it, then renames it. Returns: false, with one line in `error`, when
/// that fails; what was there before stays.
[[nodiscard]] OSGANALYTICBINVIEWER_EXPORT bool writeCameraPathFile(const std::string& fileName,
                                                                   const std::vector<RecordedPose>& path,
                                                                   PathColumns columns, std::string& error);

/// Key `R`: starts or stops recording the view's camera into a file that osgbinbench plays: a pose every half second
/// while it moves. The file is written every five seconds, whenever recording stops, and at the end. One handler for
/// each view.
class OSGANALYTICBINVIEWER_EXPORT PathRecorder : public osgGA::GUIEventHandler {
public:
    /// `interval`: seconds between poses.
    explicit PathRecorder(const std::string& fileName, double interval = 0.5,
                          PathColumns columns = PathColumns::PosesInTime);

    /// Default `R`.
    void setKeyEventRecord(int key) { _key = key; }

    /// Starts or stops, as the key does; stopping writes the file.
    void setRecording(bool recording);
    /// Whether poses are being recorded.
    [[nodiscard]] bool isRecording() const { return _isRecording; }

    /// What has been recorded so far.
    [[nodiscard]] const std::vector<RecordedPose>& path() const { return _path; }

    /// Handles the key, records at every frame, and writes at the end. Returns: whether the key was handled.
    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;
    /// The keys, for osgViewer::HelpHandler.
    void getUsage(osg::ApplicationUsage& usage) const override;

protected:
    ~PathRecorder() override;

private:
    void record(osg::Camera& camera, double time);
    void write();

    int _key = 'R';
    const std::string _fileName;
    const double _interval;
    const PathColumns _columns;
    bool _isRecording = false;
    bool _isWritten = true;
    double _lastTime = 0.0;
    double _writtenAt = -1.0;
    osg::Matrixd _lastView;
    std::vector<RecordedPose> _path;
};

}  // namespace osgAnalyticBin
