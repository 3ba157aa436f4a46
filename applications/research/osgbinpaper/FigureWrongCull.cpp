// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Angles.h"
#include "BinLines.h"
#include "Figures.h"

#include <osgAnalyticBin/core/bin/GeodeticMapping.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::paper {

namespace {

using support::kPi;
constexpr int kGridParts = 8;

/// What the method takes for the tile.
struct Tested {
    SharePoint surface;  // shares of the box that it tests
    const char* points;
    const char* lines;
};

/// The side that the method culled by, and a direction along it: the plane of the right panel.
struct Profile {
    core::Plane side;
    glm::dvec3 along{0.0};
    glm::dvec3 origin{0.0};

    // Km along the side, and from it.
    [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& ecef) const noexcept {
        return {glm::dot(ecef - origin, along) * 1e-3, side.distance(ecef) * 1e-3, 0.0};
    }
};

core::ParameterBox grown(const core::ParameterBox& box, double growth) {
    return {box.center, growth * box.halfSize};
}

core::Plane cullingSide(const WrongCull& wrong, Method method, const core::Ellipsoid& ellipsoid) {
    const MethodBins bins = methodBins(ellipsoid, {wrong.box});
    core::Plane culling = wrong.camera.planes()[0];
    withBins(bins, method, [&](const auto& own) {
        for (const core::Plane& plane : wrong.camera.planes()) {
            core::PlaneSet one;
            one.push_back(plane);
            core::PlaneMask undecided = one.all();
            if constexpr (!std::is_same_v<std::decay_t<decltype(own.front())>, HullBin>) {
                if (core::classify(own.front(), one, undecided) == core::Side::Outside) culling = plane;
            }
        }
    });
    return culling;
}

// Along the side in which the tile is widest.
Profile profileOf(const core::Plane& side, const Polyline& corners, const glm::dvec3& witness) {
    const glm::dvec3 any = std::abs(side.normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(side.normal, any));
    const glm::dvec3 v = glm::cross(side.normal, u);
    Profile best{side, u, witness};
    double widest = -1.0;
    for (int i = 0; i < 90; ++i) {
        const glm::dvec3 along = std::cos(kPi * i / 90) * u + std::sin(kPi * i / 90) * v;
        double least = HUGE_VAL;
        double most = -HUGE_VAL;
        for (const glm::dvec3& corner : corners) {
            least = std::min(least, glm::dot(corner, along));
            most = std::max(most, glm::dot(corner, along));
        }
        if (most - least <= widest) continue;
        widest = most - least;
        best.along = along;
    }
    return best;
}

// Pyramid of sight, as far as the farthest corner.
std::vector<Polyline> frustumOf(const Camera& camera, const Polyline& corners, const glm::dvec3& witness) {
    double depth = 1.1 * glm::dot(witness - camera.eye, camera.forward);
    for (const glm::dvec3& corner : corners)
        depth = std::max(depth, 0.8 * glm::dot(corner - camera.eye, camera.forward));
    return frustumLines(camera, depth);
}

Tested testedBy(Method method, const core::GeodeticMapping& mapping, const core::GeodeticBin& box) {
    const core::ParameterBox parameters = core::parameterBox(box);
    if (method == Method::Corners) {
        return {
            [&mapping, box](const glm::dvec3& shares) { return mapping.ellipsoid().toEcef(positionIn(box, shares)); },
            "the 8 corners tested", ""};
    }
    const core::QuadraticBin model(mapping, grown(parameters, rivals::PaperBin::kDefaultGrowth));
    return {[model](const glm::dvec3& shares) { return model.modelPoint(2.0 * shares - 1.0); },
            "the 8 corners of its model, all outside", "the model, box x 1.1"};
}

void addPictures(PlotScript& script, const std::string& suffix, const std::vector<Polyline>& tile,
                 const std::vector<Polyline>& edges, const std::vector<Polyline>& model, const Polyline& corners,
                 const glm::dvec3& witness, const std::function<glm::dvec3(const glm::dvec3&)>& map) {
    script.addBlock("$tile" + suffix, mapped(tile, map));
    script.addBlock("$edges" + suffix, mapped(edges, map));
    script.addBlock("$model" + suffix, mapped(model, map));
    script.addBlock("$corners" + suffix, mapped({corners}, map));
    script.addBlock("$witness" + suffix, mapped({{witness}}, map));
}

// What is plotted in both panels, and how.
struct Layer {
    const char* block;
    std::string style;
    const char* title;
};

std::vector<Layer> layersOf(const Tested& tested) {
    const auto lines = [](const char* colour, const char* more) {
        return std::string("with lines lc rgb '") + colour + "' " + more;
    };
    std::vector<Layer> layers{{"$tile", lines(colour::kGrey, "lw 1"), ""},
                              {"$edges", lines(colour::kBlue, "lw 2"), "the tile's bin"}};
    if (*tested.lines != '\0') layers.push_back({"$model", lines(colour::kOrange, "lw 1.5 dt 2"), tested.lines});
    layers.push_back(
        {"$corners", std::string("with points pt 7 ps 1.1 lc rgb '") + colour::kDark + "'", tested.points});
    layers.push_back(
        {"$witness", std::string("with points pt 3 ps 2.2 lw 3 lc rgb '") + colour::kRed + "'", "a point in view"});
    return layers;
}

std::string plotOf(const std::vector<Layer>& layers, const std::string& suffix) {
    std::string plot;
    for (const Layer& layer : layers) plot += (plot.empty() ? "" : ", ") + (layer.block + suffix) + " " + layer.style;
    return plot;
}

}  // namespace

void drawWrongCullFigure(const Gnuplot& gnuplot, const core::Ellipsoid& ellipsoid, Method method,
                         const WrongCull& wrong) {
    const core::GeodeticMapping mapping(ellipsoid);
    const SharePoint point = [&](const glm::dvec3& shares) { return ellipsoid.toEcef(positionIn(wrong.box, shares)); };
    const Tested tested = testedBy(method, mapping, wrong.box);
    const Polyline corners = binCorners(tested.surface);
    const glm::dvec3 witness = ellipsoid.toEcef(wrong.witness);
    const Profile profile = profileOf(cullingSide(wrong, method, ellipsoid), corners, witness);
    const LocalFrame frame(ellipsoid, wrong.box.center());
    const auto local = [&](const glm::dvec3& ecef) { return frame.toLocalKm(ecef); };
    const auto tile = binGrid(point, kGridParts);
    const auto edges = binEdges(point);
    const auto model = binEdges(tested.surface);

    const std::vector<Layer> layers = layersOf(tested);
    const std::string frustumStyle = std::string("with lines lw 2 lc rgb '") + colour::kGreen + "'";
    const std::string eyeStyle = "with points pt 7 ps 1 lc rgb 'black'";
    PlotScript script;
    addPictures(script, "3", tile, edges, model, corners, witness, local);
    addPictures(script, "2", tile, edges, model, corners, witness, profile);
    script.addBlock("$frustum", mapped(frustumOf(wrong.camera, corners, witness), local));
    script.addBlock("$eye", {{local(wrong.camera.eye)}});
    const double sizeDeg = std::ldexp(22.5, -wrong.tile.level);
    script << "set multiplot title " +
                  support::quotedForGnuplot(
                      std::string("A visible tile culled by ") +
                      (method == Method::Corners ? "the test of eight corners" : "the nine-point rule") + ": " +
                      withDecimals(sizeDeg, 2) + "° wide, " + withDecimals(wrong.depth * 1e-3, 1) +
                      " km inside the frustum (" + kViewKinds[wrong.kind].name + ", camera " +
                      std::to_string(wrong.number) + ")")
           << R"(unset key
set xyplane relative 0
set view equal xyz
set view 58,30,1.3
set origin 0.04,0.14
set size 0.46,0.78
set xlabel 'east (km)' offset 0,-0.5
set ylabel 'north (km)' offset 1,-0.5
set zlabel 'up (km)' rotate offset 1,0
set xtics autofreq
set tics 1000)"
           << "splot $frustum " + frustumStyle + ", $eye " + eyeStyle + ", " + plotOf(layers, "3");
    script << R"(set origin 0,0
set size 1,1
set lmargin at screen 0.62
set rmargin at screen 0.97
set bmargin at screen 0.22
set tmargin at screen 0.92
set xlabel 'along the side of the frustum (km)' offset 0,0
set ylabel 'distance to the side (km), > 0 inside' offset 0,0 rotate
set grid
set ytics autofreq
set object 1 rectangle from graph 0, first 0 to graph 1, graph 1 behind fs solid 0.12 noborder
set arrow 1 from graph 0, first 0 to graph 1, first 0 nohead lw 2
set label 1 'inside the side' at graph 0.02, graph 0.96)"
           << std::string("set object 1 fc rgb '") + colour::kGreen + "'"
           << std::string("set arrow 1 lc rgb '") + colour::kGreen + "'"
           << std::string("set label 1 textcolor rgb '") + colour::kGreen + "'"
           << "plot " + plotOf(layers, "2");
    std::vector<std::string> key{frustumStyle + " title 'frustum'", eyeStyle + " title 'eye'"};
    for (const Layer& layer : layers) {
        if (*layer.title != '\0') key.push_back(layer.style + " title " + support::quotedForGnuplot(layer.title));
    }
    script.addKey(0.11, key);
    gnuplot.draw(std::string("wrong_cull_") + kMethodNames[indexOf(method)], 600, script);
}

}  // namespace osgAnalyticBin::paper
