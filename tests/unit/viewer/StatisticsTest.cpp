// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Counts of tiles in a viewer that draws. Oracle: a survey of the same frame.

#include "DrawnViewer.h"

#include <osgAnalyticBin/viewer/BinStatsHandler.h>
#include <osgAnalyticBin/viewer/ViewerCounts.h>

#include <osgViewer/ViewerEventHandlers>

#include <algorithm>

namespace osgAnalyticBin {
namespace {

class Statistics : public test::DrawnViewer {
protected:
    // A second camera of the view, which sees the same.
    osg::Camera& addCamera() {
        const osg::ref_ptr<osg::Camera> camera = new osg::Camera(*_viewer.getCamera());
        camera->setGraphicsContext(test::makeSurface());
        _viewer.addSlave(camera);
        camera->getGraphicsContext()->realize();
        return *camera;
    }
};

TEST_F(Statistics, FillOsgsOwn) {
    const osg::ref_ptr<osgViewer::StatsHandler> handler = new osgViewer::StatsHandler;
    _viewer.addEventHandler(new BinStatsHandler(*handler));
    _viewer.addEventHandler(handler);
    drawUntilIdle(_viewer);
    osg::Stats& stats = *_viewer.getViewerStats();
    double value = -1.0;
    EXPECT_FALSE(stats.getAttribute(_viewer.getFrameStamp()->getFrameNumber() - 1, "Tiles tested", value));
    press('s');
    const TileCounts expected = counts(_viewer);
    const unsigned int frame = _viewer.getFrameStamp()->getFrameNumber() - 1;
    const auto attribute = [&](const char* name) {
        double number = -1.0;
        EXPECT_TRUE(stats.getAttribute(frame, name, number)) << name;
        return number;
    };
    const std::pair<const char*, std::size_t> numbers[] = {{"Tiles tested", expected.tested},
                                                           {"Tiles kept", expected.kept},
                                                           {"Tiles drawn", expected.drawn},
                                                           {"Tiles behind the horizon", expected.hidden},
                                                           {"Tiles beyond an edge", expected.beyondEdge},
                                                           {"Tiles behind terrain", expected.occluded}};
    for (const auto& [name, number] : numbers) EXPECT_EQ(attribute(name), double(number)) << name;
    EXPECT_GT(expected.drawn, 0u);
    // whole numbers, and no means
    press('s');
    const std::vector<std::string> shown = texts(*handler->getCamera());
    const auto name = std::find(shown.begin(), shown.end(), "Tiles drawn: ");
    ASSERT_LT(name + 1, shown.end());
    EXPECT_EQ(name[1], std::to_string(expected.drawn));
}

TEST_F(Statistics, CountWhatBinsDecidedOverAllCameras) {
    drawUntilIdle(_viewer);
    const unsigned int frame = _viewer.getFrameStamp()->getFrameNumber();
    const BinCounts one = binCounts(_viewer);
    const TileCounts expected = counts(_viewer);
    EXPECT_EQ(one.frame, frame);
    EXPECT_EQ(one.tested, expected.tested);
    EXPECT_EQ(one.tested - one.outside, expected.kept);
    EXPECT_EQ(one.hidden, expected.hidden);
    EXPECT_EQ(one.inside + one.straddling, expected.kept);
    EXPECT_GT(one.outside, 0u);
    EXPECT_EQ(binCounts(*_viewer.getCamera(), frame + 1).tested, 0u) << "of another frame";
    osg::Camera& second = addCamera();
    drawUntilIdle(_viewer);
    const BinCounts two = binCounts(_viewer);
    const unsigned int last = _viewer.getFrameStamp()->getFrameNumber();
    EXPECT_EQ(two.tested, binCounts(*_viewer.getCamera(), last).tested + binCounts(second, last).tested);
    EXPECT_GT(two.tested, binCounts(*_viewer.getCamera(), last).tested);
    EXPECT_EQ(binCounts(*osg::ref_ptr<osg::Camera>(new osg::Camera), last).tested, 0u);
}

TEST_F(Statistics, AreThoseOfTheLastCulledFrameWhenEscapeHasEndedTheViewer) {
    drawUntilIdle(_viewer);
    _viewer.setKeyEventSetsDone(osgGA::GUIEventAdapter::KEY_Escape);
    _viewer.getEventQueue()->keyPress(osgGA::GUIEventAdapter::KEY_Escape);
    _viewer.getEventQueue()->keyRelease(osgGA::GUIEventAdapter::KEY_Escape);
    for (int i = 0; i < 100 && !_viewer.done(); ++i) _viewer.frame();
    ASSERT_TRUE(_viewer.done());
    EXPECT_GT(binCounts(_viewer).tested, 0u);
    EXPECT_LT(binCounts(_viewer).frame, _viewer.getFrameStamp()->getFrameNumber());
}

}  // namespace
}  // namespace osgAnalyticBin
