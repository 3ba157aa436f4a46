// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Angles.h"
#include "Experiment.h"
#include "TextFile.h"

#include <osgAnalyticBin/core/bin/GeodeticMapping.h>

#include <glm/geometric.hpp>

#include <Relief.h>
#include <TerrainGrid.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

namespace osgAnalyticBin::paper {

namespace {

using report::Diagram;
using namespace support;
using Polyline = std::vector<glm::dvec3>;
using Polylines = std::vector<Polyline>;
/// Where a point is drawn: of its shares of a bin, from 0 to 1, or in ECEF.
using PointMap = std::function<glm::dvec3(const glm::dvec3&)>;

/// The data of a figure in named blocks, and what its commands are told beside.
class Figure final {
public:
    explicit Figure(std::string name) : _name(std::move(name)) { _data.precision(9); }

    void add(const char* block, const Polylines& lines) {
        begin(block);
        for (const Polyline& line : lines) {
            for (const glm::dvec3& p : line) _data << p.x << ',' << p.y << ',' << p.z << '\n';
            _data << "NaN,NaN,NaN\n";
        }
    }
    void begin(const char* block) { _data << "\n\n# " << block << '\n'; }
    [[nodiscard]] std::ostream& data() { return _data; }
    void set(const char* variable, double value) { _variables += variable + (" = " + withDecimals(value, 6) + "\n"); }
    void set(const char* variable, const std::string& text) {
        _variables += variable + std::string(" = '") + text + "'\n";
    }

    /// `commands`: the name of the file in the folder figures.
    [[nodiscard]] Diagram drawn(const char* commands, int height) const {
        const std::string load = "load '" FIGURE_FOLDER "/style.gp'\nload '" FIGURE_FOLDER "/" + std::string(commands);
        return {_name, _data.str(),
                _variables + report::drawnTwice(_name, "size 1000," + std::to_string(height) + " font 'DejaVu Sans,12'",
                                                load + ".gp'\n")};
    }

private:
    std::string _name, _variables;
    std::ostringstream _data;
};

// ---- Lines of bins and cameras.

Polyline straight(const PointMap& map, const glm::dvec3& from, const glm::dvec3& to) {
    constexpr int kSteps = 32;
    Polyline line;
    for (int i = 0; i <= kSteps; ++i) line.push_back(map(from + (to - from) * (static_cast<double>(i) / kSteps)));
    return line;
}

// Lines across top and bottom, so many parts each way.
Polylines gridOf(const PointMap& map, int parts) {
    Polylines lines;
    for (const double z : {0.0, 1.0}) {
        for (int i = 0; i <= parts; ++i) {
            const double share = static_cast<double>(i) / parts;
            lines.push_back(straight(map, {share, 0.0, z}, {share, 1.0, z}));
            lines.push_back(straight(map, {0.0, share, z}, {1.0, share, z}));
        }
    }
    return lines;
}

Polyline cornersOf(const PointMap& map) {
    Polyline corners;
    for (int i = 0; i < 8; ++i) corners.push_back(map({i & 1 ? 1.0 : 0.0, i & 2 ? 1.0 : 0.0, i & 4 ? 1.0 : 0.0}));
    return corners;
}

Polylines edgesOf(const PointMap& map) {
    Polylines lines = gridOf(map, 1);
    for (const double x : {0.0, 1.0})
        for (const double y : {0.0, 1.0}) lines.push_back(straight(map, {x, y, 0.0}, {x, y, 1.0}));
    return lines;
}

// The pyramid of sight, to a depth in metres.
Polylines frustumOf(const Camera& camera, double depth) {
    Polylines lines;
    Polyline end;
    for (const glm::dvec3& edge : camera.edges()) {
        lines.push_back({camera.eye, camera.eye + depth * edge});
        end.push_back(camera.eye + depth * edge);
    }
    end.push_back(end.front());
    lines.push_back(end);
    return lines;
}

Polylines mapped(Polylines lines, const PointMap& map) {
    for (Polyline& line : lines) std::transform(line.begin(), line.end(), line.begin(), map);
    return lines;
}

// East, north and up in km.
PointMap localKm(const core::Ellipsoid& ellipsoid, const core::Geodetic& origin) {
    const CameraAxes north = cameraAxes(origin, 0.0, 0.0);
    return [north, from = ellipsoid.toEcef(origin)](const glm::dvec3& ecef) {
        const glm::dvec3 offset = (ecef - from) * 1e-3;
        return glm::dvec3(glm::dot(offset, north.right), glm::dot(offset, north.forward), glm::dot(offset, north.up));
    };
}

PointMap ecefOf(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin) {
    return [ellipsoid, bin](const glm::dvec3& shares) { return ellipsoid.toEcef(positionIn(bin, shares)); };
}

core::Interval rangeOf(const Polyline& points, const std::function<double(const glm::dvec3&)>& value) {
    core::Interval range = core::Interval::none();
    for (const glm::dvec3& point : points) range.expandBy(value(point));
    return range;
}

/// Over the Ligurian Sea, with the Alps before it: one camera, and what the quadratic bins made of its tiles.
struct Scene {
    explicit Scene(Terrain& seen)
        : terrain(seen),
          camera(cameraAt(seen.ellipsoid(), eye, 10.0, 28.0, 50.0)),
          tree(seen, camera),
          verdicts(cull(tree, Frustum(camera), Method::Quadratic)) {}

    Terrain& terrain;
    core::Geodetic eye{42.6 * kRadiansPerDegree, 8.2 * kRadiansPerDegree, 1.6e5};
    Camera camera;
    TileTree tree;
    std::vector<Verdict> verdicts;
};

Diagram binFigure(const Scene& scene) {
    constexpr double kExaggeration = 100.0;  // to scale, the highest terrain is as thin as the line
    const auto highest = std::max_element(
        scene.tree.tiles.begin(), scene.tree.tiles.begin() + TileTree::kStartTiles,
        [](const TreeTile& a, const TreeTile& b) { return a.box.altitude().upper < b.box.altitude().upper; });
    const core::GeodeticBin& bin = highest->box;
    const PointMap inAngles = [&](const glm::dvec3& shares) {
        const core::Geodetic p = positionIn(bin, shares);
        return glm::dvec3(p.longitude * kDegreesPerRadian, p.latitude * kDegreesPerRadian, p.altitude * 1e-3);
    };
    const PointMap inSpace = [&](const glm::dvec3& shares) {
        const core::Geodetic p = positionIn(bin, shares);
        return scene.terrain.ellipsoid().toEcef({p.latitude, p.longitude, kExaggeration * p.altitude}) * 1e-6;
    };
    Figure figure("figure1");
    figure.add("boxGrid", gridOf(inAngles, 6));
    figure.add("boxEdges", edgesOf(inAngles));
    figure.add("center", {{inAngles(glm::dvec3(0.5))}});
    figure.add("slabGrid", gridOf(inSpace, 6));
    figure.add("slabEdges", edgesOf(inSpace));
    figure.add("slabCenter", {{inSpace(glm::dvec3(0.5))}});
    figure.set("lowest", bin.altitude().lower * 1e-3 - 0.01);
    figure.set("highest", 1.1e-3 * bin.altitude().upper);
    figure.set("turn", std::fmod(bin.longitude().middle() * kDegreesPerRadian + 775.0, 360.0));
    return figure.drawn("figure1", 520);
}

// The tile that looks largest of those that cross one side and are well in view.
const TreeTile& straddlingTile(const Scene& scene) {
    const double radius = scene.terrain.ellipsoid().equatorialRadius();
    const TreeTile* best = &scene.tree.tiles.front();
    double largest = 0.0;
    for (const TreeTile& tile : scene.tree.tiles) {
        const auto planes = scene.camera.planes();
        const auto crossed = std::count_if(planes.begin(), planes.end(), [&](const core::Plane& plane) {
            return tile.bins.classify(Method::Exact, plane) == core::Side::Straddling;
        });
        const double distance = glm::distance(scene.terrain.ellipsoid().toEcef(tile.box.center()), scene.camera.eye);
        const double width = tile.box.latitude().width() * radius;
        // Behind the globe nobody looks.
        const bool isWellInView = tile.witness && tile.witness->depth >= 0.3 * width && distance <= 1.2e6;
        if (crossed != 1 || !isWellInView || width / distance <= largest) continue;
        largest = width / distance;
        best = &tile;
    }
    return *best;
}

// The parts of lines that are inside all planes, or those that are not.
Polylines partsOf(const Polylines& lines, const std::array<core::Plane, 4>& planes, bool isInside) {
    Polylines parts;
    for (const Polyline& line : lines) {
        parts.emplace_back();
        for (const glm::dvec3& point : line) {
            const bool isIn = std::all_of(planes.begin(), planes.end(),
                                          [&](const core::Plane& plane) { return plane.distance(point) >= 0.0; });
            if (isIn == isInside || !parts.back().empty()) parts.back().push_back(point);
            if (isIn != isInside && !parts.back().empty()) parts.emplace_back();
        }
    }
    return parts;
}

Diagram frustumFigure(const Scene& scene) {
    const TreeTile& tile = straddlingTile(scene);
    const core::Ellipsoid& ellipsoid = scene.terrain.ellipsoid();
    const PointMap local = localKm(ellipsoid, {scene.eye.latitude, scene.eye.longitude, 0.0});
    const Polylines lines = gridOf(ecefOf(ellipsoid, tile.box), 8);
    const Polyline corners = cornersOf(ecefOf(ellipsoid, tile.box));
    const double depth = 1.25 * glm::dot(ellipsoid.toEcef(tile.box.center()) - scene.camera.eye, scene.camera.forward);
    const auto planes = scene.camera.planes();
    Figure figure("figure2");
    figure.add("inside", mapped(partsOf(lines, planes, true), local));
    figure.add("outside", mapped(partsOf(lines, planes, false), local));
    figure.add("frustum", mapped(frustumOf(scene.camera, depth), local));
    figure.add("eye", {{local(scene.camera.eye)}});
    // place, then lowest and highest distance in km by the bin and by its eight corners
    figure.begin("ranges");
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const core::Interval bin =
            std::visit([&](const auto& form) { return form.distanceRange(planes[i]); }, tile.bins.quadratic);
        const core::Interval eight = rangeOf(corners, [&](const glm::dvec3& p) { return planes[i].distance(p); });
        figure.data() << 4 - i << ',' << bin.lower * 1e-3 << ',' << bin.upper * 1e-3 << ',' << eight.lower * 1e-3 << ','
                      << eight.upper * 1e-3 << '\n';
    }
    return figure.drawn("figure2", 560);
}

Diagram startTilesFigure(const Scene& scene) {
    constexpr double kStepDeg = 0.5;
    Figure figure("figure3");
    figure.begin("tiles");
    for (std::size_t i = 0; i < TileTree::kStartTiles; ++i) {
        const TreeTile& tile = scene.tree.tiles[i];
        const core::Geodetic middle = tile.box.center();
        figure.data() << middle.longitude * kDegreesPerRadian << ',' << middle.latitude * kDegreesPerRadian << ','
                      << std::lround(tile.box.altitude().lower) << ',' << std::lround(tile.box.altitude().upper)
                      << '\n';
    }
    figure.begin("heights");
    for (double latitude = -89.75; latitude < 90.0; latitude += kStepDeg) {
        for (double longitude = -179.75; longitude < 180.0; longitude += kStepDeg)
            figure.data() << longitude << ',' << latitude << ','
                          << std::lround(scene.terrain.height({latitude, longitude})) << '\n';
    }
    return figure.drawn("figure3", 510);
}

// The border of the picture where it is on the globe, longitudes and latitudes.
Polylines footprintOf(const Scene& scene) {
    constexpr int kSteps = 200;
    const core::Ellipsoid& ellipsoid = scene.terrain.ellipsoid();
    const glm::dvec3 radii(ellipsoid.equatorialRadius(), ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    const glm::dvec3 o = scene.camera.eye / radii;
    const auto edges = scene.camera.edges();
    Polylines lines(1);
    for (int i = 0; i <= 4 * kSteps; ++i) {
        const auto side = static_cast<std::size_t>(i / kSteps) % 4;
        const double share = static_cast<double>(i % kSteps) / kSteps;
        const glm::dvec3 ray = edges[side] + share * (edges[(side + 1) % 4] - edges[side]);
        const glm::dvec3 d = ray / radii;
        const double b = glm::dot(o, d);
        const double discriminant = b * b - glm::dot(d, d) * (glm::dot(o, o) - 1.0);
        const double t = discriminant < 0.0 ? -1.0 : (-b - std::sqrt(discriminant)) / glm::dot(d, d);
        if (t > 0.0) {
            const core::Geodetic p = ellipsoid.toGeodetic(scene.camera.eye + t * ray);
            lines.back().emplace_back(p.longitude * kDegreesPerRadian, p.latitude * kDegreesPerRadian, 0.0);
        } else if (!lines.back().empty()) {
            lines.emplace_back();
        }
    }
    return lines;
}

Diagram recursionFigure(const Scene& scene) {
    Figure figure("figure4");
    // Tiles that the recursion ended at, by verdict.
    for (const auto& [verdict, block] : {std::pair(Verdict::Outside, "outside"),
                                         {Verdict::Straddling, "straddling"},
                                         {Verdict::Inside, "inside"},
                                         {Verdict::WithinInside, "within"}}) {
        figure.begin(block);
        for (std::size_t i = 0; i < scene.verdicts.size(); ++i) {
            const TreeTile& tile = scene.tree.tiles[i];
            if (scene.verdicts[i] != verdict || (verdict == Verdict::Straddling && !tile.isLeaf())) continue;
            const osgbindem::RectDeg rect = tile.id.rect();
            figure.data() << rect.west << ',' << rect.south << ',' << rect.east << ',' << rect.north << '\n';
        }
    }
    figure.add("footprint", footprintOf(scene));
    figure.set("east", scene.eye.longitude * kDegreesPerRadian);
    figure.set("north", scene.eye.latitude * kDegreesPerRadian);
    return figure.drawn("figure4", 560);
}

/// Terrain as the camera sees it: coloured by height, shaded by a low sun in the north-west.
class TerrainView {
public:
    TerrainView(Terrain& terrain, const Camera& camera) : _terrain(terrain), _camera(camera) {}

    // A grid of the tile, with minus the depth and a colour for each point.
    void add(std::ostream& data, const TileId& tile) {
        const osgbindem::RectDeg rect = tile.rect();
        _stepDeg = (rect.north - rect.south) / kCells;
        Polyline outline;
        for (int row = 0; row <= kCells; ++row) {
            for (int column = 0; column <= kCells; ++column) {
                const osgbindem::PositionDeg at{rect.south + row * _stepDeg, rect.west + column * _stepDeg};
                const glm::dvec3 point = inPicture(at);
                data << point.x << ',' << point.y << ',' << point.z << ',' << colourAt(at) << '\n';
                if (column == 0) outline.push_back(point);
                if (row == 0) outline.insert(outline.begin(), point);
            }
            data << '\n';
        }
        _outlines.push_back(std::move(outline));
    }

    // Of the west and the south of each tile.
    [[nodiscard]] const Polylines& outlines() const { return _outlines; }

private:
    static constexpr int kCells = 24;

    // x and y from -1 to 1 at the upper and lower edge. Returns: NaN where the globe turns away, or nothing is in
    // front.
    [[nodiscard]] glm::dvec3 inPicture(const osgbindem::PositionDeg& at) {
        const core::Geodetic position{at.latitudeDeg * kRadiansPerDegree, at.longitudeDeg * kRadiansPerDegree,
                                      _terrain.height(at)};
        const glm::dvec3 offset = _terrain.ellipsoid().toEcef(position) - _camera.eye;
        const double depth = glm::dot(offset, _camera.forward);
        const bool isTurnedAway =
            glm::dot(offset, _terrain.ellipsoid().up(position.latitude, position.longitude)) > 0.0;
        if (isTurnedAway || !(depth > 0.0)) return glm::dvec3(std::nan(""));
        const double scale = 1.0 / (_camera.tangent() * depth);
        return {scale * glm::dot(offset, _camera.right), scale * glm::dot(offset, _camera.up), -depth};
    }

    [[nodiscard]] long colourAt(const osgbindem::PositionDeg& at) {
        constexpr double kSteeper = 6.0;    // from far away slopes are faint
        constexpr double kWater = -1000.0;  // a height with the colour of water
        const auto height = [&](double northDeg, double eastDeg) {
            return _terrain.height({std::clamp(at.latitudeDeg + northDeg, -90.0, 90.0), at.longitudeDeg + eastDeg});
        };
        const double half = 0.5 * _stepDeg;
        const double metres = _stepDeg * kRadiansPerDegree * _terrain.ellipsoid().equatorialRadius() / kSteeper;
        const double cosine = std::max(0.01, std::cos(at.latitudeDeg * kRadiansPerDegree));
        const glm::dvec3 normal =
            glm::normalize(glm::dvec3((height(0.0, -half) - height(0.0, half)) / (metres * cosine),
                                      (height(-half, 0.0) - height(half, 0.0)) / metres, 1.0));
        const double light = 0.35 + 0.8 * std::max(0.0, glm::dot(normal, glm::normalize(glm::dvec3(-1.0, 1.0, 1.4))));
        const double here = height(0.0, 0.0);
        long rgb = 0;
        const osg::Vec4ub colour = osgAnalyticBin::colourAt(hypsometricStops(), here == 0.0 ? kWater : here);
        for (const auto channel : {colour.r(), colour.g(), colour.b()})
            rgb = rgb * 256 + std::lround(std::clamp(light * channel, 0.0, 255.0));
        return rgb;
    }

    Terrain& _terrain;
    Camera _camera;
    double _stepDeg = 0.0;
    Polylines _outlines;
};

Diagram terrainFigure(const Scene& scene) {
    Figure figure("figure5");
    TerrainView view(scene.terrain, scene.camera);
    for (std::size_t i = 0; i < scene.verdicts.size(); ++i) {
        if (!scene.tree.tiles[i].isLeaf() || !isKept(scene.verdicts[i])) continue;
        figure.begin("tile");
        view.add(figure.data(), scene.tree.tiles[i].id);
    }
    figure.add("outlines", view.outlines());
    figure.set("aspect", Camera::kAspect);
    figure.set("tiles", static_cast<double>(view.outlines().size()));
    figure.set("heading", "The terrain of the " + std::to_string(view.outlines().size()) +
                              " tiles drawn; eye 42.6° N, 8.2° E, 160 km high; looking 10° from north, 28° down; fov "
                              "50°");
    return figure.drawn("figure5", 800);
}

// Along a side of the frustum in the direction in which the points reach farthest, and the distance from it; km.
PointMap profileOf(const core::Plane& side, const Polyline& points, const glm::dvec3& origin) {
    const glm::dvec3 any = std::abs(side.normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(side.normal, any));
    const glm::dvec3 v = glm::cross(side.normal, u);
    glm::dvec3 along = u;
    double widest = -1.0;
    for (int i = 0; i < 90; ++i) {
        const glm::dvec3 direction = std::cos(kPi * i / 90) * u + std::sin(kPi * i / 90) * v;
        const double width = rangeOf(points, [&](const glm::dvec3& p) { return glm::dot(p, direction); }).width();
        if (width > widest) along = direction;
        widest = std::max(widest, width);
    }
    return [=](const glm::dvec3& ecef) {
        return glm::dvec3(glm::dot(ecef - origin, along) * 1e-3, side.distance(ecef) * 1e-3, 0.0);
    };
}

Diagram wrongCullFigure(const core::Ellipsoid& ellipsoid, Method method, const WrongCull& wrong) {
    const TileBins bins(ellipsoid, wrong.box);
    const auto planes = wrong.camera.planes();
    const core::Plane side = *std::find_if(planes.begin(), planes.end(), [&](const core::Plane& plane) {
        return bins.classify(method, plane) == core::Side::Outside;
    });
    // What the method takes for the tile: the bin itself, or the model over the grown box.
    core::ParameterBox grown = core::parameterBox(wrong.box);
    grown.halfSize *= rivals::PaperBin::kDefaultGrowth;
    const core::QuadraticBin model(core::GeodeticMapping(ellipsoid), grown);
    const PointMap surface = ecefOf(ellipsoid, wrong.box);
    const PointMap tested = method == Method::Paper
                                ? [model](const glm::dvec3& shares) { return model.modelPoint(2.0 * shares - 1.0); }
                                : surface;
    const Polyline corners = cornersOf(tested);
    const glm::dvec3 witness = ellipsoid.toEcef(wrong.witness.position);
    const glm::dvec3 eye = wrong.camera.eye;
    double depth = 1.1 * glm::dot(witness - eye, wrong.camera.forward);
    for (const glm::dvec3& corner : corners)
        depth = std::max(depth, 0.8 * glm::dot(corner - eye, wrong.camera.forward));
    const PointMap local = localKm(ellipsoid, wrong.box.center());
    Figure figure(std::string("wrong_cull_") + kMethodNames[indexOf(method)]);
    for (const auto& [suffix, map] :
         {std::pair<std::string, PointMap>("3", local), {"2", profileOf(side, corners, witness)}}) {
        figure.add(("tile" + suffix).c_str(), mapped(gridOf(surface, 8), map));
        figure.add(("edges" + suffix).c_str(), mapped(edgesOf(surface), map));
        figure.add(("model" + suffix).c_str(), mapped(edgesOf(tested), map));
        figure.add(("corners" + suffix).c_str(), mapped({corners}, map));
        figure.add(("witness" + suffix).c_str(), {{map(witness)}});
    }
    figure.add("frustum", mapped(frustumOf(wrong.camera, depth), local));
    figure.add("eye", {{local(eye)}});
    figure.set("isPaper", method == Method::Paper ? 1.0 : 0.0);
    figure.set("heading", std::string("A visible tile culled by ") +
                              (method == Method::Paper ? "the nine-point rule" : "the test of eight corners") + ": " +
                              withDecimals(std::ldexp(22.5, -wrong.tile.level), 2) + "° wide, " +
                              withDecimals(wrong.witness.depth * 1e-3, 1) + " km inside the frustum (" +
                              kViewKinds[wrong.kind].name + ", camera " + std::to_string(wrong.number) + ")");
    return figure.drawn("wrong_cull", 600);
}

}  // namespace

std::vector<Diagram> figuresOf(Terrain& terrain, const Results& results) {
    const Scene scene(terrain);
    std::vector<Diagram> figures{binFigure(scene), frustumFigure(scene), startTilesFigure(scene),
                                 recursionFigure(scene), terrainFigure(scene)};
    for (const Method method : {Method::Corners, Method::Paper})
        if (const auto& worst = results.worst[indexOf(method)])
            figures.push_back(wrongCullFigure(terrain.ellipsoid(), method, *worst));
    return figures;
}

}  // namespace osgAnalyticBin::paper
