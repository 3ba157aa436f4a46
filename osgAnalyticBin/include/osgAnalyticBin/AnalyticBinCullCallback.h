// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>
#include <osgAnalyticBin/core/rivals/BoxBins.h>
#include <osgAnalyticBin/core/rivals/ComparisonBins.h>

#include <osg/CoordinateSystemNode>
#include <osg/Matrixd>
#include <osg/NodeCallback>

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <variant>

namespace osg {
class CullStack;
}

namespace osgAnalyticBin {

namespace core {
class PlaneSet;
}
class CullTraversal;
class InstalledTile;
class TileFamily;
struct DatabaseView;
struct Verdict;

/// What osgTerrain::Terrain says about the meshes of its tiles while they are shown.
struct TerrainShape {
    /// osgTerrain::Terrain::setVerticalScale().
    double verticalScale = 1.0;
    /// osgTerrain::Terrain::setSampleRatio().
    double sampleRatio = 1.0;
    bool areBoundariesEqual = false;  ///< Whether edges lie half way to the heights of neighbours.
    bool isKnown = true;              ///< Whether osgTerrain::GeometryTechnique itself makes the meshes.

    /// Whether the meshes have the same shape.
    [[nodiscard]] bool operator==(const TerrainShape& other) const {
        return verticalScale == other.verticalScale && sampleRatio == other.sampleRatio &&
               areBoundariesEqual == other.areBoundariesEqual && isKnown == other.isKnown;
    }
};

/// The cull callback of a tile: tests the tile's bin against the frustum planes that are still undecided, and culls
/// the tile when the bin is outside one of them. It stands in place of OSG's sphere test (installBins() switches that
/// off on the nodes it treats): planes with the bin proven inside are not tested again in the subgraph, and
/// small-feature and shadow-occluder culling are kept. Nested callbacks run when the tile is not culled.
/// It obeys the culling mode of the camera that is culled for; without frustum culling there is no horizon either, for
/// then neither frustum nor eye say what is drawn.
/// Frame: the bin is in ECEF; the frame in which the node's children stand is ECEF too unless setLocalToEcef() says
/// otherwise. Transforms above the globe need nothing: OSG's planes follow them.
/// Guarantee (all methods but Method::Paper and Method::Corners): a tile is never culled if a point of its bin is
/// inside all planes and not behind the horizon; tests: AnalyticBinCullCallback.*. An invalid bin is never culled.
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

        /// The box that holds all that the tile and its descendants draw.
        void setBin(const AnalyticBin& bin);
    /// The bin as it was set, before any terrain shape.
    [[nodiscard]] const AnalyticBin& getBin() const { return _bin; }

    /// How the tile is culled; items that are an installer's alone are not read.
    void setCullOptions(const CullOptions& options);
    /// Default: CullOptions(). Valid until the next setter.
    [[nodiscard]] const CullOptions& getCullOptions() const { return _setup->options; }

    /// Metres; default: those of a default osg::EllipsoidModel. With radii that are not finite and positive the tile is
    /// never culled.
    void setRadii(double equatorial, double polar);

    /// From the frame of the node's children to ECEF; default identity. Has to be rigid or a uniform scale for
    /// small-feature culling to mean what it says; the frustum test is right under any invertible affine matrix.
    void setLocalToEcef(const osg::Matrixd& matrix);
    /// See setLocalToEcef().
    [[nodiscard]] const osg::Matrixd& getLocalToEcef() const;

    /// For an osgTerrain tile: the shape that its bin is to be for; the bin set is that at vertical scale 1. While its
    /// database is shown in another shape, or no installed database is above it, the tile is never culled. nullopt: a
    /// mesh that no Terrain shapes.
    void setTerrainShape(const std::optional<TerrainShape>& shape);
    /// See setTerrainShape(). Valid until the next setter.
    [[nodiscard]] const std::optional<TerrainShape>& getTerrainShape() const { return _setup->shape; }

    /// Metres by which skirts hang below the bin; they count as a part of it.
    void setSkirt(double metres);
    /// Metres, default 0.
    [[nodiscard]] double getSkirt() const { return _skirt; }

    /// What the tile draws by itself, without descendants, at vertical scale 1: how deep an eye may see where it is
    /// shown. Invalid: not known, and no horizon is used where it is shown.
    void setSurface(const AnalyticBin& surface);
    /// See setSurface().
    [[nodiscard]] const AnalyticBin& getSurface() const { return _surface; }

    /// Altitude in metres below which the tile draws nothing by itself, in its present shape; minus infinity when not
    /// known. For eyes that are to be looked past the tile.
    [[nodiscard]] double getSurfaceLow() const { return _surfaceLow; }

    /// Altitude in metres above which the tile draws nothing by itself, likewise; infinity when not known.
    [[nodiscard]] double getSurfaceHigh() const { return _surfaceHigh; }

    /// Altitude in metres above which neither the tile nor a descendant of it draws anything; infinity when not known.
    [[nodiscard]] double getBinHigh() const { return _binHigh; }

    /// Altitude in metres below which neither the tile nor a descendant of it draws anything, skirts left out unless
    /// they count; minus infinity when not known.
    [[nodiscard]] double getBinLow() const { return _binLow; }

    /// A sphere in ECEF that holds the bin's column, for a first look: the bin and, where it lies below the ellipsoid,
    /// what is above it up to there. Returns: nullptr when there is none at hand.
    [[nodiscard]] const osg::BoundingSphere* ecefColumnSphere() const;

    /// Whether the eye sees nothing of the bin's column for the horizon. Requires: an eye on the bin's ellipsoid.
    [[nodiscard]] bool isColumnHiddenFrom(const core::HorizonEye& eye) const;

    /// The same properties as text, exact in every file format; what the serializer stores. The bin as
    /// AnalyticBin::toText() has it, and after semicolons what is set of "installed" (by
    /// an installer, without which the tile is never culled), "skirt METRES", "surface BIN", "terrain
    /// VERTICALSCALE SAMPLERATIO AREBOUNDARIESEQUAL ISKNOWN". Malformed: a warning, and the tile is never culled.
    void setBinText(const std::string& text);
    /// As setBinText() reads it; empty without a valid bin, and while something stands below the tile that the bin does
    /// not hold.
    [[nodiscard]] std::string getBinText() const;
    /// As cullOptionsFromText() reads it; the default, after a warning, when it is malformed.
    void setOptionsText(const std::string& text);
    /// toText() of the options.
    [[nodiscard]] std::string getOptionsText() const;
    /// "EQUATORIAL POLAR" in metres; malformed: a warning, and the tile is never culled.
    void setRadiiText(const std::string& text);
    /// The radii as setRadiiText() reads them.
    [[nodiscard]] std::string getRadiiText() const;
    /// Sixteen numbers, row by row, or nothing for the identity; malformed: a warning, and the tile is never culled.
    void setLocalToEcefText(const std::string& text);
    /// The matrix as setLocalToEcefText() reads it.
    [[nodiscard]] std::string getLocalToEcefText() const;

    /// What an installer keeps beside the callback; nullptr: the application's own callback. A copy of an installed
    /// callback culls nothing: its bin was made for the node that the original stands on.
    [[nodiscard]] InstalledTile* getInstalledTile() const;
    /// See getInstalledTile(); for installers.
    void setInstalledTile(InstalledTile* tile);

    /// Called by OSG's cull traversal: goes on below the node unless the tile is culled.
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

protected:
    ~AnalyticBinCullCallback() override;

private:
    friend class TileFamily;

    using PreparedBin = std::variant<core::QuadraticBin, core::ExactGeodeticBin, core::PaperBin, core::CornersBin,
                                     core::BoxBin, core::OrientedBoxBin>;
    // What a test of this tile alone reads.
    struct Prepared {
        PreparedBin bin;
        std::optional<core::ExactGeodeticBin>
            separable;  // for the test against edges, where `bin` is not the exact one
        std::optional<core::HorizonBin> horizon;
        osg::BoundingSphere sphere;  // in the frame of the node's children
        osg::BoundingSphere columnSphere;
        std::optional<core::HorizonBin> columnHorizon;   // where it is not that of the bin
        std::optional<core::HorizonPoint> horizonPoint;  // in place of the bin's horizon, for boxes
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
    void changeBin();
    void discardPrepared();
    [[nodiscard]] const Prepared& prepared() const;
    [[nodiscard]] Prepared makePrepared() const;
    [[nodiscard]] core::Ellipsoid ellipsoid() const { return {_setup->equatorialRadius, _setup->polarRadius}; }
    void leaveFamily();
    void fillSlot() const;
    void refuse(const char* why);
    [[nodiscard]] bool readItem(const std::string& item);
    [[nodiscard]] AnalyticBin shownBin() const;
    [[nodiscard]] PreparedBin preparedBin(const AnalyticBin& shown, const core::Ellipsoid& ellipsoid) const;
    [[nodiscard]] const core::HorizonEye* eyeOn(osg::CullStack& cullStack, osg::NodeVisitor& nv,
                                                CullTraversal& traversal) const;
    [[nodiscard]] bool standsAsInstalled(osg::CullStack& cullStack, const DatabaseView& database) const;
    [[nodiscard]] bool isCulled(const osg::Node& node, osg::CullStack& cullStack, osg::NodeVisitor& nv) const;
    [[nodiscard]] core::Side sideOf(const core::PlaneSet& planes, core::PlaneMask& undecided) const;
    [[nodiscard]] Verdict verdict(core::Side side, const core::PlaneSet& planes, core::PlaneMask undecided,
                                  const core::HorizonEye* eye, CullTraversal& traversal) const;
    [[nodiscard]] bool isHiddenFrom(const core::HorizonEye& eye) const;
    [[nodiscard]] bool isBehindTerrain(CullTraversal& traversal) const;
    [[nodiscard]] bool isBeyondAnEdge(CullTraversal& traversal, const core::PlaneSet& planes,
                                      core::PlaneMask undecided) const;

    bool _wasInstalled = false;  // in a scene that was saved
    osg::ref_ptr<InstalledTile> _installed;
    bool _isTested = false;                                   // by a bin; without one the tile is never culled
    mutable std::atomic<const Prepared*> _prepared{nullptr};  // owned; made when it is first asked for
    bool _testsEdges = false;
    bool _hidesByPoint = false;
    std::shared_ptr<const Setup> _setup;
    std::unique_ptr<const LocalFrame> _frame;  // null: ECEF
    AnalyticBin _bin;
    AnalyticBin _surface;
    double _surfaceLow;
    double _surfaceHigh;
    double _binLow;
    double _binHigh;
    double _skirt = 0.0;
};

}  // namespace osgAnalyticBin
