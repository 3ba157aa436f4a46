// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Camera.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace osgAnalyticBin::paper {

/// A picture of tiles of terrain as a camera sees it: coloured by height, shaded by a low sun in the north-west of each
/// tile, with a line where two tiles meet. Drawn in software, so that it needs no display.
class TerrainPicture final {
public:
    /// Pixels; the camera's aspect gives the height.
    TerrainPicture(const Camera& camera, int width);

    /// Adds the tile's terrain, to scale. Cost: some 1000 triangles.
    void add(Terrain& terrain, const TileId& tile);

    [[nodiscard]] int width() const noexcept { return _width / kFiner; }
    [[nodiscard]] int height() const noexcept { return _height / kFiner; }

    /// Red, green, blue for each pixel, rows from the top.
    [[nodiscard]] std::vector<std::uint8_t> pixels() const;

private:
    static constexpr int kFiner = 2;  // samples along the edge of a pixel

    struct Vertex {
        glm::dvec3 view;  // right, up, forward in metres
        glm::dvec3 colour;
    };

    [[nodiscard]] Vertex vertex(Terrain& terrain, const osgbindem::PositionDeg& position, double stepDeg) const;
    void draw(const Vertex& a, const Vertex& b, const Vertex& c);
    [[nodiscard]] glm::dvec3 onScreen(const glm::dvec3& view) const noexcept;
    [[nodiscard]] bool isBorder(int column, int row) const noexcept;
    [[nodiscard]] std::size_t index(int column, int row) const noexcept {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(_width) + static_cast<std::size_t>(column);
    }

    Camera _camera;
    int _width;
    int _height;
    std::vector<double> _inverseDepths;
    std::vector<glm::vec3> _colours;
    std::vector<std::uint32_t> _owners;  // number of the tile; 0 for the sky
    std::uint32_t _tiles = 0;
};

}  // namespace osgAnalyticBin::paper
