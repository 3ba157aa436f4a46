// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Skirts.h"

#include "../../core/EarthScale.h"
#include "../../core/mesh/KeyNumbers.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace osgAnalyticBin {

namespace {

constexpr float kBorder = 1e-6f;  // of texture coordinates
// Skirts of one tile are equally deep to this part of their depth and this many metres on the earth, in proportion
// elsewhere (float vertices of large tiles).
constexpr double kDepthTolerance = 0.02;
constexpr double kDepthRounding = 4.0;
constexpr double kShallowest = 1.0;  // metres on the earth
// How far from straight down a skirt may hang: the geocentric vertical is 0.2 degrees off.
constexpr double kPlumbCosine = 0.999;

std::uint8_t edgesAt(const osg::Vec2& t) {
    const unsigned int south = unsigned{t.y() <= kBorder} * kSouthEdge;
    const unsigned int east = unsigned{t.x() >= 1.0f - kBorder} * kEastEdge;
    const unsigned int north = unsigned{t.y() >= 1.0f - kBorder} * kNorthEdge;
    const unsigned int west = unsigned{t.x() <= kBorder} * kWestEdge;
    return static_cast<std::uint8_t>(south | east | north | west);
}

bool isInUnitSquare(const osg::Vec2& t) {
    constexpr float kLow = -kBorder;
    constexpr float kHigh = 1.0f + kBorder;
    return static_cast<int>(t.x() >= kLow) & static_cast<int>(t.x() <= kHigh) & static_cast<int>(t.y() >= kLow) &
           static_cast<int>(t.y() <= kHigh);
}

struct Pair {
    std::uint32_t upper;
    std::uint32_t lower;
};

// The squared distance of two vertices, one straight below the other; NaN when it is not.
class DepthMeasure {
public:
    explicit DepthMeasure(const core::Ellipsoid& ellipsoid)
        : _isPlane(ellipsoid.isPlane()),
          _equatorial(1.0 / (ellipsoid.equatorialRadius() * ellipsoid.equatorialRadius())),
          _polar(1.0 / (ellipsoid.polarRadius() * ellipsoid.polarRadius())),
          _shallowest2(kShallowest * kShallowest * core::earthScale(ellipsoid) * core::earthScale(ellipsoid)) {}

    [[nodiscard]] double depth2(const glm::dvec3& upper, const glm::dvec3& lower) const {
        const glm::dvec3 hanging = upper - lower;
        const glm::dvec3 up = _isPlane ? glm::dvec3(0.0, 0.0, 1.0)
                                       : glm::dvec3(upper.x * _equatorial, upper.y * _equatorial, upper.z * _polar);
        const double depth2 = glm::dot(hanging, hanging);
        const double along = glm::dot(hanging, up);
        const bool plumb = along > 0.0 && along * along >= kPlumbCosine * kPlumbCosine * depth2 * glm::dot(up, up);
        return plumb && depth2 >= _shallowest2 ? depth2 : std::numeric_limits<double>::quiet_NaN();
    }

    // Whether the first is the upper one of two, straight below each other.
    [[nodiscard]] bool isUpper(const glm::dvec3& a, const glm::dvec3& b) const {
        return _isPlane ? a.z > b.z : glm::dot(a, a) > glm::dot(b, b);
    }

private:
    bool _isPlane;
    double _equatorial, _polar, _shallowest2;
};

// Returns: no pairs unless every border vertex has exactly one partner.
std::vector<Pair> pairsOf(const SurfaceMesh& mesh, const std::vector<std::uint8_t>& marks,
                          const DepthMeasure& measure) {
    std::vector<std::uint32_t> border(mesh.size());
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < mesh.size(); ++i) {
        border[count] = i;
        count += marks[i] != 0;
    }
    core::KeyNumbers<std::array<std::uint64_t, 2>> places(count);
    std::vector<std::uint32_t> firstAt;  // by the number of the place
    std::vector<Pair> pairs;
    pairs.reserve(count / 2);
    std::vector<std::uint8_t> paired(mesh.size(), 0);
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t i = border[k];
        const osg::Vec2& at = mesh.texCoords[i];
        const std::uint32_t place = places.numberOf({core::bitsOf(at.x()), core::bitsOf(at.y())});
        if (place == firstAt.size()) {
            firstAt.push_back(i);
            continue;
        }
        const std::uint32_t other = firstAt[place];
        if (paired[other]) return {};
        paired[other] = 1;
        const bool otherIsUpper = measure.isUpper(mesh.vertex(other), mesh.vertex(i));
        pairs.push_back({otherIsUpper ? other : i, otherIsUpper ? i : other});
    }
    if (2 * pairs.size() != count) return {};
    return pairs;
}

// The triangles with a lower vertex, by their first index; `areSkirts` is false when one has a vertex off the border.
struct HangingTriangles {
    std::vector<std::uint32_t> first;
    bool areSkirts = true;
};

HangingTriangles hangingTriangles(const SurfaceMesh& mesh, const std::vector<std::uint8_t>& marks) {
    HangingTriangles hanging;
    hanging.first.resize(mesh.triangles.size() / 3 + 1);
    std::size_t count = 0;
    unsigned int bad = 0;
    // without branches, which would be mispredicted
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
        const unsigned int a = marks[mesh.triangles[i]];
        const unsigned int b = marks[mesh.triangles[i + 1]];
        const unsigned int c = marks[mesh.triangles[i + 2]];
        const unsigned int hangs = ((a | b | c) & kSkirtVertex) / kSkirtVertex;
        bad |= hangs & (unsigned{a == 0} | unsigned{b == 0} | unsigned{c == 0});
        hanging.first[count] = static_cast<std::uint32_t>(i);
        count += hangs;
    }
    hanging.first.resize(count);
    hanging.areSkirts = bad == 0;
    return hanging;
}

void fold(const std::vector<Pair>& pairs, SurfaceMesh& mesh) {
    for (const Pair& pair : pairs) {
        mesh.x[pair.lower] = mesh.x[pair.upper];
        mesh.y[pair.lower] = mesh.y[pair.upper];
        mesh.z[pair.lower] = mesh.z[pair.upper];
    }
}

// Two sides of a folded triangle are chords of the border, or all are points.
double longestChord2(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& folded) {
    double longest2 = 0.0;
    for (const std::uint32_t i : folded) {
        const glm::dvec3 middle = mesh.vertex(mesh.triangles[i + 1]);
        const glm::dvec3 before = mesh.vertex(mesh.triangles[i]) - middle;
        const glm::dvec3 after = mesh.vertex(mesh.triangles[i + 2]) - middle;
        longest2 = std::max(longest2, std::max(glm::dot(before, before), glm::dot(after, after)));
    }
    return longest2;
}

}  // namespace

MeshSkirts foldSkirts(SurfaceMesh& mesh, const core::Ellipsoid& ellipsoid) {
    if (!mesh.texCoords) return {};
    MeshSkirts skirts;
    skirts.marks.resize(mesh.size());
    bool inUnitSquare = true;
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        inUnitSquare &= isInUnitSquare(mesh.texCoords[i]);
        skirts.marks[i] = edgesAt(mesh.texCoords[i]);
    }
    if (!inUnitSquare) return {};
    const DepthMeasure measure(ellipsoid);
    const std::vector<Pair> pairs = pairsOf(mesh, skirts.marks, measure);
    if (pairs.empty()) return {};

    double shallowest2 = std::numeric_limits<double>::infinity();
    double deepest2 = 0.0;
    bool plumb = true;
    for (const Pair& pair : pairs) {
        const double depth2 = measure.depth2(mesh.vertex(pair.upper), mesh.vertex(pair.lower));
        plumb &= depth2 > 0.0;
        shallowest2 = std::min(shallowest2, depth2);
        deepest2 = std::max(deepest2, depth2);
        skirts.marks[pair.lower] |= kSkirtVertex;
    }
    skirts.depth = std::sqrt(deepest2);
    const double rounding = kDepthRounding * core::earthScale(ellipsoid);
    const bool equal = skirts.depth <= std::sqrt(shallowest2) * (1.0 + kDepthTolerance) + rounding;
    if (!plumb || !equal) return {};
    const HangingTriangles hanging = hangingTriangles(mesh, skirts.marks);
    if (!hanging.areSkirts) return {};
    fold(pairs, mesh);
    skirts.borderChord2 = longestChord2(mesh, hanging.first);
    return skirts;
}

}  // namespace osgAnalyticBin
