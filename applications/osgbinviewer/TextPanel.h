// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Camera>
#include <osg/Geode>
#include <osg/Referenced>
#include <osg/Vec4>

#include <string>
#include <vector>

namespace osgAnalyticBin::viewer {

/// Lines of text in a corner of a camera's picture, part of its overlay.
class TextPanel : public osg::Referenced {
public:
    struct Line {
        std::string text;
        osg::Vec4 colour;

        [[nodiscard]] bool operator==(const Line& other) const { return text == other.text && colour == other.colour; }
    };
    enum class Corner { BottomLeft, BottomRight, TopRight };

    explicit TextPanel(Corner corner);

    /// Shows the lines on a camera; none: nothing is shown.
    void show(osg::Camera& camera, const std::vector<Line>& lines);
    void hide();

private:
    const Corner _corner;
    const osg::ref_ptr<osg::Camera> _hud;
    std::vector<Line> _lines;
    double _width = 0.0;
};

}  // namespace osgAnalyticBin::viewer
