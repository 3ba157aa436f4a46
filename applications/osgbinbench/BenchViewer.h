// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "FrameCapture.h"

#include <osg/Image>
#include <osgViewer/Viewer>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace osgAnalyticBin::bench {

/// How many pixels of two pictures, with 8 bits per channel, differ in a channel.
/// Throws: Failure when the sizes or formats differ.
[[nodiscard]] std::uint64_t differingPixels(const osg::Image& first, const osg::Image& second);

/// Milliseconds of one frame. The viewer's own statistics, drawing until the pixels are there.
struct FrameTimes {
    double cullMs = 0.0;
    double drawMs = 0.0;
    double frameMs = 0.0;  ///< of the call that draws it; with a draw thread, until the frame before is drawn
};

/// The one viewer of the process: draws now this scene, now that one, on an invisible surface.
/// Pictures are comparable to the pixel: near and far stay as they are set, nothing small is culled, nothing is
/// smoothed, drawing goes in traversal order, and textures are not filtered anisotropically.
class BenchViewer {
public:
    /// Throws: Failure when there is no display, or none that OpenGL can draw on.
    BenchViewer(int width, int height, osgViewer::ViewerBase::ThreadingModel threading);
    ~BenchViewer() { rest(); }

    BenchViewer(const BenchViewer&) = delete;
    BenchViewer& operator=(const BenchViewer&) = delete;

    /// Draws this scene from now on, with the pager that it has already, if any.
    void show(osg::Node& root, osg::CullSettings::CullingMode culling);

    void setView(const osg::Camera& other);

    /// What this scene looks like to a camera; rests afterwards. Throws: Failure when the picture does not come.
    [[nodiscard]] osg::ref_ptr<osg::Image> pictureOf(osg::Node& root, const osg::Camera& view,
                                                     osg::CullSettings::CullingMode culling);

    /// Draws from now on as other viewers do: what is opaque by its state, not in the order of the traversal.
    void sortByState();

    /// Frames are timed from now on.
    void startTimes();

    /// Draws frames that are not timed until the pager has nothing left to read for this view, for `seconds` at most.
    /// Returns: whether it has nothing left.
    [[nodiscard]] bool drawUntilLoaded(double seconds);

    /// Draws a frame that is timed.
    void timeFrame();

    /// The times of all timed frames, once they have been drawn.
    [[nodiscard]] std::vector<FrameTimes> takeTimes();

    /// Ends all drawing, so that the scene may be looked at by others; the next frame starts it again.
    void rest();

private:
    void drawFrame();
    void collectTimes(unsigned int last);

    osgViewer::Viewer _viewer;
    osg::ref_ptr<flight::FrameCapture> _capture;
    std::vector<FrameTimes> _times;
    std::vector<unsigned int> _timed;  // the numbers of these frames
    std::size_t _read = 0;             // of these, those whose times of culling and drawing are known
};

}  // namespace osgAnalyticBin::bench
