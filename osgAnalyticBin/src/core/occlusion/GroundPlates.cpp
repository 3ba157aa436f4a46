// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../EarthScale.h"
#include "../PerThread.h"
#include "../kernels/OcclusionKernels.h"
#include "PlateCells.h"

#include <osgAnalyticBin/core/mesh/GeodeticMeshBounds.h>
#include <osgAnalyticBin/core/mesh/MeshCover.h>
#include <osgAnalyticBin/core/occlusion/GroundPlates.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace osgAnalyticBin::core {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Codes of bounds: the first stands for what is not known.
constexpr std::uint16_t kUnknown = 0, kFirstCode = 1, kLastCode = 65535;

static_assert(kCellsOfGrids.back() == GroundPlates::kFinest && kStrips * kStrips == GroundPlates::kParts);

}  // namespace

// Goes over the triangles of a mesh. Source: doc/theory/occlusion.md, section 3.
class GroundPlates::Builder {
public:
    // `ends`: where its surface ends; elsewhere it covers all.
    Builder(GroundPlates& plates, const EcefMesh& mesh, const MeshCover::Ends& ends, double margin)
        : _plates(plates), _mesh(mesh) {
        findVertices();
        findReach();
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3)
            addTriangle({mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]});
        for (const auto& [from, to] : ends) {
            const Met met = metBy({from, to, to});
            _found.lower(met.rows, met.columns, -kInfinity);
        }
        plates.encode(_found, margin);
    }

private:
    using Corners = std::array<std::uint32_t, 3>;
    struct Vertex {
        Geodetic place;  // the longitude in the same turn as those of the extents
        MetCells rows, columns;
    };
    struct Met {
        MetCells rows, columns;
        Interval altitude;
    };
    // Keeps its memory from mesh to mesh.
    [[nodiscard]] static std::vector<Vertex>& vertices() {
        thread_local PerThread<std::vector<Vertex>> kept;
        return *kept;
    }

    void findVertices() {
        const double middle = _plates._longitude.middle();
        _vertices.resize(_mesh.size());
        for (std::size_t i = 0; i < _mesh.size(); ++i) {
            const glm::dvec3 v = _mesh.vertex(i);
            Geodetic& place = _vertices[i].place;
            place = _plates._ellipsoid.toGeodetic(v);
            place.longitude = middle + std::remainder(place.longitude - middle, 2.0 * kPi);
            _nearest = std::min(_nearest, axisDistanceOf(_plates._ellipsoid, v));
            _altitude.expandBy(place.altitude);
        }
    }

    // How far triangles reach beyond their corners at most, and what each vertex meets with that.
    void findReach() {
        const double radius = 0.9 * smallestCurvatureRadius(_plates._ellipsoid), axisDistance = 0.95 * _nearest;
        const TriangleSides sides = longestSides(radius);
        const TriangleReach reach(sides, _plates._ellipsoid, radius, axisDistance);
        _isWithinReach =
            TriangleReach::holdsFor(sides, radius, axisDistance, {_altitude.lower - reach.sag, _altitude.upper});
        if (!_isWithinReach) return;
        _sag = reach.sag;
        for (Vertex& vertex : _vertices) {
            const auto [latitude, longitude, altitude] = vertex.place;
            vertex.rows = _along.met({latitude - reach.aside, latitude + reach.aside});
            vertex.columns = _across.met({longitude - reach.around, longitude + reach.around});
        }
    }

    // Of all triangles. The altitudes of a side's ends differ by its vertical part, but for L²/2R.
    [[nodiscard]] TriangleSides longestSides(double radius) const {
        double longest2 = 0.0, horizontal2 = 0.0, rise = 0.0;
        for (std::size_t i = 0; i + 2 < _mesh.triangles.size(); i += 3) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = _mesh.triangles[i + k], b = _mesh.triangles[i + (k + 1) % 3];
                const glm::dvec3 side = _mesh.vertex(b) - _mesh.vertex(a);
                const double length2 = glm::dot(side, side);
                const double climb = std::abs(_vertices[b].place.altitude - _vertices[a].place.altitude);
                const double vertical = std::max(0.0, climb - 0.5 * length2 / radius);
                longest2 = std::max(longest2, length2);
                horizontal2 = std::max(horizontal2, length2 - vertical * vertical);
                rise = std::max(rise, climb);
            }
        }
        return TriangleSides::atAnyPoint(std::sqrt(longest2), std::sqrt(horizontal2), rise + 0.5 * longest2 / radius,
                                         radius);
    }

    [[nodiscard]] Met metBy(const Corners& c) const {
        if (!_isWithinReach) return thoroughlyMetBy(c);
        const Vertex &p = _vertices[c[0]], &q = _vertices[c[1]], &r = _vertices[c[2]];
        const auto [low, high] = std::minmax({p.place.altitude, q.place.altitude, r.place.altitude});
        return {
            p.rows.united(q.rows).united(r.rows), p.columns.united(q.columns).united(r.columns), {low - _sag, high}};
    }

    // Bounds that are not known reach into all cells, and bounds around the axis into those at all longitudes: they do
    // not count longitudes from where the extents do.
    [[nodiscard]] Met thoroughlyMetBy(const Corners& c) const {
        const Interval &latitude = _plates._latitude, &longitude = _plates._longitude;
        GeodeticMeshBounds bounds(_plates._ellipsoid, longitude.middle());
        for (const std::uint32_t corner : c) bounds.expandByVertex(_mesh.vertex(corner));
        bounds.expandByTriangle(_mesh.vertex(c[0]), _mesh.vertex(c[1]), _mesh.vertex(c[2]));
        const GeodeticBin bin = bounds.bin();
        if (bin.empty()) return {_along.met(latitude), _across.met(longitude), {-kInfinity, kInfinity}};
        return {_along.met(bin.latitude()), _across.met(bin.isFullCircle() ? longitude : bin.longitude()),
                bin.altitude()};
    }

    void addTriangle(const Corners& c) {
        // an end of a line, which may run through all parts
        const bool isPoint = c[0] == c[1] && c[1] == c[2];
        if (isPoint) {
            for (double& high : _found.high) high = std::max(high, _vertices[c[0]].place.altitude);
            return;
        }
        const Met met = metBy(c);
        _found.raise(met.rows, met.columns, met.altitude.upper);
        // lines
        const glm::dvec3 p = _mesh.vertex(c[0]), q = _mesh.vertex(c[1]), r = _mesh.vertex(c[2]);
        if (p == q || q == r || r == p) return;
        _found.lower(met.rows, met.columns, met.altitude.lower);
    }

    GroundPlates& _plates;
    const EcefMesh& _mesh;
    const CellsAlong _along{_plates._latitude}, _across{_plates._longitude};
    std::vector<Vertex>& _vertices = vertices();
    double _nearest = kInfinity;  // metres from the axis
    Interval _altitude = Interval::none();
    bool _isWithinReach = false;
    double _sag = 0.0;
    PlateBounds _found;
};

GroundPlates::GroundPlates() noexcept : _ellipsoid(1.0, 1.0) {
    _least.fill(kUnknown);
}

GroundPlates::GroundPlates(const Ellipsoid& ellipsoid, const Interval& latitude, const Interval& longitude) noexcept
    : _ellipsoid(ellipsoid), _latitude(latitude), _longitude(longitude), _middle(sinesOfMiddle(latitude, longitude)) {
    _least.fill(kUnknown);
    const double widest = std::max(latitude.width(), longitude.width());
    if (!(widest <= 2.0 * kernels::kFarthestFromMiddle)) return;
    for (const std::size_t cells : kCellsOfGrids) {
        if (fitsColumns(cells)) _fitting |= static_cast<std::uint8_t>(cells);
    }
}

GroundPlates::GroundPlates(const Ellipsoid& ellipsoid, const EcefMesh& mesh, const MeshCover& cover,
                           const GeodeticBin& extents, double margin)
    : GroundPlates(ellipsoid, extents.latitude(), extents.longitude()) {
    if (cover.isFilled && !extents.empty() && mayStandBeside(margin)) Builder(*this, mesh, cover.ends, margin);
}

// Whether a mesh that is drawn `margin` metres away from its place still covers what is within the rims.
bool GroundPlates::mayStandBeside(double margin) const noexcept {
    const bool isRound = std::abs(_ellipsoid.eccentricitySquared()) <= kRoundest;
    if (!isRound || !(_latitude.width() > 0.0) || !(_longitude.width() > 0.0)) return false;
    const double rim = kRim / 8.0 * narrowest();
    return _longitude.width() < kPi && margin >= 0.0 && (margin == 0.0 || margin < kMarginOfRim * rim);
}

// Metres of the extents, less than across any part of them; a parallel may end a little nearer to the pole.
double GroundPlates::narrowest() const noexcept {
    const double poleward = std::max(std::abs(_latitude.lower), std::abs(_latitude.upper));
    return 0.9 * smallestCurvatureRadius(_ellipsoid) *
           std::min(_latitude.width(), 0.9 * std::cos(poleward) * _longitude.width());
}

// Rounds lower bounds down to 16 bits, and upper bounds up. Minus infinity: not known.
void GroundPlates::encode(const PlateBounds& found, double margin) noexcept {
    static_assert(kPlateCells == kNumbers);
    const auto& [low, high] = found;
    // more than the error of altitudes
    const double room = margin + 2e-14 * std::max(_ellipsoid.equatorialRadius(), _ellipsoid.polarRadius());
    Interval known = Interval::none();
    for (const double bound : low) {
        if (std::isfinite(bound)) known = known.united({bound - room, bound});
    }
    for (const double bound : high) {
        if (std::isfinite(bound)) known.upper = std::max(known.upper, bound + room);
    }
    if (!(known.lower <= known.upper)) return;
    _step = known.width() / static_cast<double>(kLastCode - 4);
    _base = known.lower - 2.0 * _step;
    for (std::size_t i = 0; i < low.size(); ++i) {
        if (!std::isfinite(low[i])) continue;
        const double code = std::floor((low[i] - room - _base) / _step);
        _least[i] = static_cast<std::uint16_t>(std::clamp<double>(code, kFirstCode, kLastCode));
        while (_least[i] > kUnknown && decoded(_least[i]) > low[i] - room) --_least[i];
    }
    _most.fill(kFirstCode);
    for (std::size_t i = 0; i < high.size(); ++i) raise(i, high[i] + room);
}

// Raises the upper bound of a part to an altitude at least.
void GroundPlates::raise(std::size_t part, double altitude) noexcept {
    std::uint16_t& code = _most[part];
    if (code == kUnknown || altitude <= decoded(code)) return;
    const double next = std::ceil((altitude - _base) / _step);
    if (!(next < kLastCode)) {
        code = kUnknown;
        return;
    }
    code = static_cast<std::uint16_t>(std::max<double>(next, code));
    // rounding
    if (decoded(code) < altitude) ++code;
}

bool GroundPlates::isKnown() const noexcept {
    return std::any_of(_least.begin(), _least.end(), [](std::uint16_t code) { return code != kUnknown; });
}

double GroundPlates::least(std::size_t cells, std::size_t row, std::size_t column) const noexcept {
    const std::uint16_t code = _least[numberOf(cells, row, column)];
    return code == kUnknown ? -kInfinity : decoded(code);
}

// Whether skirts stay in the parts that their upper edges count for. Source: doc/theory/occlusion.md, section 3,
// "Tops".
bool GroundPlates::mayHang(double skirt) const noexcept {
    const double slender = _latitude.width() / std::max(_latitude.width(), _longitude.width());
    const double deepest = std::min(0.5 * narrowest(), 0.06 * smallestCurvatureRadius(_ellipsoid) * slender);
    return skirt >= 0.0 && skirt <= deepest;
}

// Whether the inner borders of the bin's parts are near those of the mesh's.
bool GroundPlates::hasPartsOf(const GeodeticBin& bin) const noexcept {
    const auto areNear = [](const Interval& extents, const Interval& ofBin) {
        const double aside = std::abs(ofBin.middle() - extents.middle());
        return aside + 0.25 * std::abs(ofBin.width() - extents.width()) <= 0.25 * kRoomOfPart * extents.width();
    };
    return areNear(_latitude, bin.latitude()) && areNear(_longitude, bin.longitude());
}

double GroundPlates::most(std::size_t part, const GeodeticBin& bin) const noexcept {
    return hasPartsOf(bin) ? top(part) : kInfinity;
}

double GroundPlates::mostOfQuarter(std::size_t quarter, const GeodeticBin& bin) const noexcept {
    if (!hasPartsOf(bin)) return kInfinity;
    const std::size_t first = 4 * quarter;
    return std::max({top(first), top(first + 1), top(first + 2), top(first + 3)});
}

double GroundPlates::top(std::size_t part) const noexcept {
    return _most[part] != kUnknown ? decoded(_most[part]) : kInfinity;
}

// Whether columns keep within the rims of a grid's cells.
bool GroundPlates::fitsColumns(std::size_t cells) const noexcept {
    const double across = _longitude.width() / static_cast<double>(cells);
    const double along = _latitude.width() / static_cast<double>(cells);
    const double inner = 1.0 - 2.0 * kRim;
    // doc/theory/occlusion.md, section 2: how far chords of a parallel leave it toward the pole, in latitude;
    // cos x >= 1 - x²/2
    const double square = 0.125 * inner * across * inner * across;
    const double bulge = 0.55 * square / (1.0 - square);
    // longitudes many turns away from zero are rounded coarsely
    const bool isWide = across * kRim > 64.0 * kEpsilon * (1.0 + std::abs(_longitude.lower));
    return isWide && across * inner < 1.0 && bulge < kBulgeOfRim * kRim * along;
}

double GroundPlates::shallowest() const noexcept {
    return 0.1 * std::min(_ellipsoid.equatorialRadius(), _ellipsoid.polarRadius());
}

namespace {

// The cells of all grids in one quarter of a tile, the finest grid first: where their columns end, in heights and
// widths of the tile from its middle, and their numbers.
struct QuarterCells {
    static constexpr std::size_t kCount = 16 + 4 + 1 + 1;
    std::array<double, kCount> south{}, north{}, west{}, east{};
    std::array<std::size_t, kCount> number{};
    std::array<std::size_t, kCount> above{};  // the cell of the next coarser grid that holds it; the last has none

    constexpr explicit QuarterCells(std::size_t quarter) {
        std::size_t i = 0;
        for (std::size_t cells = kCellsOfGrids.back(); cells > 0; cells /= 2) {
            const std::size_t half = cells / 2, here = half > 0 ? half : 1;
            for (std::size_t k = 0; k < here * here; ++k, ++i) {
                const std::size_t row = quarter / 2 * half + k / here, column = quarter % 2 * half + k % here;
                const auto share = [cells](std::size_t from, double at) {
                    return (static_cast<double>(from) + at) / static_cast<double>(cells) - 0.5;
                };
                south[i] = share(row, kRim), north[i] = share(row, 1.0 - kRim);
                west[i] = share(column, kRim), east[i] = share(column, 1.0 - kRim);
                number[i] = numberOf(cells, row, column);
                above[i] = first(cells / 2) + (cells > 2 ? k / here / 2 * (here / 2) + k % here / 2 : 0);
            }
        }
    }
    // How many cells come before those of a grid.
    [[nodiscard]] static constexpr std::size_t first(std::size_t cells) {
        return cells == 8 ? 0 : cells == 4 ? 16 : cells == 2 ? 20 : cells == 1 ? 21 : kCount;
    }
};
constexpr std::array<QuarterCells, 4> kQuarters{QuarterCells(0), QuarterCells(1), QuarterCells(2), QuarterCells(3)};

}  // namespace

void GroundPlates::columns(std::size_t finest, std::size_t coarsest, std::size_t quarter, double depth, double worth,
                           const InverseFrame& frame, EarthColumns& columns) const noexcept {
    const QuarterCells& cells = kQuarters[quarter];
    columns.size = 0;
    const double farthest = shallowest();
    if (!(depth >= 0.0 && depth < farthest)) return;
    std::array<double, QuarterCells::kCount> altitude{};  // minus infinity: not known
    std::array<double, EarthColumns::kMost> south{}, north{}, west{}, east{}, high{};
    for (std::size_t grid = coarsest; grid <= finest; grid *= 2) {
        const bool isFit = (_fitting & grid) != 0;
        for (std::size_t i = QuarterCells::first(grid); i < QuarterCells::first(grid / 2); ++i) {
            const std::uint16_t code = _least[cells.number[i]];
            const bool isKnown = isFit && code != kUnknown && std::abs(decoded(code)) < farthest;
            altitude[i] = isKnown ? decoded(code) : -kInfinity;
            if (grid > coarsest && !(altitude[i] > altitude[cells.above[i]] + worth)) continue;
            south[columns.size] = cells.south[i], north[columns.size] = cells.north[i];
            west[columns.size] = cells.west[i], east[columns.size] = cells.east[i];
            high[columns.size] = isKnown ? altitude[i] : std::numeric_limits<double>::quiet_NaN();
            columns.error[columns.size] =
                32.0 * kEpsilon * (_ellipsoid.equatorialRadius() + std::abs(high[columns.size]) + depth);
            ++columns.size;
        }
    }
    kernels::activeOcclusion.columns(cellGround(_ellipsoid, _latitude, _longitude, _middle, depth, frame),
                                     {south.data(), north.data(), west.data(), east.data(), high.data(), columns.size},
                                     columns.corners.data(), EarthColumns::kMost);
}

}  // namespace osgAnalyticBin::core
