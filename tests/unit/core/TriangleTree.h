// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Finds out quickly which triangles a line may meet.

#pragma once

#include <core/TriangleSamples.h>
#include <cstddef>
#include <functional>
#include <vector>

namespace osgAnalyticBin::test {

/// Triangles, sorted into boxes within boxes.
class TriangleTree {
public:
    TriangleTree() = default;
    explicit TriangleTree(std::vector<Triangle> triangles);

    [[nodiscard]] const std::vector<Triangle>& triangles() const { return _triangles; }

    /// Whether `meets` holds for a triangle, of those whose boxes the segment meets, roundings included.
    [[nodiscard]] bool any(const glm::dvec3& from, const glm::dvec3& to,
                           const std::function<bool(const Triangle&)>& meets) const;

private:
    struct Box {
        glm::dvec3 least, greatest;
        std::size_t first, last;  // triangles
        std::size_t second;       // the second of the boxes in it, the first one follows it; 0: none
    };
    void divide(std::size_t first, std::size_t last);

    std::vector<Triangle> _triangles;
    std::vector<Box> _boxes;
};

}  // namespace osgAnalyticBin::test
