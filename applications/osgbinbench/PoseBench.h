// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BenchViewer.h"
#include "CameraPath.h"
#include "CullMethod.h"
#include "Figures.h"
#include "MethodScene.h"
#include "Settings.h"
#include "TileTruth.h"

#include <osg/Image>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin::bench {

/// The name of a pose, and what is seen there.
using Picture = std::pair<std::string, osg::ref_ptr<osg::Image>>;

/// Measures all methods at every pose of a path. At each pose every method starts from the root file alone, so that
/// its figures do not depend on the poses before; when all have loaded what they want, they are compared.
class PoseBench {
public:
    /// `methods`: the reference first, as cullMethodsFromNames() gives them.
    /// Throws: Failure when there is nothing to draw on.
    PoseBench(const Settings& settings, const std::vector<CullMethod>& methods, FileWatch& watch);

    /// Returns: the figures of all poses, or, where the user has asked to stop, of those until then, one at least.
    /// Throws: Failure when the database cannot be read, a pose takes longer than the timeout, a picture cannot be
    /// saved, or the oracle draws other tiles than what it repeats; Interrupted. Progress goes to stderr.
    [[nodiscard]] std::vector<MethodFigures> run(const std::vector<flight::CameraPose>& path);

    /// For the report: what the last method draws, by pose.
    [[nodiscard]] const std::vector<Picture>& pictures() const { return _pictures; }

private:
    /// What one method did at the present pose.
    struct Visit {
        flight::Census census;
        osg::ref_ptr<osg::Image> picture;
        std::uint64_t residentTiles = 0;
        std::uint64_t files = 0;
        std::uint64_t bytes = 0;
    };

    [[nodiscard]] Visit visit(MethodScene& scene, const flight::CameraPose& pose);
    void checkReplays(const std::vector<Visit>& visits, const std::string& pose) const;
    void learnBins(const flight::CameraPose& pose);
    [[nodiscard]] std::vector<report::Json> measure(const flight::CameraPose& pose);
    void savePicture(const osg::Image& picture, const std::string& method, const std::string& pose) const;

    const Settings& _settings;
    FileWatch& _watch;
    BenchViewer _viewer;
    std::vector<std::unique_ptr<MethodScene>> _scenes;
    /// All tiles of a pose with their bins; what it has loaded it keeps for the next pose.
    MethodScene _binScene;
    bool _isBinSceneLoaded = false;
    TileTruth _truth;
    std::vector<Picture> _pictures;
};

}  // namespace osgAnalyticBin::bench
