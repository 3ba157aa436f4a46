// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "VerdictCheck.h"

#include <tuple>

namespace osgAnalyticBin::paper {

namespace {

// Metres; a verdict is not blamed for rounding.
constexpr double kRounding = 1e-3;

}  // namespace

Counts VerdictCheck::count(std::size_t tile, Verdict verdict) {
    const TreeTile& truth = _tree.tiles[tile];
    Counts counts;
    counts.tested = isTested(verdict) ? 1 : 0;
    counts.kept = isKept(verdict) ? 1 : 0;
    counts.drawn = isKept(verdict) && truth.isLeaf() ? 1 : 0;
    counts.lostLeaves = truth.isLeaf() && truth.witness && !isKept(verdict) ? 1 : 0;
    counts.wrongKeeps = counts.drawn == 1 && truth.isOutside ? 1 : 0;
    counts.wrongInsides = verdict == Verdict::Inside && !isTrulyInside(tile) ? 1 : 0;
    if (verdict == Verdict::Outside && truth.witness && truth.witness->depth > kRounding) {
        counts.wrongCulls = 1;
        counts.holes = noteWrongCull(tile) ? 1 : 0;
    }
    return counts;
}

// Returns: whether terrain is missing in the picture.
bool VerdictCheck::noteWrongCull(std::size_t tile) {
    const auto seen = findTerrainWitness(_terrain, _tree.boxes[tile], _camera);
    const Witness& witness = seen ? *seen : *_tree.tiles[tile].witness;
    WrongCull found;
    found.camera = _camera;
    found.tile = _tree.tiles[tile].id;
    found.box = _tree.boxes[tile];
    found.witness = witness.position;
    found.depth = witness.depth;
    found.isHole = seen.has_value();
    if (!_worst || isWorse(found, *_worst)) _worst = found;
    return found.isHole;
}

bool VerdictCheck::isTrulyInside(std::size_t tile) const noexcept {
    const core::ExactGeodeticBin& bin = std::get<indexOf(Method::Exact)>(_tree.bins)[tile];
    for (const core::Plane& plane : _planes) {
        if (plane.distance(bin.supportPoint(-plane.normal)) < -kRounding) return false;
    }
    return true;
}

bool isWorse(const WrongCull& a, const WrongCull& b) noexcept {
    return std::tie(a.isHole, a.depth) > std::tie(b.isHole, b.depth);
}

}  // namespace osgAnalyticBin::paper
