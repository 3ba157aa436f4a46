// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/CullOptions.h>

#include <osgViewer/Viewer>

#include <string>
#include <vector>

namespace osgAnalyticBin::bench {

/// MiB: twice the last-level cache of the first processor, 64 at least.
[[nodiscard]] int defaultFlush();

/// What the command line asks for.
struct Settings {
    std::string database;
    std::vector<std::string> paths;  ///< empty: defaultPath()
    std::vector<std::string> methods{"sphere", "cluster", "bins"};
    std::string binOptions;
    std::string csv;
    std::string json;
    std::string pictures;
    std::string plot;
    std::string report;
    double verticalScale = 1.0;
    int width = 1280;
    int height = 720;
    osgViewer::ViewerBase::ThreadingModel threading = osgViewer::ViewerBase::SingleThreaded;
    int repeats = 40;                             ///< rounds in which every method's culling is timed
    int flush = defaultFlush();                   ///< touched before each cull with cold caches; 0: none of these
    int frames = 0;                               ///< of the continuous flight alone; 0: stop at every pose first
    bool draw = false;                            ///< the frames of the continuous flight, in a viewer
    bool jumps = false;                           ///< from pose to pose with the pager running, and nothing else
    double speed = 0.0;                           ///< metres a second ahead from each pose; 0: along the path
    double frameRate = 60.0;                      ///< frames a second of the continuous flight, at most
    double expiry = CullOptions::kDefaultExpiry;  ///< seconds, of methods without bins in flight; 0: OSG's own rule
    double timeout = 120.0;                       ///< seconds that one pose may take to load and draw
};

/// Reads the command line; --help is answered at once.
/// Returns: whether there is something to measure.
/// Throws: Failure when an option is unknown, malformed or out of range.
[[nodiscard]] bool settingsFromCommandLine(int argc, char** argv, Settings& settings);

}  // namespace osgAnalyticBin::bench
