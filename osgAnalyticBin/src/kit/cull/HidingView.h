// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../tile/TerrainHider.h"
#include "DrawnState.h"
#include "TileSelection.h"

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <osg/BoundingSphere>
#include <osg/CullStack>
#include <osg/Matrixd>
#include <osg/NodeVisitor>
#include <osg/ref_ptr>
#include <osgUtil/CullVisitor>

#include <optional>

namespace osgAnalyticBin {

/// What the database that a visitor has traversed last hides in its picture, for nodes that are no tiles. It holds for
/// the camera, the view and the frame in which the database was traversed.
/// Source: doc/theory/occlusion.md, section 8.
class HidingView final {
public:
    /// What is known of a view of a database.
    struct Known {
        core::Ellipsoid ellipsoid;
        std::optional<core::HorizonEye> eye;  ///< where the horizon hides
        osg::ref_ptr<TerrainHider> hider;     ///< after find(); null: terrain hides nothing
        bool isCutOpen = false;               ///< the near plane may cut terrain
    };

    /// Requires: the visitor is at the database's root.
    void set(osgUtil::CullVisitor& visitor, const Known& known);
    /// Nothing is hidden any more.
    void clear() { _known.reset(); }

    /// Whether nodes have asked in one of the last views.
    [[nodiscard]] bool isInUse(const osg::NodeVisitor& visitor) const;
    /// Whether terrain hid many, or at least a quarter, of those that have asked since this was called last.
    [[nodiscard]] bool takeWorth();

    /// Whether a sphere is hidden. `localToEye`: from its frame to eye space.
    /// Guarantee: true is a proof for what is drawn within the sphere, if it obeys depth; tests: HiddenByTerrain.*.
    [[nodiscard]] bool hides(osgUtil::CullVisitor& visitor, const osg::BoundingSphere& sphere,
                             const osg::Matrixd& localToEye);

    /// What is known of the states from the camera to the visitor's present node. Cost: looks at the node's own state;
    /// those above are remembered for the next node.
    [[nodiscard]] DrawnState stateAbove(osgUtil::CullVisitor& visitor, const StateRules& rules);

private:
    // What the picture is made of. Objects are held, so that OSG puts no others in their place; they may be changed.
    struct Picture {
        [[nodiscard]] static Picture of(osgUtil::CullVisitor& visitor);
        [[nodiscard]] bool isOf(osgUtil::CullVisitor& visitor) const;

        unsigned int frame = 0;
        const osgUtil::RenderStage* stage = nullptr;
        osg::ref_ptr<const osg::RefMatrix> projection, view;  // view: null where the application sets none
        osg::Matrixd projectionThen, viewThen;
        TileSelection::Conditions conditions;
    };

    [[nodiscard]] bool findFrame();
    [[nodiscard]] bool isBehindHorizon(const glm::dvec3& centre, double radius, double distance) const;

    std::optional<Known> _known;
    Picture _picture;
    osg::Matrixd _ecefToEye;
    std::optional<osg::Matrixd> _eyeToEcef;  // once it is asked for
    double _scale = 1.0;                     // metres in a unit of eye space, rounded up
    double _drawing = 0.0;                   // of a pixel, in radians
    double _depthStep = 0.0;  // of the reciprocal of a depth in eye space; times that depth where OSG computes it
    bool _isStepRelative = false;
    unsigned int _askedIn = 0;  // frame
    unsigned int _asked = 0, _hidden = 0;

    const osgUtil::StateGraph* _above = nullptr;
    DrawnState _stateAbove;
    bool _isDepthTestKnownAbove = false;
};

}  // namespace osgAnalyticBin
