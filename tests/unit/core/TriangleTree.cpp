// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TriangleTree.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace osgAnalyticBin::test {

TriangleTree::TriangleTree(std::vector<Triangle> triangles) : _triangles(std::move(triangles)) {
    if (!_triangles.empty()) divide(0, _triangles.size());
}

void TriangleTree::divide(std::size_t first, std::size_t last) {
    constexpr std::size_t kMost = 4;
    constexpr double kRounding = 1e-12;
    glm::dvec3 least(HUGE_VAL), greatest(-HUGE_VAL);
    for (std::size_t i = first; i < last; ++i) {
        const auto& [a, b, c] = _triangles[i];
        least = glm::min(least, glm::min(a, glm::min(b, c)));
        greatest = glm::max(greatest, glm::max(a, glm::max(b, c)));
    }
    const glm::dvec3 room = kRounding * glm::max(glm::abs(least), glm::abs(greatest));
    const std::size_t number = _boxes.size();
    _boxes.push_back({least - room, greatest + room, first, last, 0});
    if (last - first <= kMost) return;
    const glm::dvec3 size = greatest - least;
    const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
    const auto place = [axis](const Triangle& t) { return t.a[axis] + t.b[axis] + t.c[axis]; };
    const auto at = [this](std::size_t i) { return _triangles.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t middle = (first + last) / 2;
    std::nth_element(at(first), at(middle), at(last),
                     [&](const Triangle& a, const Triangle& b) { return place(a) < place(b); });
    divide(first, middle);
    _boxes[number].second = _boxes.size();
    divide(middle, last);
}

bool TriangleTree::any(const glm::dvec3& from, const glm::dvec3& to,
                       const std::function<bool(const Triangle&)>& meets) const {
    const glm::dvec3 along = to - from;
    // a line in a plane of the box gives NaN, which counts as within
    const auto isMet = [&](const Box& box) {
        constexpr double kRounding = 1e-9;
        double enters = -kRounding, leaves = 1.0 + kRounding;
        for (int axis = 0; axis < 3; ++axis) {
            const double a = (box.least[axis] - from[axis]) / along[axis];
            const double b = (box.greatest[axis] - from[axis]) / along[axis];
            if (std::min(a, b) > enters) enters = std::min(a, b);
            if (std::max(a, b) < leaves) leaves = std::max(a, b);
        }
        return !(enters > leaves + kRounding);
    };
    std::size_t waiting[64], count = 0;
    if (!_boxes.empty()) waiting[count++] = 0;
    while (count > 0) {
        const std::size_t number = waiting[--count];
        const Box& box = _boxes[number];
        if (!isMet(box)) continue;
        if (box.second != 0) {
            waiting[count++] = box.second;
            waiting[count++] = number + 1;
            continue;
        }
        for (std::size_t i = box.first; i < box.last; ++i)
            if (meets(_triangles[i])) return true;
    }
    return false;
}

}  // namespace osgAnalyticBin::test
