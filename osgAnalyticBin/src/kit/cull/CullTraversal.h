// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DrawnState.h"
#include "TileSelection.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/TerrainShape.h>
#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <osg/CullStack>
#include <osg/CullingSet>
#include <osg/Group>
#include <osg/NodeVisitor>
#include <osg/Polytope>
#include <osg/Referenced>
#include <osg/ref_ptr>

#include <array>
#include <cstddef>
#include <deque>
#include <optional>

namespace osgAnalyticBin {

/// Where an occluder lies: the ellipsoid, its depth below it, and whether cameras that inherit a view point
/// or draw depth alone (shadow passes) use it.
struct Occluder {
    core::Ellipsoid ellipsoid;
    double depth;
    bool forInheritedViewpoints;
};

class InstalledDatabase;

/// What a database provides to its tiles during its traversal.
struct DatabaseView {
    /// Draws what is kept below the group of a family to which OSG's traversal has come.
    using DrawFamily = void (*)(osg::Group& group, const TileFamily& family, osg::NodeVisitor& visitor,
                                osg::CullStack& cullStack, const DatabaseView& view);

    const InstalledDatabase* database;
    core::Ellipsoid ellipsoid;
    TerrainShape shape;
    const core::HorizonEye* eye;  // in ECEF, whatever transforms are below; nullptr: nothing is hidden
    // Of the traversal where the view was made: what is the same below has the same planes.
    const osg::RefMatrix* modelView;
    const osg::RefMatrix* projection;
    core::PlaneSet planes;
    TileSelection* selection;
    DrawFamily drawFamily;                        // see SelectionDrawing
    StateRules rules{};                           // what the database's states are judged by
    const osgUtil::StateGraph* states = nullptr;  // down to the database's root
};

/// The state of one cull visitor: its frustum, prepared once for all tiles, and the database that is traversed. Stored
/// with the visitor's counters, so that cull threads share nothing.
class CullTraversal final : public osg::Referenced {
public:
    explicit CullTraversal(BinStatistics& statistics);

    /// The visitor's state, created at the first call.
    [[nodiscard]] static CullTraversal& of(osg::NodeVisitor& visitor);

    /// The visitor's counters.
    [[nodiscard]] BinStatistics& statistics() const { return _statistics; }

    /// Sets, while it exists, what a database provides to its tiles; null: it leaves them to stock OSG.
    class DatabaseScope {
    public:
        DatabaseScope(osg::NodeVisitor& visitor, CullTraversal& traversal, const DatabaseView* view);
        ~DatabaseScope();
        DatabaseScope(const DatabaseScope&) = delete;
        DatabaseScope& operator=(const DatabaseScope&) = delete;

    private:
        CullTraversal& _traversal;
        const DatabaseView* const _outerView;
        const bool _wasLeftToOsg;
        const osg::NodeVisitor* const _outerVisitor;
        CullTraversal* const _outerTraversal;
    };

    /// All planes of the cull stack's current frustum, because OSG's masks may refer to any of them.
    [[nodiscard]] const core::PlaneSet& planes(osg::CullStack& cullStack);

    /// The eye in the frame of the planes last asked for. Returns: nullptr when nothing can be hidden from it.
    [[nodiscard]] const core::HorizonEye* horizonEye(osg::CullStack& cullStack, osg::NodeVisitor& visitor,
                                                     const Occluder& occluder);

    /// What the traversed database provides; nullptr: there is none.
    [[nodiscard]] const DatabaseView* databaseView() const { return _databaseView; }

    /// Whether the tiles of the traversed database are culled by OSG alone.
    [[nodiscard]] bool isLeftToOsg() const { return _isLeftToOsg; }

    /// The selection for the database that is traversed next. Each of several nested databases has its own.
    [[nodiscard]] TileSelection& selection();

    /// Records the node that a family keeps and is about to enter, and the culling mask of what is below it; null:
    /// none.
    void setKept(const osg::Node* node, osg::CullingSet::Mask maskBelow) {
        _kept = node;
        _maskBelowKept = maskBelow;
    }
    [[nodiscard]] bool isKept(const osg::Node& node) const { return _kept == &node; }
    [[nodiscard]] osg::CullingSet::Mask maskBelowKept() const { return _maskBelowKept; }

    /// What searches of this visitor keep from view to view: see SearchMemory. Null: nothing yet.
    [[nodiscard]] osg::ref_ptr<osg::Referenced>& searchMemory() { return _searchMemory; }

protected:
    ~CullTraversal() override;

private:
    static constexpr std::size_t kCachedPlanes = 6;
    using Coefficients = std::array<double, 4 * kCachedPlanes>;

    [[nodiscard]] bool holds(const osg::Polytope::PlaneList& list) const;

    BinStatistics& _statistics;  // they own this state
    const DatabaseView* _databaseView = nullptr;
    bool _isLeftToOsg = false;
    const osg::Node* _kept = nullptr;
    osg::CullingSet::Mask _maskBelowKept = 0;
    std::deque<TileSelection> _selections;  // of databases within each other
    std::size_t _openSelections = 0;
    osg::ref_ptr<osg::Referenced> _searchMemory;

    core::PlaneSet _planes;
    Coefficients _coefficients{};
    std::size_t _planeCount = 0;

    // The eye, and what it was prepared for.
    std::optional<core::HorizonEye> _eye;
    osg::ref_ptr<const osg::RefMatrix> _modelView, _projection;  // held, so that OSG puts no others in their place
    std::array<double, 3> _eyeSpaceDepth{};
    unsigned int _eyeFrame = 0;
    double _eyeDepth = 0.0;
    std::optional<core::Ellipsoid> _eyeEllipsoid;  // none: not prepared yet
};

}  // namespace osgAnalyticBin
