// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/CoveredPicture.h>
#include <osgAnalyticBin/viewer/Export.h>

#include <osg/Camera>
#include <osg/CoordinateSystemNode>
#include <osg/FrameStamp>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/Vec4>

#include <cstddef>
#include <memory>
#include <vector>

namespace osgAnalyticBin {

/// The verdict of a cull traversal on a tile.
enum class TileVerdict {
    Outside,     ///< outside a plane of the frustum, by its bin or its sphere, or too small
    Straddling,  ///< of the frustum's planes some are undecided
    Inside,      ///< inside all planes
    Hidden,      ///< behind the horizon
    BeyondEdge,  ///< beyond an edge of the frustum, though outside no single plane
    Occluded     ///< behind terrain
};

/// What statistics and legends call a verdict: "outside", "straddling", "inside", "behind the horizon", "beyond an
/// edge", "behind terrain".
[[nodiscard]] OSGANALYTICBINVIEWER_EXPORT const char* verdictName(TileVerdict verdict);

/// The colour that a verdict is shown in, opaque. Over terrain, at six tenths, no colour looks like another of them.
[[nodiscard]] OSGANALYTICBINVIEWER_EXPORT osg::Vec4 verdictColour(TileVerdict verdict);

/// A tile that a camera's cull traversal reached.
struct SurveyedTile {
    osg::ref_ptr<osg::Node> node;  ///< a PagedLOD with a mesh of its own, or a leaf
    bool hasBin = false;     ///< whether a bin decided; otherwise verdict, bin, ellipsoid and ecefToWorld mean nothing
    bool isCulled = false;   ///< whether nothing below the tile was traversed
    bool isDrawn = false;    ///< whether a mesh of its own was drawn
    bool isRefined = false;  ///< whether tiles below it were met
    TileVerdict verdict = TileVerdict::Straddling;  ///< the bin's
    /// What the tile was culled by: in the present shape of the terrain, skirts included. Not valid in a map.
    AnalyticBin bin;
    osg::ref_ptr<const osg::EllipsoidModel> ellipsoid;  ///< the globe that the bin is on
    osg::Matrixd ecefToWorld;                           ///< where that globe stands
};

/// Numbers of tiles that a camera's cull traversal reached, by result.
struct TileCounts {
    std::size_t tested = 0;      ///< all that it came to
    std::size_t kept = 0;        ///< of these, that it went into
    std::size_t drawn = 0;       ///< of those kept, with a mesh of their own drawn
    std::size_t hidden = 0;      ///< of those not kept
    std::size_t beyondEdge = 0;  ///< of those not kept
    std::size_t occluded = 0;    ///< of those not kept: behind terrain
};

/// Runs one more cull traversal of a camera's scene by the camera's culling view. It draws nothing and requests no
/// file. Tiles are those of TileFinder, so that counts of all methods are comparable. A bin's verdict is read from the
/// counters of this traversal. Requires: a camera with a viewport, and no update or cull traversal meanwhile: call it
/// in the event phase, where it repeats the last frame. Cost: one walk over the loaded scene, and one cull traversal.
class OSGANALYTICBINVIEWER_EXPORT TileSurvey {
public:
    /// An empty survey.
    TileSurvey() = default;
    /// Runs the cull traversal.
    TileSurvey(osg::Camera& camera, osg::FrameStamp& frameStamp);

    /// In the order of the traversal: parents before children.
    [[nodiscard]] const std::vector<SurveyedTile>& tiles() const { return _tiles; }

    /// The part of the picture that terrain covers. Returns: nullptr when there was no search for tiles behind terrain.
    [[nodiscard]] const CoveredPicture* covered() const { return _covered.get(); }

    /// Why there was none: see BinStatistics::notCovered().
    [[nodiscard]] const char* notCovered() const { return _notCovered; }

    /// Sums of tiles().
    [[nodiscard]] TileCounts counts() const;

private:
    std::vector<SurveyedTile> _tiles;
    std::shared_ptr<const CoveredPicture> _covered;
    const char* _notCovered = nullptr;
};

}  // namespace osgAnalyticBin
