// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../Scoped.h"
#include "../tile/TerrainHider.h"
#include "DatabaseRest.h"
#include "DrawnState.h"
#include "GroundBelow.h"
#include "HidingView.h"
#include "TileSelection.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/TerrainShape.h>
#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/horizon/CoveredRegion.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <osg/Camera>
#include <osg/CullStack>
#include <osg/CullingSet>
#include <osg/Group>
#include <osg/Node>
#include <osg/NodeVisitor>
#include <osg/Referenced>
#include <osg/observer_ptr>
#include <osg/ref_ptr>

#include <cstddef>
#include <deque>
#include <unordered_map>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

class CullTraversal;
class InstalledDatabase;

/// What a database provides to its tiles during its traversal.
struct DatabaseView {
    osg::Group& root;
    // Of the traversal where the view was made: what has the same matrices below has the same planes.
    osg::NodeVisitor& visitor;
    CullTraversal& traversal;  // the visitor's state
    osg::CullStack& cullStack;
    const osg::RefMatrix* modelView;
    const osg::RefMatrix* projection;
    core::PlaneSet planes;
    const InstalledDatabase* database;
    core::Ellipsoid ellipsoid;
    TerrainShape shape;
    TileSelection* selection;                     // of what is drawn
    TileSelection* hidden;                        // knows which tiles terrain hides
    StateRules rules{};                           // what the database's states are judged by
    const osgUtil::StateGraph* states = nullptr;  // down to the database's root
    const core::CoveredRegion* region = nullptr;  // that is covered; null: the globe
    bool expectsHole = false;                     // as in the last view
    const core::HorizonEye* eye = nullptr;        // in ECEF, whatever transforms are below; null: nothing is hidden
    const core::HorizonEye* fileEye = nullptr;    // tiles behind its horizon ask for no files; null: all tiles ask
    const osg::Referenced* pager = nullptr;       // OSG's own DatabasePager, where it is asked for files; else null
    Gain* gain = nullptr;                         // null: not counted in this view
    bool isCold = true;                           // what is read is hardly in the processor's caches
};

/// The state of one cull visitor: its frustum, prepared once for all tiles, and the database that is traversed. Stored
/// with the visitor's counters, so that cull threads share nothing.
class CullTraversal final : public osg::Referenced {
public:
    explicit CullTraversal(BinStatistics& statistics);

    /// The visitor's state, created at the first call.
    [[nodiscard]] OSGANALYTICBIN_EXPORT static CullTraversal& of(osg::NodeVisitor& visitor);

    /// The visitor's counters.
    [[nodiscard]] BinStatistics& statistics() const { return _statistics; }

    /// Sets, while it exists, what a database provides to its tiles; null: it leaves them to stock OSG.
    class DatabaseScope {
    public:
        DatabaseScope(osg::NodeVisitor& visitor, CullTraversal& traversal, const DatabaseView* view);

    private:
        const Scoped<const DatabaseView*> _view;
        const Scoped<bool> _leftToOsg;
        const Scoped<std::size_t> _openSelections;
        const Scoped<std::pair<const osg::NodeVisitor*, CullTraversal*>> _ofThread;
    };

    /// All planes of the cull stack's current frustum, because OSG's masks may refer to any of them.
    [[nodiscard]] const core::PlaneSet& planes(osg::CullStack& cullStack);

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

    /// @{
    /// What searches of this visitor keep from view to view.
    /// Results about a database, for one camera.
    struct LastView {
        const osg::Camera* camera = nullptr;  ///< never dereferenced
        double depth = 0.0;                   ///< metres, of the lowest surface shown; the next search starts there
        unsigned int waits = 0;               ///< views in a row in which finer ground below the eye was awaited
        unsigned int holes = 0;               ///< views since a search last did not come to nothing
        unsigned int rest = 0;                ///< views without occlusion that follow a view in which it hid too little
        unsigned int resting = 0;             ///< how many of them are left
        unsigned int forOneView = 0;          ///< views in a row in which what was found served that view alone
        osg::ref_ptr<TerrainHider> hider;     ///< null: none was needed yet
        DatabaseRest databaseRest;            ///< while bins gain nothing
    };
    /// Of the innermost camera above the visitor's node. Of more than a few cameras, several share theirs.
    [[nodiscard]] OSGANALYTICBIN_EXPORT LastView& lastView(const InstalledDatabase& database,
                                                           const osg::NodeVisitor& visitor);
    GroundBelow ground;  ///< last found below the eye
    HidingView hiding;   ///< for nodes that are no tiles
    /// @}

protected:
    ~CullTraversal() override;

private:
    BinStatistics& _statistics;  // they own this state
    const DatabaseView* _databaseView = nullptr;
    bool _isLeftToOsg = false;
    const osg::Node* _kept = nullptr;
    osg::CullingSet::Mask _maskBelowKept = 0;
    std::deque<TileSelection> _selections;  // of databases within each other
    std::size_t _openSelections = 0;
    struct LastViews {
        osg::observer_ptr<const InstalledDatabase> of;  // another one may get its address
        std::vector<LastView> views;                    // the last used first
    };
    std::unordered_map<const InstalledDatabase*, LastViews> _lastViews;
    core::PlaneSet _planes;
};

}  // namespace osgAnalyticBin
