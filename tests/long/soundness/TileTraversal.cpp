// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileTraversal.h"

#include "BinSamples.h"
#include "ComparisonBins.h"
#include "FrustumHull.h"
#include "RivalBins.h"

#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>
#include <osgAnalyticBin/core/edge/HullSeparation.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <support/RandomBins.h>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

using core::Ellipsoid;
using core::ExactGeodeticBin;
using core::Geodetic;
using core::GeodeticBin;
using core::GeodeticMapping;
using core::HorizonBin;
using core::HorizonEye;
using core::Interval;
using core::Plane;
using core::PlaneMask;
using core::QuadraticBin;
using core::Side;
using hull::FrustumHull;
using hull::ReverseBin;
using rivals::CornersBin;
using rivals::PaperBin;

// Tiles are refined while they are closer than this many of their widths.
constexpr double kRefineWithin = 3.0;
constexpr int kDeepestTile = 15;
constexpr int kSamples = 24;

using MethodMask = std::uint32_t;

struct Tile {
    int level, row, column;
    Interval heights;

    [[nodiscard]] GeodeticBin bin() const {
        const double deg = std::ldexp(kRootTileDeg, -level);
        return GeodeticBin::fromDegrees({-90.0 + row * deg, -90.0 + (row + 1) * deg},
                                        {-180.0 + column * deg, -180.0 + (column + 1) * deg}, heights);
    }
    [[nodiscard]] double width() const {
        return std::ldexp(kRootTileDeg, -level) * kRadiansPerDegree * wgs84().equatorialRadius();
    }
};

class Traversal {
public:
    Traversal(const View& view, const Heights& heights, double depth)
        : _view(view),
          _heights(heights),
          _planes(view.planes()),
          _hull(_planes, _planes.size()),
          _depth(depth),
          _scale(1.0 - depth / wgs84().polarRadius()),
          _horizon(HorizonEye::fromEye(wgs84(), depth, view.eye)) {}

    Counts run() {
        for (int row = 0; row < 8; ++row) {
            for (int column = 0; column < 16; ++column) {
                visit({0, row, column, _heights.root(row, column)}, (MethodMask{1} << kMethods) - 1);
            }
        }
        return _counts;
    }

private:
    void visit(const Tile& tile, MethodMask alive) {
        const GeodeticBin bin = tile.bin();
        const bool inFrustum = isTrulyInFrustum(bin);
        const bool hidden = inFrustum && isTrulyHidden(bin);
        if (hidden) noteHidden(bin);
        alive = kept(bin, alive);
        // Nothing below is kept, nor seen.
        if (alive == 0 && (!inFrustum || hidden)) return;
        if (tile.level < kDeepestTile && distanceTo(bin) < kRefineWithin * tile.width()) {
            for (int i = 0; i < 4; ++i) {
                const int row = 2 * tile.row + i / 2;
                const int column = 2 * tile.column + i % 2;
                visit({tile.level + 1, row, column, _heights.child(tile.heights, tile.level + 1, row, column)}, alive);
            }
            return;
        }
        const bool seen = inFrustum && !hidden;
        _counts.truth += seen ? 1 : 0;
        for (std::size_t m = 0; m < kMethods; ++m) {
            const bool keeps = (alive >> m) & 1;
            if (keeps) ++_counts.kept[m];
            if (seen && !keeps) ++_counts.missed[m];
        }
    }

    [[nodiscard]] bool isTrulyInFrustum(const GeodeticBin& bin) const {
        const ExactGeodeticBin exact(wgs84(), bin);
        for (const Plane& plane : _planes) {
            if (exact.classify(plane) == Side::Outside) return false;
        }
        return hullsMeet(wgs84(), bin, _view);
    }

    [[nodiscard]] bool isTrulyHidden(const GeodeticBin& bin) const {
        if (!_horizon) return false;
        bool hidden = true;
        const RealVector eye = real(_view.eye);
        forSamples(bin, kSamples, [&](const Geodetic& position) {
            hidden = !segmentMissesOccluder(wgs84(), _depth, geodeticToEcef(wgs84(), position), eye);
            return hidden;
        });
        return hidden;
    }

    void noteHidden(const GeodeticBin& bin) {
        ++_counts.hidden;
        if (_horizon->hides(HorizonBin(wgs84(), bin))) ++_counts.hiddenFound;
    }

    [[nodiscard]] double distanceTo(const GeodeticBin& bin) const {
        double least = 1e30;
        forSamples(bin, 4, [&](const Geodetic& position) {
            least = std::min(least, glm::distance(_view.eye, wgs84().toEcef(position)));
            return true;
        });
        return least;
    }

    template <class Bin>
    [[nodiscard]] bool inPlanes(const Bin& bin, PlaneMask* undecided = nullptr) const {
        PlaneMask mask = (PlaneMask{1} << _planes.size()) - 1;
        const Side side = core::classify(bin, _planes, _planes.size(), mask);
        if (undecided) *undecided = mask;
        return side != Side::Outside;
    }

    // The methods that keep the tile, of those that kept its parent.
    [[nodiscard]] MethodMask kept(const GeodeticBin& bin, MethodMask alive) const {
        const ExactGeodeticBin exact(wgs84(), bin);
        const GeodeticMapping mapping(wgs84());
        const core::ParameterBox box = core::parameterBox(bin);
        const QuadraticBin quadratic(mapping, box);
        const bool hidden = _horizon && _horizon->hides(HorizonBin(wgs84(), bin));
        PlaneMask exactMask = 0;
        PlaneMask quadraticMask = 0;
        const bool exactKeeps = inPlanes(exact, &exactMask);
        const bool quadraticKeeps = inPlanes(quadratic, &quadraticMask);
        const bool reverse = exactKeeps && isSeparated(ReverseBin(exact, bin), _hull);
        const bool hull = exactKeeps && core::isSeparated(exact, _planes, _planes.size(), exactMask);
        const bool quadraticHull = reverse || core::isSeparated(exact, _planes, _planes.size(), quadraticMask);
        MethodMask result = 0;
        const auto set = [&](Method m, bool keeps) { result |= keeps ? MethodMask{1} << m : 0; };
        set(kSphere, !hidden && sphereKeeps(bin, _planes));
        set(kBoxHorizonPoint, BoxWithHorizonPoint(bin, _scale).keeps(_planes, _view.eye));
        set(kCorners, !hidden && inPlanes(CornersBin(mapping, box)));
        set(kPaper, !hidden && inPlanes(PaperBin(mapping, box)));
        set(kQuadratic, !hidden && quadraticKeeps);
        set(kExact, !hidden && exactKeeps);
        set(kExactReverse, !hidden && exactKeeps && !reverse);
        set(kExactHull, !hidden && exactKeeps && !hull);
        set(kExactReverseHull, !hidden && exactKeeps && !reverse && !hull);
        set(kQuadraticReverseHull, !hidden && quadraticKeeps && !quadraticHull);
        return result & alive;
    }

    View _view;
    const Heights& _heights;
    std::vector<Plane> _planes;
    FrustumHull _hull;
    double _depth;
    double _scale;
    std::optional<HorizonEye> _horizon;
    Counts _counts;
};

}  // namespace

Counts countLeaves(const View& view, const Heights& heights, double depth) {
    return Traversal(view, heights, depth).run();
}

}  // namespace osgAnalyticBin::test
