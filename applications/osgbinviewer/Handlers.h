// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraPath.h"

#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/viewer/CameraCulling.h>
#include <osgAnalyticBin/viewer/TileSurvey.h>

#include <osg/Camera>
#include <osg/Group>
#include <osg/Vec4>
#include <osgGA/GUIEventHandler>
#include <osgViewer/Viewer>

#include <functional>
#include <map>
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
    /// The panel stays in the overlay, to be found when a window closes.
    void hide() { _hud->setNodeMask(0); }

private:
    const Corner _corner;
    const osg::ref_ptr<osg::Camera> _hud;
    std::vector<Line> _lines;
    double _width = 0.0;
};

/// A handler of keys of osgbinviewer's own; a view has one of each kind. In the help they come before OSG's.
class KeyHandler : public osgGA::GUIEventHandler {
public:
    /// Handles keys that no other handler has taken, and calls draw() in each frame. Returns: whether it was handled.
    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override {
        auto* const view = dynamic_cast<osgViewer::View*>(action.asView());
        if (!view || !view->getSceneData()) return false;
        if (event.getEventType() == osgGA::GUIEventAdapter::FRAME) {
            const std::vector<osg::Camera*> cameras = CameraCulling::drawingCameras(*view);
            if (!cameras.empty()) draw(*view, *cameras.front());
            return false;
        }
        if (event.getHandled() || event.getEventType() != osgGA::GUIEventAdapter::KEYDOWN) return false;
        for (const Key& key : _keys) {
            if (key.key != event.getKey()) continue;
            key.press(*view);
            action.requestRedraw();
            return true;
        }
        return false;
    }

    /// The keys, for osgViewer::HelpHandler. OSG sorts all keys by name: a blank comes first.
    void getUsage(osg::ApplicationUsage& usage) const override {
        for (const Key& key : _keys)
            usage.addKeyboardMouseBinding(std::string(" ") + static_cast<char>(key.key), key.use);
    }

protected:
    /// `use`: what the key does, for the help.
    void addKey(int key, const char* use, const std::function<void(osgViewer::View&)>& press) {
        _keys.push_back({key, use, press});
    }

    /// At every frame, between cull traversals. `camera`: the first of those that draw the view's scene.
    virtual void draw(osgViewer::View& /*view*/, osg::Camera& /*camera*/) {}

private:
    struct Key {
        int key;
        const char* use;
        std::function<void(osgViewer::View&)> press;
    };
    std::vector<Key> _keys;
};

/// Key `F`: freezes the culling of a view's cameras, while the view can still be moved. The tiles that were in view
/// stay drawn, with the frustum as lines and translucent sides down to the globe. `F` again: back to normal.
class FreezeCullHandler : public KeyHandler {
public:
    FreezeCullHandler();

    /// Whether culling is frozen.
    [[nodiscard]] bool isFrozen() const { return _isFrozen; }

    /// Freezes or thaws the view's cameras, as the key does. Between frames only.
    void setFrozen(osgViewer::View& view, bool frozen);

private:
    bool _isFrozen = false;
};

/// Key `B`: draws the bins that the view's camera tests as curved slabs, coloured by verdict: first those where its
/// cull traversal ends (tiles culled or drawn), then also the edges of the others, then none. Bins of maps are
/// not drawn.
/// Cost: while shown, a TileSurvey for each frame.
class BinDisplayHandler : public KeyHandler {
public:
    /// Which bins are drawn: none, those of tiles culled or drawn, where the cull traversal ends, or all that it came
    /// to.
    enum class Shown { Nothing, Ends, All };

    /// Of faces. With less, blue of the sea turns red to violet.
    static constexpr float kOpacity = 0.6F;

    BinDisplayHandler();

    /// Which bins are drawn from the next frame on, as key `B` chooses.
    void setShown(Shown shown) { _shown = shown; }
    [[nodiscard]] Shown shown() const { return _shown; }

    /// The present drawing in the world's frame, one child for each slab.
    [[nodiscard]] const osg::Group& slabs() const { return *_slabs; }

protected:
    void draw(osgViewer::View& view, osg::Camera& camera) override;

private:
    struct Slab {
        AnalyticBin bin;
        TileVerdict verdict;
        bool isEnd;
        osg::Matrixd ecefToWorld;
        osg::ref_ptr<osg::Node> node;
        bool isUsed;
    };

    void drawSlabs(const TileSurvey& survey);
    osg::Node* slabOf(const SurveyedTile& tile);
    void showLegend(const TileSurvey& survey, osg::Camera& camera);

    Shown _shown = Shown::Nothing;
    const osg::ref_ptr<osg::Group> _slabs = new osg::Group;
    const osg::ref_ptr<TextPanel> _legend = new TextPanel(TextPanel::Corner::BottomLeft);
    std::map<osg::ref_ptr<osg::Node>, Slab> _known;
};

/// Key `O`: draws a curtain over the part of the picture that terrain covers. Tiles behind the curtain are culled with
/// `occlusion=on`, and with `auto` while it is in use. With frozen culling the curtain stands in front of the eye that
/// culls. Where there is no curtain, a line says what is missing for terrain to hide tiles.
/// Cost: one TileSurvey a frame while the curtain is shown.
class CoveredPictureHandler : public KeyHandler {
public:
    CoveredPictureHandler();

    /// The curtain, in the world's frame. It has no children while nothing is drawn.
    [[nodiscard]] const osg::Group& curtain() const { return *_curtain; }

protected:
    void draw(osgViewer::View& view, osg::Camera& camera) override;

private:
    bool _isShown = false;
    const osg::ref_ptr<osg::Group> _curtain = new osg::Group;
    const osg::ref_ptr<TextPanel> _panel = new TextPanel(TextPanel::Corner::TopRight);
};

/// Keys `n` and `N`: the next and the previous culling method for the view's scene, tiles that are paged in later
/// included; the change in counts of tiles is shown for a while, as a difference while the camera does not move. One
/// handler for each scene.
class MethodSwitchHandler : public KeyHandler {
public:
    /// `options`: those that the scene's bins were installed with.
    explicit MethodSwitchHandler(const CullOptions& options = {});

    /// The present culling method.
    [[nodiscard]] const CullOptions& cullOptions() const { return _options; }

    /// Culls the view's scene by another method from the next frame on, as the keys do. Between frames only.
    void setMethod(osgViewer::View& view, Method method);

protected:
    void draw(osgViewer::View& view, osg::Camera& camera) override;

private:
    CullOptions _options;
    Method _methodBefore;
    TileCounts _countsBefore;
    osg::Matrixd _viewBefore;
    double _shownUntil = -1.0;  // reference time, seconds
    const osg::ref_ptr<TextPanel> _panel = new TextPanel(TextPanel::Corner::BottomRight);
};

/// Runs a viewer without a camera manipulator by a script, for pictures: see --steps. `poses` may be empty.
/// Throws: std::runtime_error with one line for a step that cannot be understood or done.
void runSteps(osgViewer::Viewer& viewer, const std::vector<flight::CameraPose>& poses, const std::string& text);

}  // namespace osgAnalyticBin::viewer
