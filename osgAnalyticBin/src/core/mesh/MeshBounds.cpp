// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../EarthScale.h"

#include <osgAnalyticBin/core/mesh/GeodeticMeshBounds.h>
#include <osgAnalyticBin/core/mesh/MeshBounds.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Where the closed forms of altitude hold, as derived: |a2/b2 - 1|.
constexpr double kMostFlattened = 0.01;
// Tangent of half the width in longitude that a mesh may have.
constexpr double kWidest = 20.0;
constexpr double kRunSlack = 1.001;  // for the ellipsoid's not being a sphere
// Chords come that much nearer to the axis than vertices.
constexpr double kNearerChords = 0.9;
// A function with this much of second derivative leaves its chords by that of 12 squared radii.
constexpr double kPerCircle = 1.0 / 24.0;
constexpr double kAngleRounding = 1e-14;
// The error that GeodeticMeshBounds promises, as a share of the larger radius.
constexpr double kMeshRounding = 1.6e-14;
constexpr std::size_t kLanes = 16;

// Lengths in the unit of the ellipsoid, given here for the earth in metres.
struct Lengths {
    explicit Lengths(double scale)
        : farthest(1.0e5 * scale),
          axisTolerance(1.0 * scale),
          polarCap(1000.0 * scale),
          longestChord(1.5e6 * scale),
          deepestChord(7.0e4 * scale),
          rounding(1e-6 * scale) {}

    // Where the closed forms of altitude hold, above or below the ellipsoid.
    double farthest;
    // Vertices so near to the axis have no longitude of their own; a mesh nearer than the second is taken to end at the
    // pole.
    double axisTolerance, polarCap;
    // Chords so long sag no deeper than that below their ends.
    double longestChord, deepestChord;
    double rounding;
};

// Maximum and minimum of several numbers, in lanes that the compiler vectorises. NaN is ignored.
struct Extremes {
    double low[kLanes];
    double high[kLanes];

    Extremes() {
        std::fill(low, low + kLanes, kInfinity);
        std::fill(high, high + kLanes, -kInfinity);
    }
    void add(std::size_t lane, double value) {
        low[lane] = value < low[lane] ? value : low[lane];
        high[lane] = value > high[lane] ? value : high[lane];
    }
    [[nodiscard]] Interval range() const {
        return {*std::min_element(low, low + kLanes), *std::max_element(high, high + kLanes)};
    }
};

// What one pass over the vertices finds.
struct VertexRanges {
    Interval altitude;      // metres
    Interval slope;         // z over the distance from the axis
    Interval tangent;       // of the longitude from the reference
    Interval axisDistance;  // metres
    bool isInFront = true;  // of the plane through the axis across the reference, but for those without a longitude
    bool isFinite = true;
};

struct EllipsoidTerms {
    double a, b, inverseA2, inverseB2, flattening;

    explicit EllipsoidTerms(const Ellipsoid& e)
        : a(e.equatorialRadius()),
          b(e.polarRadius()),
          inverseA2(1.0 / (a * a)),
          inverseB2(1.0 / (b * b)),
          flattening(a * a / (b * b) - 1.0) {}
};

class VertexPass {
public:
    VertexPass(const EllipsoidTerms& terms, const EcefMesh& mesh, double reference, double axisTolerance)
        : _terms(terms),
          _mesh(mesh),
          _axisTolerance(axisTolerance),
          _cos(std::cos(reference)),
          _sin(std::sin(reference)) {}

    VertexRanges run(std::vector<double>& altitudes, std::vector<double>& axisDistances) {
        const std::size_t count = _mesh.size();
        altitudes.resize(count);
        axisDistances.resize(count);
        for (std::size_t i = 0; i < count; i += kLanes) {
            // the last block overlaps the one before; a mesh of fewer vertices is padded with its first
            const std::size_t start = count < kLanes ? 0 : std::min(i, count - kLanes);
            const std::size_t size = std::min(count, kLanes);
            load(start, size);
            work();
            std::copy(_altitude, _altitude + size, altitudes.begin() + static_cast<std::ptrdiff_t>(start));
            std::copy(_rho, _rho + size, axisDistances.begin() + static_cast<std::ptrdiff_t>(start));
        }
        return {_altitudes.range(), _slopes.range(), _tangents.range(), _rhos.range(), isInFront(), isFinite()};
    }

private:
    void load(std::size_t start, std::size_t size) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const std::size_t i = start + (lane < size ? lane : 0);
            _x[lane] = _mesh.x[i];
            _y[lane] = _mesh.y[i];
            _z[lane] = _mesh.z[i];
        }
    }

    void work() {
        const double axisTolerance = _axisTolerance;
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const double rho2 = _x[lane] * _x[lane] + _y[lane] * _y[lane];
            const double polar2 = _z[lane] * _z[lane] * _terms.inverseB2;
            const double scaled = std::sqrt(rho2 * _terms.inverseA2 + polar2);
            _rho[lane] = std::sqrt(rho2);
            _altitude[lane] = (scaled - 1.0) * (_terms.a - 0.5 * _terms.a * _terms.flattening * polar2);
        }
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const double front = _x[lane] * _cos + _y[lane] * _sin;
            const double side = _y[lane] * _cos - _x[lane] * _sin;
            const bool hasLongitude = _rho[lane] > axisTolerance;
            const double tangent = side / front;
            _tangents.add(lane, hasLongitude ? tangent : 0.0);
            _fronts[lane] = hasLongitude && front < _fronts[lane] ? front : _fronts[lane];
            _slopes.add(lane, _z[lane] / _rho[lane]);
            _altitudes.add(lane, _altitude[lane]);
            _poison[lane] += _altitude[lane] - _altitude[lane];  // 0 for finite numbers only
            _rhos.add(lane, _rho[lane]);
        }
    }

    [[nodiscard]] bool isInFront() const {
        return std::all_of(_fronts, _fronts + kLanes, [](double front) { return front > 0.0; });
    }

    [[nodiscard]] bool isFinite() const {
        return std::all_of(_poison, _poison + kLanes, [](double poison) { return poison == 0.0; });
    }

    const EllipsoidTerms& _terms;
    const EcefMesh& _mesh;
    double _axisTolerance;
    double _cos, _sin;
    double _x[kLanes], _y[kLanes], _z[kLanes], _rho[kLanes], _altitude[kLanes];
    double _poison[kLanes] = {};
    double _fronts[kLanes] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
    Extremes _altitudes, _slopes, _tangents, _rhos;
};

// One end of the latitudes: +1 the northern, -1 the southern.
struct PolewardEnd {
    double pole;
    double guess;   // radians, of the extreme vertex
    double excess;  // metres that vertices are beyond the guess at most
    bool atPole = false;
};

// How far each vertex is beyond the guess, polewards. Returns: the largest.
double excesses(const Ellipsoid& ellipsoid, const PolewardEnd& end, const EcefMesh& mesh,
                const std::vector<double>& axisDistances, std::vector<double>& excess) {
    const GeodeticMeshBounds::LatitudeCone cone(ellipsoid, end.guess * end.pole);
    const double pole = end.pole;
    const std::size_t count = mesh.size();
    excess.resize(count);
    for (std::size_t i = 0; i < count; ++i) excess[i] = cone.excess(axisDistances[i], pole * mesh.z[i]);
    double lanes[kLanes];
    std::fill(lanes, lanes + kLanes, -kInfinity);
    const std::size_t whole = count / kLanes * kLanes;
    for (std::size_t i = 0; i < whole; i += kLanes)
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            lanes[lane] = excess[i + lane] > lanes[lane] ? excess[i + lane] : lanes[lane];
    for (std::size_t i = whole; i < count; ++i) lanes[0] = std::max(lanes[0], excess[i]);
    return *std::max_element(lanes, lanes + kLanes);
}

double referenceLongitude(const EcefMesh& mesh) {
    constexpr std::size_t kSamples = 16;
    double x = 0.0;
    double y = 0.0;
    for (std::size_t i = 0; i < kSamples; ++i) {
        const std::size_t sample = (mesh.size() - 1) * i / (kSamples - 1);
        x += mesh.x[sample];
        y += mesh.y[sample];
    }
    return std::atan2(y, x);
}

double squaredDistance(const EcefMesh& mesh, std::uint32_t i, std::uint32_t j) {
    const double x = mesh.x[i] - mesh.x[j];
    const double y = mesh.y[i] - mesh.y[j];
    const double z = mesh.z[i] - mesh.z[j];
    return x * x + y * y + z * z;
}

// What one pass over the triangles finds.
struct TriangleRanges {
    double low;           // metres, the lowest altitude of any chord
    double excess[2];     // metres, of chords beyond the two cones
    double longest2;      // square metres, of a side
    double widestCircle;  // square metres, 12 times the squared radius of the circle about a triangle
};

// Of so much curvature, per 12 squared radii: of altitude, and of the excesses; no excess is asked for when it is 0.
struct Curvatures {
    double altitude;
    double excess[2];
};

TriangleRanges trianglePass(const EcefMesh& mesh, const std::vector<double>& altitudes,
                            const std::vector<double> (&vertexExcess)[2], const Curvatures& curvatures) {
    TriangleRanges ranges{kInfinity, {-kInfinity, -kInfinity}, 0.0, 0.0};
    const double* const altitude = altitudes.data();
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
        const std::uint32_t a = mesh.triangles[i];
        const std::uint32_t b = mesh.triangles[i + 1];
        const std::uint32_t c = mesh.triangles[i + 2];
        const double ab = squaredDistance(mesh, a, b);
        const double bc = squaredDistance(mesh, b, c);
        const double ca = squaredDistance(mesh, c, a);
        const double longest = std::max(ab, std::max(bc, ca));
        const double circle = std::max(3.0 * longest, longest + ab + bc + ca);
        ranges.longest2 = std::max(ranges.longest2, longest);
        ranges.widestCircle = std::max(ranges.widestCircle, circle);
        const double lowest = std::min(altitude[a], std::min(altitude[b], altitude[c]));
        ranges.low = std::min(ranges.low, lowest - circle * curvatures.altitude);
        for (int side = 0; side < 2; ++side) {
            if (curvatures.excess[side] == 0.0) continue;
            const double* const excess = vertexExcess[side].data();
            const double most = std::max(excess[a], std::max(excess[b], excess[c]));
            ranges.excess[side] = std::max(ranges.excess[side], most + circle * curvatures.excess[side]);
        }
    }
    return ranges;
}

// Radians from the equator towards the end's pole. An excess of so many metres is so much latitude at least, and at
// most.
double latitudeLimit(const PolewardEnd& end, double chordExcess, const Interval& metresPerRadian, double rounding) {
    if (end.atPole) return kHalfPi;
    const double excess = std::max(end.excess, chordExcess) + rounding;
    const double beyond = excess >= 0.0 ? kRunSlack * std::asin(std::min(1.0, excess / metresPerRadian.lower))
                                        : excess / metresPerRadian.upper;
    return std::min(kHalfPi, end.guess * end.pole + beyond + kAngleRounding);
}

// A cone stands at the latitude that the steepest vertex would have on the ellipsoid.
PolewardEnd endOf(const Ellipsoid& ellipsoid, double pole, double steepest, bool nearAxis) {
    const double guess = std::atan(steepest / ellipsoid.squaredRatio());
    // what is near the axis is steep, on its own side; float vertices on the equator are on both
    return {pole, guess, -kInfinity, nearAxis && steepest * pole > 1.0};
}

}  // namespace

// Source: doc/theory/derivation.md, section 11.
bool MeshBounds::findInClosedForm(const Ellipsoid& ellipsoid, const EcefMesh& mesh) {
    const EllipsoidTerms terms(ellipsoid);
    if (!(std::abs(terms.flattening) <= kMostFlattened)) return false;

    const Lengths lengths(earthScale(ellipsoid));
    const double reference = referenceLongitude(mesh);
    const VertexRanges ranges =
        VertexPass(terms, mesh, reference, lengths.axisTolerance).run(_altitudes, _axisDistances);
    const double farthest = std::max(std::abs(ranges.altitude.lower), std::abs(ranges.altitude.upper));
    const double widest = std::max(std::abs(ranges.tangent.lower), std::abs(ranges.tangent.upper));
    if (!(farthest <= lengths.farthest) || !(widest <= kWidest) || !ranges.isInFront || !ranges.isFinite) return false;
    _axisError = ranges.axisDistance.lower <= lengths.axisTolerance ? lengths.axisTolerance : 0.0;
    const double flattening = std::abs(terms.flattening);
    _altitudeError = farthest * flattening * (0.5 * flattening + 1.05 * farthest / terms.b) + lengths.rounding;

    const bool nearAxis = ranges.axisDistance.lower < lengths.polarCap;
    PolewardEnd ends[2] = {endOf(ellipsoid, 1.0, ranges.slope.upper, nearAxis),
                           endOf(ellipsoid, -1.0, ranges.slope.lower, nearAxis)};
    bool runs[2] = {false, false};
    for (int side = 0; side < 2; ++side) {
        PolewardEnd& end = ends[side];
        if (end.atPole) continue;
        end.excess = excesses(ellipsoid, end, mesh, _axisDistances, _excess[side]);
        // chords run polewards; towards the equator they stay within their ends
        runs[side] = end.guess * end.pole > 0.0;
    }

    const double smallest =
        smallestCurvatureRadius(ellipsoid) + std::min(0.0, ranges.altitude.lower) - lengths.deepestChord;
    const double nearest = kNearerChords * ranges.axisDistance.lower;
    Curvatures curvatures{kPerCircle / smallest, {0.0, 0.0}};
    for (int side = 0; side < 2; ++side)
        if (runs[side]) curvatures.excess[side] = kPerCircle * std::sin(std::abs(ends[side].guess)) / nearest;
    const TriangleRanges chords = trianglePass(mesh, _altitudes, _excess, curvatures);
    const bool areShort = chords.longest2 <= lengths.longestChord * lengths.longestChord;
    const bool areFarFromAxis = !(runs[0] || runs[1]) || chords.longest2 <= 0.5 * nearest * nearest;
    if (!areShort || !areFarFromAxis) return false;
    _sag = chords.widestCircle * curvatures.altitude;
    const double low = std::min(chords.low, ranges.altitude.lower);

    const Interval metresPerRadian{smallest, largestCurvatureRadius(ellipsoid) + farthest};
    _bin = GeodeticBin({-latitudeLimit(ends[1], chords.excess[1], metresPerRadian, lengths.rounding),
                        latitudeLimit(ends[0], chords.excess[0], metresPerRadian, lengths.rounding)},
                       {reference + std::atan(ranges.tangent.lower) - kAngleRounding,
                        reference + std::atan(ranges.tangent.upper) + kAngleRounding},
                       {low - _altitudeError, ranges.altitude.upper + _altitudeError});
    return true;
}

// Source: doc/theory/derivation.md, section 5.
void MeshBounds::findByTriangles(const Ellipsoid& ellipsoid, const EcefMesh& mesh) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < mesh.size(); ++i) sum += mesh.vertex(i);
    if (!std::isfinite(sum.x + sum.y + sum.z)) return;
    const double axisTolerance = Lengths(earthScale(ellipsoid)).axisTolerance;
    GeodeticMeshBounds bounds(ellipsoid, std::atan2(sum.y, sum.x), axisTolerance);
    _axisError = 0.0;
    _altitudes.clear();
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        const glm::dvec3 vertex = mesh.vertex(i);
        bounds.expandByVertex(vertex);
        _altitudes.push_back(ellipsoid.toGeodetic(vertex).altitude);
        if (std::hypot(vertex.x, vertex.y) <= axisTolerance) _axisError = axisTolerance;
    }
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
        bounds.expandByTriangle(mesh.vertex(mesh.triangles[i]), mesh.vertex(mesh.triangles[i + 1]),
                                mesh.vertex(mesh.triangles[i + 2]));
    }
    _bin = bounds.bin();
    if (_bin.empty()) return;
    _altitudeError = kMeshRounding * std::max(ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    _sag = *std::min_element(_altitudes.begin(), _altitudes.end()) - _bin.altitude().lower;
}

// Triangles do not leave the box about their corners.
void MeshBounds::findInMap(const EcefMesh& mesh) {
    const Ellipsoid plane = Ellipsoid::plane();
    _altitudes = mesh.z;
    _altitudeError = _sag = _axisError = 0.0;
    Extremes x, y, z;
    bool isNear = true;
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        const Geodetic place = plane.toGeodetic(mesh.vertex(i));
        // written so that NaN is far
        isNear = isNear && std::abs(mesh.x[i]) <= Ellipsoid::kFarthestInMap &&
                 std::abs(mesh.y[i]) <= Ellipsoid::kFarthestInMap && std::isfinite(mesh.z[i]);
        x.add(i % kLanes, place.longitude);
        y.add(i % kLanes, place.latitude);
        z.add(i % kLanes, place.altitude);
    }
    if (isNear) _bin = GeodeticBin(y.range(), x.range(), z.range());
}

void MeshBounds::find(const Ellipsoid& ellipsoid, const EcefMesh& mesh) {
    _bin = GeodeticBin();
    _isQuick = ellipsoid.isPlane();
    if (_isQuick) return findInMap(mesh);
    _isQuick = mesh.size() > 0 && findInClosedForm(ellipsoid, mesh);
    if (!_isQuick && mesh.size() > 0) findByTriangles(ellipsoid, mesh);
}

}  // namespace osgAnalyticBin::core
