// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Angles.h"
#include "Failure.h"
#include "Figures.h"
#include "TerrainPicture.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace osgAnalyticBin::paper {

using support::Failure;

namespace {

using support::kDegreesPerRadian;

/// Raw pixels for gnuplot, deleted afterwards.
class PixelFile final {
public:
    PixelFile(const std::string& name, const std::vector<std::uint8_t>& pixels) : _name(name) {
        std::ofstream output(_name, std::ios::binary);
        output.write(reinterpret_cast<const char*>(pixels.data()), static_cast<std::streamsize>(pixels.size()));
        output.close();
        if (!output) throw Failure("cannot write \"" + _name + "\"; check that its folder is not full");
    }
    PixelFile(const PixelFile&) = delete;
    PixelFile& operator=(const PixelFile&) = delete;
    ~PixelFile() {
        std::error_code ignored;
        std::filesystem::remove(_name, ignored);
    }

private:
    std::string _name;
};

std::string degreesText(double degrees, const char* positive, const char* negative) {
    return withDecimals(std::abs(degrees), 1) + "° " + (degrees < 0.0 ? negative : positive);
}

}  // namespace

void drawTerrainFigure(const Gnuplot& gnuplot, const FigureScene& scene) {
    constexpr int kMargin = 10;
    constexpr int kTop = 60;
    TerrainPicture picture(scene.camera, Gnuplot::kWidth - 2 * kMargin);
    std::size_t drawn = 0;
    for (std::size_t i = 0; i < scene.tree.tiles.size(); ++i) {
        if (!scene.tree.tiles[i].isLeaf() || !isKept(scene.verdicts[i])) continue;
        picture.add(scene.terrain, scene.tree.tiles[i].id);
        ++drawn;
    }
    const std::string file = gnuplot.file("figure5.pixels.tmp");
    const PixelFile pixels(file, picture.pixels());
    const int height = picture.height() + kTop + kMargin;
    const std::string title = "The terrain of the " + std::to_string(drawn) + " tiles drawn; eye " +
                              degreesText(scene.eye.latitude * kDegreesPerRadian, "N", "S") + ", " +
                              degreesText(scene.eye.longitude * kDegreesPerRadian, "E", "W") + ", " +
                              withDecimals(scene.eye.altitude * 1e-3, 0) + " km high; looking " +
                              withDecimals(scene.azimuthDeg, 0) + "° from north, " + withDecimals(scene.pitchDeg, 0) +
                              "° down; fov " + withDecimals(scene.camera.fovDeg, 0) + "°";
    const auto share = [](double part, double whole) { return withDecimals(part / whole, 6); };
    const std::string size = std::to_string(picture.width()) + "," + std::to_string(picture.height());
    PlotScript script;
    script << "unset key"
           << "unset tics"
           << "unset border"
           << "set lmargin at screen " + share(kMargin, Gnuplot::kWidth)
           << "set rmargin at screen " + share(Gnuplot::kWidth - kMargin, Gnuplot::kWidth)
           << "set bmargin at screen " + share(kMargin, height)
           << "set tmargin at screen " + share(height - kTop, height)
           << "set xrange [-0.5:" + std::to_string(picture.width()) + "-0.5]"
           << "set yrange [-0.5:" + std::to_string(picture.height()) + "-0.5]"
           << "set label " + support::quotedForGnuplot(title) + " at screen 0.5," + share(height - 0.5 * kTop, height) +
                  " center"
           << "plot " + support::quotedForGnuplot(file) + " binary array=(" + size +
                  ") flipy format='%uchar' using 1:2:3 with rgbimage";
    gnuplot.draw("figure5", height, script);
}

}  // namespace osgAnalyticBin::paper
