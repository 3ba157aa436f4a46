// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/TerrainShape.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/QuadraticOrExact.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <osg/CoordinateSystemNode>
#include <osg/Matrixd>
#include <osg/NodeCallback>

#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace osg {
class CullStack;
}

namespace osgAnalyticBin {

namespace core {
class PlaneSet;
}  // namespace core
class CullTraversal;
class InstalledTile;
class TileFamily;
struct DatabaseView;

/// The cull callback of a tile: tests the tile's bin against the frustum planes that are still undecided, and culls
/// the tile when the bin is outside one of them. OSG tests the node's sphere before, as on any node; installBins() has
/// siblings tested together in place of that. Planes that have the whole bin inside are not tested again in the
/// subgraph. Small-feature culling still works; while the camera has active OccluderNodes, OSG's own culling is all
/// there is. Nested callbacks run when the tile is not culled. It obeys the camera's culling mode. Without frustum
/// culling the horizon is not used either, because neither frustum nor eye determine what is drawn then.
/// Frame: the bin is in ECEF. The node's children are in ECEF, too, unless setLocalToEcef() gives another frame.
/// Transforms above the globe need no setting, because OSG's planes follow them.
/// Guarantee: a tile is never culled if a point of its bin is inside all planes and not behind the horizon;
/// tests: AnalyticBinCullCallback.*. An invalid bin is never culled.
/// Threads: run() changes nothing in the callback; any number of cull traversals may run it at once. Setters must not
/// be called while a cull traversal runs.
/// Cost: the first test after a change of the bin prepares it, with one allocation and trigonometry; later tests need
/// neither. Memory: 330 bytes, and 750 more once a tile has been tested alone. A tile that is tested together with its
/// siblings does not need these.
class OSGANALYTICBIN_EXPORT AnalyticBinCullCallback : public osg::NodeCallback {
public:
    AnalyticBinCullCallback();
    /// Culls by this bin on this ellipsoid.
    AnalyticBinCullCallback(const AnalyticBin& bin, const osg::EllipsoidModel& ellipsoid,
                            const CullOptions& options = {});
    /// A copy of all settings.
    AnalyticBinCullCallback(const AnalyticBinCullCallback& other,
                            const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);

    META_Object(osgAnalyticBin, AnalyticBinCullCallback)

        /// The box that holds all that the tile and its descendants draw, or will draw when they are loaded.
        void setBin(const AnalyticBin& bin);
    /// The bin that the tile is culled by, before any terrain shape.
    [[nodiscard]] const AnalyticBin& getBin() const { return _bin; }

    /// The bin that the tile is culled by, in its present shape, skirts included.
    [[nodiscard]] AnalyticBin shownBin() const;

    /// How the tile is culled. Options for installers alone are ignored.
    void setCullOptions(const CullOptions& options);
    /// Default: CullOptions(). Valid until the next setter.
    [[nodiscard]] const CullOptions& getCullOptions() const { return _setup->options; }

    /// Metres; default: those of a default osg::EllipsoidModel. Both infinite: the bin is one of a map, a box in its
    /// coordinates, with latitudes and longitudes as core::Ellipsoid::plane() has them; ECEF stands for the map's
    /// coordinates then, and there is no horizon. With other radii that are not finite and positive the tile is never
    /// culled.
    void setRadii(double equatorial, double polar);
    /// See setRadii().
    [[nodiscard]] core::Ellipsoid ellipsoid() const { return {_setup->equatorialRadius, _setup->polarRadius}; }

    /// From the frame of the node's children to ECEF; default identity. The frustum test is right under any invertible
    /// affine matrix; small-feature culling needs a rigid matrix or a uniform scale.
    void setLocalToEcef(const osg::Matrixd& matrix);
    /// See setLocalToEcef().
    [[nodiscard]] const osg::Matrixd& getLocalToEcef() const;

    /// For an osgTerrain tile: the terrain shape that its bin was made for. The bin that is set is the one at vertical
    /// scale 1. The tile is never culled while its database is shown in another shape, or while it is not below a
    /// database with bins. nullopt: the mesh does not belong to an osgTerrain::Terrain.
    void setTerrainShape(const std::optional<TerrainShape>& shape);
    /// See setTerrainShape(). Valid until the next setter.
    [[nodiscard]] const std::optional<TerrainShape>& getTerrainShape() const { return _setup->shape; }

    /// Metres by which skirts hang below the bin; they count as a part of it.
    void setSkirt(double metres);
    /// Metres, default 0.
    [[nodiscard]] double getSkirt() const { return _skirt; }

    /// The bin of the tile's own surface, without descendants, at vertical scale 1. The horizon depends on its lowest
    /// altitude while the tile is shown. Invalid: not known; no horizon is used while the tile is shown.
    void setSurface(const AnalyticBin& surface);
    /// See setSurface().
    [[nodiscard]] const AnalyticBin& getSurface() const { return _surface; }

    /// A lower bound in metres of the altitudes of the tile's own surface in its present shape; minus infinity when not
    /// known.
    [[nodiscard]] double getSurfaceLow() const { return _surfaceAltitude.lower; }

    /// An upper bound in metres of the altitudes of the tile's own surface in its present shape; infinity when not
    /// known.
    [[nodiscard]] double getSurfaceHigh() const { return _surfaceAltitude.upper; }

    /// An upper bound in metres of the altitudes that the tile and its descendants draw; infinity when not known.
    [[nodiscard]] double getBinHigh() const { return _altitude.upper; }

    /// A lower bound in metres of the altitudes that the tile and its descendants draw, skirts included; minus infinity
    /// when not known.
    [[nodiscard]] double getBinLow() const { return _altitude.lower; }

    /// A sphere in ECEF, for a quick first test. It holds the bin's column: the bin and, where the bin lies below the
    /// ellipsoid, the space above it up to the ellipsoid. Returns: nullptr when none is prepared.
    [[nodiscard]] const osg::BoundingSphere* ecefColumnSphere() const;

    /// Whether the eye sees nothing of the bin's column for the horizon. Requires: an eye on the bin's ellipsoid.
    [[nodiscard]] bool isColumnHiddenFrom(const core::HorizonEye& eye) const;

    /// The properties as text, as the serializer stores them, exact in every file format: the bin as
    /// AnalyticBin::toText() writes it, then, separated by semicolons, those that are set of "installed" (set by an
    /// installer; without one the tile is never culled), "skirt METRES", "surface BIN" and "terrain VERTICALSCALE
    /// SAMPLERATIO AREBOUNDARIESEQUAL ISKNOWN". Malformed text: a warning, and the tile is never culled.
    void setBinText(const std::string& text);
    /// The text that setBinText() reads; empty without a valid bin, and while the bin does not hold all content below
    /// the tile.
    [[nodiscard]] std::string getBinText() const;
    /// As cullOptionsFromText() reads it; the default, after a warning, when it is malformed.
    void setOptionsText(const std::string& text);
    /// toText() of the options.
    [[nodiscard]] std::string getOptionsText() const;
    /// "EQUATORIAL POLAR" in metres, or "map"; malformed: a warning, and the tile is never culled.
    void setRadiiText(const std::string& text);
    /// The radii as setRadiiText() reads them.
    [[nodiscard]] std::string getRadiiText() const;
    /// Sixteen numbers, row by row, or nothing for the identity; malformed: a warning, and the tile is never culled.
    void setLocalToEcefText(const std::string& text);
    /// The matrix as setLocalToEcefText() reads it.
    [[nodiscard]] std::string getLocalToEcefText() const;

    /// Data that an installer keeps with the callback; nullptr: a callback made by the application. A copy of an
    /// installed callback culls nothing, because its bin was made for the original's node.
    [[nodiscard]] InstalledTile* getInstalledTile() const;
    /// See getInstalledTile(); for installers.
    void setInstalledTile(InstalledTile* tile);
    /// Whether an installer made it, or it is the saved copy of one that an installer made.
    [[nodiscard]] bool isInstalled() const { return _installed || _wasInstalled; }

    /// The eye whose horizon hides tiles of the database that the visitor is traversing; ECEF. For cull callbacks of
    /// applications below the database. Returns: nullptr when nothing is hidden.
    [[nodiscard]] static const core::HorizonEye* horizonEye(osg::NodeVisitor& visitor);

    /// Called by OSG's cull traversal: goes on below the node unless the tile is culled.
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

protected:
    ~AnalyticBinCullCallback() override;

private:
    friend class TileFamily;

    static constexpr core::Interval kUnknown{-std::numeric_limits<double>::infinity(),
                                             std::numeric_limits<double>::infinity()};

    // What a test of this tile alone reads.
    struct Prepared {
        core::QuadraticOrExact bin;
        std::optional<core::ExactGeodeticBin>
            separable;  // for the test against edges, where `bin` is not the exact one
        std::optional<core::HorizonBin> horizon;
        osg::BoundingSphere sphere;  // in the frame of the node's children
        osg::BoundingSphere columnSphere;
        std::optional<core::HorizonBin> columnHorizon;  // where it is not that of the bin
    };
    // What most tiles of a database have in common. A setter replaces the whole object; nothing changes it.
    struct Setup {
        CullOptions options;
        double equatorialRadius, polarRadius;
        std::optional<TerrainShape> shape;
        [[nodiscard]] bool operator==(const Setup& other) const;
    };
    // The frame of the node's children, where it is not ECEF.
    struct LocalFrame {
        osg::Matrixd toEcef, fromEcef;
    };

    // An equal object that this thread has made lately and that is still in use, or else a new one.
    [[nodiscard]] static std::shared_ptr<const Setup> shared(const Setup& setup);
    template <class Change>
    void changeSetup(const Change& change);
    [[nodiscard]] static core::Interval altitudeOf(const AnalyticBin& shown);
    void changeBin();
    void discardPrepared();
    [[nodiscard]] const Prepared& prepared() const;
    [[nodiscard]] Prepared makePrepared() const;
    [[nodiscard]] bool isInMap() const {
        return std::isinf(_setup->equatorialRadius) && std::isinf(_setup->polarRadius);
    }
    void leaveFamily();
    void fillSlot() const;
    void refuse(const char* why);
    [[nodiscard]] bool readItem(const std::string& item);
    [[nodiscard]] core::QuadraticOrExact preparedBin(const AnalyticBin& shown, const core::Ellipsoid& ellipsoid) const;
    [[nodiscard]] const DatabaseView* viewOn(osg::CullStack& cullStack, CullTraversal& traversal) const;
    [[nodiscard]] std::optional<core::HorizonEye> eyeWithoutDatabase(osg::CullStack& cullStack, osg::NodeVisitor& nv,
                                                                     const CullTraversal& traversal) const;
    [[nodiscard]] bool standsAsInstalled(osg::CullStack& cullStack, const DatabaseView& database) const;
    [[nodiscard]] bool isCulled(const osg::Node& node, osg::CullStack& cullStack, osg::NodeVisitor& nv) const;
    [[nodiscard]] bool isSurelyInside(osg::CullStack& cullStack) const;
    [[nodiscard]] BinReason hiddenBy(const osg::Node& node, osg::NodeVisitor& nv, osg::CullStack& cullStack,
                                     CullTraversal& traversal) const;
    [[nodiscard]] bool mayBeHidden(const osg::Node& node, osg::NodeVisitor& nv, const DatabaseView* view) const;
    [[nodiscard]] bool isBeyondAnEdge(const core::PlaneSet& planes, core::PlaneMask undecided) const;

    bool _wasInstalled = false;  // in a scene that was saved
    osg::ref_ptr<InstalledTile> _installed;
    bool _isTested = false;                                   // by a bin; without one the tile is never culled
    mutable std::atomic<const Prepared*> _prepared{nullptr};  // owned; made when it is first asked for
    std::shared_ptr<const Setup> _setup;
    std::unique_ptr<const LocalFrame> _frame;  // null: ECEF
    AnalyticBin _bin;
    AnalyticBin _surface;
    core::Interval _altitude = kUnknown;  // of the bin
    core::Interval _surfaceAltitude = kUnknown;
    double _skirt = 0.0;
};

}  // namespace osgAnalyticBin
