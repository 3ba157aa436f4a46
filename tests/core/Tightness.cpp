// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Counts the leaf tiles that each method keeps, over random cameras, against the truth: leaves whose convex hull meets
// the frustum (libccd) and of which a dense sample of points sees the eye past the occluder. A quadtree of 16 x 8 tiles
// of 22.5 degrees is refined by distance; a method that culls a tile culls its leaves. Heights are made up, or real
// from a raster of least and greatest heights:
//   gdal_translate -of ENVI -co INTERLEAVE=BSQ -ot Int16 minmax.tif heights.raw
// Such a raster has 576 x 288 cells from 180 W and 90 N on, first all least heights, then all greatest.
// Fails when a bar is missed.

#include <osgAnalyticBin/core/ComparisonBins.h>
#include <osgAnalyticBin/core/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/FrustumHull.h>
#include <osgAnalyticBin/core/GeodeticMapping.h>
#include <osgAnalyticBin/core/Horizon.h>
#include <osgAnalyticBin/core/HullSeparation.h>
#include <osgAnalyticBin/core/QuadraticBin.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>
#include <support/RandomBins.h>
#include <support/View.h>
#include <thread>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

using core::CornersBin;
using core::Ellipsoid;
using core::ExactGeodeticBin;
using core::FrustumHull;
using core::Geodetic;
using core::GeodeticBin;
using core::GeodeticMapping;
using core::HorizonBin;
using core::HorizonEye;
using core::Interval;
using core::PaperBin;
using core::Plane;
using core::PlaneMask;
using core::QuadraticBin;
using core::ReverseBin;
using core::Side;

// Tiles are refined while they are closer than this many of their widths.
constexpr double kRefineWithin = 3.0;
constexpr int kDeepestTile = 15;
constexpr int kSamples = 24;

enum Method : std::size_t {
    kSphere,
    kBoxHorizonPoint,
    kCorners,
    kPaper,
    kQuadratic,
    kExact,
    kExactReverse,
    kExactHull,
    kExactReverseHull,
    kQuadraticReverseHull,
    kMethods
};
constexpr std::array<const char*, kMethods> kMethodNames{"sphere", "box+point", "corners", "paper", "quadratic",
                                                         "exact",  "+reverse",  "+hull",   "+both", "quad+both"};
using MethodMask = std::uint32_t;

struct Row {
    const char* name;
    double fovDeg;
    double lowest, highest;     // eye above ground, metres
    double pitchFrom, pitchTo;  // degrees below the horizontal
    double bar;                 // most excess of exact with reverse and hull, percent
};

constexpr std::array<Row, 7> kRows{{{"fov 60 down 100-10000 km", 60, 1e5, 1e7, 90, 90, 1.5},
                                    {"fov 60 oblique 10-500 km", 60, 1e4, 5e5, 15, 60, 1.5},
                                    {"fov 60 level 0.2-5 km", 60, 200, 5e3, -5, 10, 1.5},
                                    {"fov 60 level 5-100 km", 60, 5e3, 1e5, -5, 10, 1.5},
                                    {"fov 10 level 0.2-5 km", 10, 200, 5e3, -2, 5, 4.0},
                                    {"fov 10 down 15-30 deg", 10, 1e3, 1e5, 15, 30, 4.0},
                                    {"fov 10 down from orbit", 10, 2e5, 1e6, 30, 90, 4.0}}};

struct Options {
    int cameras = 100;
    unsigned threads = std::max(1u, std::thread::hardware_concurrency());
    std::string heights;
    double depth = 12000.0;
};

// Least and greatest heights of tiles: of a raster where there is one and its cells are fine enough, below that made up
// by narrowing the parent's interval.
class Heights {
public:
    explicit Heights(const std::string& file) {
        if (file.empty()) return;
        std::ifstream stream(file, std::ios::binary);
        _cells.resize(2 * kColumns * kLines);
        stream.read(reinterpret_cast<char*>(_cells.data()), static_cast<std::streamsize>(_cells.size() * 2));
        if (!stream) {
            std::fprintf(stderr, "cannot read %s\n", file.c_str());
            std::exit(EXIT_FAILURE);
        }
    }

    [[nodiscard]] Interval root(int row, int column) const {
        return _cells.empty() ? narrowed({-11000.0, 9000.0}, 0, row, column) : ofCells(0, row, column);
    }

    [[nodiscard]] Interval child(const Interval& parent, int level, int row, int column) const {
        if (!_cells.empty() && level <= kFinestRasterLevel) return ofCells(level, row, column);
        return narrowed(parent, level, row, column);
    }

private:
    static constexpr std::size_t kColumns = 576, kLines = 288;
    static constexpr int kFinestRasterLevel = 5;
    static constexpr double kLowestBelievable = -11500.0;

    static Interval narrowed(const Interval& parent, int level, int row, int column) {
        Random random((static_cast<std::uint64_t>(level) << 56) ^ (static_cast<std::uint64_t>(row) << 28) ^
                          static_cast<std::uint64_t>(column),
                      7);
        const double width = parent.width() * random.uniform(0.5, 0.8);
        const double lower = parent.lower + random.uniform() * (parent.width() - width);
        return {lower, lower + width};
    }

    [[nodiscard]] Interval ofCells(int level, int row, int column) const {
        const double cells = 36.0 / std::ldexp(1.0, level);  // a tile is this many cells wide
        const auto first = [&](int i) { return static_cast<std::size_t>(std::floor(i * cells)); };
        const auto last = [&](int i) { return static_cast<std::size_t>(std::ceil((i + 1) * cells)); };
        Interval result{1e9, -1e9};
        for (std::size_t y = first(row); y < std::min(kLines, last(row)); ++y) {
            for (std::size_t x = first(column); x < std::min(kColumns, last(column)); ++x) {
                const std::size_t cell = (kLines - 1 - y) * kColumns + x;
                result.lower = std::min(result.lower, std::max<double>(_cells[cell], kLowestBelievable));
                result.upper = std::max<double>(result.upper, _cells[cell + kColumns * kLines]);
            }
        }
        return result;
    }

    std::vector<std::int16_t> _cells;
};

struct Counts {
    std::uint64_t truth = 0;
    std::array<std::uint64_t, kMethods> kept{}, missed{};
    std::uint64_t hidden = 0, hiddenFound = 0;  // tiles of all levels in the frustum that are truly hidden

    void add(const Counts& other) {
        truth += other.truth;
        hidden += other.hidden;
        hiddenFound += other.hiddenFound;
        for (std::size_t m = 0; m < kMethods; ++m) {
            kept[m] += other.kept[m];
            missed[m] += other.missed[m];
        }
    }
};

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

template <class Function>
void forSamples(const GeodeticBin& bin, int steps, const Function& function) {
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; j <= steps; ++j) {
            for (const double h : {bin.altitude().upper, bin.altitude().lower}) {
                const Geodetic position{bin.latitude().lower + bin.latitude().width() * i / steps,
                                        bin.longitude().lower + bin.longitude().width() * j / steps, h};
                if (!function(position)) return;
            }
        }
    }
}

// A box along the axes of the middle, by exact supports, and a point that is hidden only when all of the tile is.
class BoxWithHorizonPoint {
public:
    BoxWithHorizonPoint(const GeodeticBin& bin, double scale) {
        const Ellipsoid ellipsoid = wgs84();
        const ExactGeodeticBin exact(ellipsoid, bin);
        const Geodetic middle = bin.center();
        const glm::dvec3 radial(std::cos(middle.longitude), std::sin(middle.longitude), 0.0);
        const glm::dvec3 z(0.0, 0.0, 1.0);
        _axes = {glm::cross(z, radial), std::cos(middle.latitude) * z - std::sin(middle.latitude) * radial,
                 std::cos(middle.latitude) * radial + std::sin(middle.latitude) * z};
        for (std::size_t i = 0; i < 3; ++i) {
            const double most = exact.support(_axes[i]);
            const double least = -exact.support(-_axes[i]);
            _center += 0.5 * (most + least) * _axes[i];
            _half[i] = 0.5 * (most - least);
        }
        _radii =
            scale * glm::dvec3(ellipsoid.equatorialRadius(), ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
        const glm::dvec3 direction = glm::normalize(ellipsoid.toEcef({middle.latitude, middle.longitude, 0}) / _radii);
        double farthest = 0.0;
        forSamples(bin, 8, [&](const Geodetic& position) {
            const glm::dvec3 x = ellipsoid.toEcef(position) / _radii;
            const double length = std::max(1.0, glm::length(x));
            const double cosAlpha = glm::dot(x, direction) / glm::length(x);
            const double sinAlpha = std::sqrt(std::max(0.0, 1.0 - cosAlpha * cosAlpha));
            const double inverse = (cosAlpha - sinAlpha * std::sqrt(length * length - 1.0)) / length;
            farthest = inverse > 0.0 ? std::max(farthest, 1.0 / inverse) : 1e30;
            return true;
        });
        _point = farthest < 1e29 ? farthest * direction : glm::dvec3(0.0);
    }

    [[nodiscard]] bool keeps(const std::vector<Plane>& planes, const glm::dvec3& eye) const {
        for (const Plane& plane : planes) {
            double reach = 0.0;
            for (std::size_t i = 0; i < 3; ++i) reach += _half[i] * std::abs(glm::dot(plane.normal, _axes[i]));
            if (plane.distance(_center) + reach < 0.0) return false;
        }
        const glm::dvec3 e = eye / _radii;
        const double e2 = glm::dot(e, e) - 1.0;
        if (e2 <= 0.0 || _point == glm::dvec3(0.0)) return true;
        const glm::dvec3 toPoint = _point - e;
        const double along = -glm::dot(toPoint, e);
        return !(along > e2 && along * along > e2 * glm::dot(toPoint, toPoint));
    }

private:
    std::array<glm::dvec3, 3> _axes;
    std::array<double, 3> _half{};
    glm::dvec3 _center{0.0}, _radii{0.0}, _point{0.0};
};

// The smallest sphere about the middle of the box that bounds the tile.
bool sphereKeeps(const GeodeticBin& bin, const std::vector<Plane>& planes) {
    const ExactGeodeticBin exact(wgs84(), bin);
    glm::dvec3 least, most;
    for (glm::length_t i = 0; i < 3; ++i) {
        glm::dvec3 axis(0.0);
        axis[i] = 1.0;
        most[i] = exact.support(axis);
        least[i] = -exact.support(-axis);
    }
    const glm::dvec3 center = 0.5 * (least + most);
    double radius = 0.0;
    forSamples(bin, 8, [&](const Geodetic& position) {
        radius = std::max(radius, glm::distance(center, wgs84().toEcef(position)));
        return true;
    });
    return std::all_of(planes.begin(), planes.end(),
                       [&](const Plane& plane) { return plane.distance(center) + radius >= 0.0; });
}

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
        const bool reverse = exactKeeps && core::isSeparated(ReverseBin(exact, bin), _hull);
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

double groundAt(const Heights& heights, const Geodetic& position) {
    Tile tile{0, 0, 0, {}};
    for (int level = 0; level <= 10; ++level) {
        const double deg = std::ldexp(kRootTileDeg, -level);
        tile.level = level;
        tile.row = static_cast<int>((position.latitude / kRadiansPerDegree + 90.0) / deg);
        tile.column = static_cast<int>((position.longitude / kRadiansPerDegree + 180.0) / deg);
        tile.heights = level == 0 ? heights.root(tile.row, tile.column)
                                  : heights.child(tile.heights, level, tile.row, tile.column);
    }
    return std::max(0.0, tile.heights.upper);
}

View randomView(Random& random, const Row& row, const Heights& heights) {
    Geodetic position{std::asin(random.uniform(-1.0, 1.0)), random.uniform(-kPi, kPi), 0.0};
    position.altitude = groundAt(heights, position) + random.logUniform(row.lowest, row.highest);
    View view;
    view.eye = wgs84().toEcef(position);
    const double azimuth = random.uniform(-kPi, kPi);
    const double pitch = -random.uniform(row.pitchFrom, row.pitchTo) * kRadiansPerDegree;
    const glm::dvec3 radial(std::cos(position.longitude), std::sin(position.longitude), 0.0);
    const glm::dvec3 z(0.0, 0.0, 1.0);
    const glm::dvec3 east = glm::cross(z, radial);
    const glm::dvec3 north = std::cos(position.latitude) * z - std::sin(position.latitude) * radial;
    const glm::dvec3 up = std::cos(position.latitude) * radial + std::sin(position.latitude) * z;
    const glm::dvec3 level = std::sin(azimuth) * east + std::cos(azimuth) * north;
    view.forward = std::cos(pitch) * level + std::sin(pitch) * up;
    view.right = glm::normalize(glm::cross(level, up));
    view.up = glm::cross(view.right, view.forward);
    view.halfWidth = std::tan(0.5 * row.fovDeg * kRadiansPerDegree);
    return view;
}

Counts runRow(const Options& options, const Heights& heights, std::size_t row) {
    std::vector<Counts> counts(options.threads);
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < options.threads; ++t) {
        threads.emplace_back([&, t] {
            for (int i = static_cast<int>(t); i < options.cameras; i += static_cast<int>(options.threads)) {
                Random random(1000 * static_cast<std::uint64_t>(i) + row);
                const View view = randomView(random, kRows[row], heights);
                counts[t].add(Traversal(view, heights, options.depth).run());
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    Counts total;
    for (const Counts& c : counts) total.add(c);
    return total;
}

double percent(double part, double whole) {
    return whole > 0.0 ? 100.0 * part / whole : 0.0;
}

// Leaves kept beyond the truth, in percent of it. What a method misses is not set against what it keeps in vain.
double excess(const Counts& counts, Method m) {
    const auto inVain = static_cast<double>(counts.kept[m] + counts.missed[m]) - static_cast<double>(counts.truth);
    return percent(inVain, static_cast<double>(counts.truth));
}

bool report(const Row& row, const Counts& counts) {
    std::printf("%-25s %8llu", row.name, static_cast<unsigned long long>(counts.truth));
    for (std::size_t m = 0; m < kMethods; ++m) {
        std::printf(" %+9.2f%s", excess(counts, static_cast<Method>(m)), counts.missed[m] > 0 ? "!" : " ");
    }
    const double found = percent(static_cast<double>(counts.hiddenFound), static_cast<double>(counts.hidden));
    std::printf(" %8llu %7.3f\n", static_cast<unsigned long long>(counts.hidden), found);
    bool good = counts.hidden == 0 || found >= 99.5;
    for (const Method m : {kExactReverseHull, kQuadraticReverseHull}) {
        good = good && excess(counts, m) <= row.bar && counts.missed[m] == 0;
    }
    return good;
}

int usage(int status) {
    std::printf("osganalyticbin_tightness [--cameras N] [--heights FILE.raw] [--depth METRES] [--threads T]\n");
    return status;
}

int run(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string name = argv[i];
        if (name == "--help") return usage(EXIT_SUCCESS);
        if (i + 1 == argc) return usage(EXIT_FAILURE);
        const std::string value = argv[++i];
        if (name == "--cameras") {
            options.cameras = std::max(1, std::atoi(value.c_str()));
        } else if (name == "--threads") {
            options.threads = static_cast<unsigned>(std::clamp(std::atoi(value.c_str()), 1, 1024));
        } else if (name == "--heights") {
            options.heights = value;
        } else if (name == "--depth") {
            options.depth = std::atof(value.c_str());
        } else {
            return usage(EXIT_FAILURE);
        }
    }
    const Heights heights(options.heights);
    std::printf("%d cameras a row, %s heights, occluder %.0f m deep; leaves above truth, percent\n", options.cameras,
                options.heights.empty() ? "made-up" : "real", options.depth);
    std::printf("%-25s %8s", "view", "leaves");
    for (const char* name : kMethodNames) std::printf(" %9s ", name);
    std::printf(" %8s %7s\n", "hidden", "found %");
    bool good = true;
    for (std::size_t row = 0; row < kRows.size(); ++row) {
        good = report(kRows[row], runRow(options, heights, row)) && good;
        std::fflush(stdout);
    }
    std::printf("!: culled a leaf that is seen. The bars are %s.\n", good ? "met" : "MISSED");
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace osgAnalyticBin::test

int main(int argc, char** argv) {
    return osgAnalyticBin::test::run(argc, argv);
}
