// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileTree.h"

#include <array>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

namespace osgAnalyticBin::paper {

/// What a method did, summed over cameras.
struct Counts {
    std::uint64_t tested = 0;
    std::uint64_t drawn = 0;         // leaves that were not culled
    std::uint64_t wrongCulls = 0;    // tiles culled although a point of them is in the frustum
    std::uint64_t holes = 0;         // of these, such where terrain that the globe does not hide is missing
    std::uint64_t lostLeaves = 0;    // leaves with a point in the frustum that were not drawn
    std::uint64_t wrongKeeps = 0;    // leaves drawn although proven to be outside
    std::uint64_t wrongInsides = 0;  // tiles found inside although a point of them is outside

    void add(const Counts& other) noexcept;
};

/// What the cameras of one kind gave.
struct ViewResult {
    std::uint64_t cameras = 0;
    std::uint64_t seenLeaves = 0;  // with a point in the frustum
    std::array<Counts, kMethods> methods{};

    void add(const ViewResult& other) noexcept;
};

/// A tile that a method culls wrongly, and the proof.
struct WrongCull {
    Camera camera;
    core::GeodeticBin box;
    Witness witness;
    bool isHole = false;
};

/// The experiment of [JJ]: every method culls the same trees from the same cameras.
struct Results {
    std::array<ViewResult, kViewKinds.size()> views{};
    /// For each method the wrong cull with the deepest witness; holes in the picture before others.
    std::array<std::optional<WrongCull>, kMethods> worst;

    /// All kinds of view together.
    [[nodiscard]] ViewResult sum() const noexcept;
};

/// `cameras`: of each kind. `progress` is told the share that is done.
[[nodiscard]] Results runExperiment(Terrain& terrain, std::size_t cameras,
                                    const std::function<void(double)>& progress = {});

/// A line for each kind of view and method, after a line of column names; the same in every run.
[[nodiscard]] std::string csvOf(const Results& results);
/// The same for people, the sums over all views, and how far inside the frustum the worst wrong culls are.
void printTables(std::ostream& output, const Results& results);

/// The columns, for the help: one a line.
[[nodiscard]] std::string meaningOfColumns();

}  // namespace osgAnalyticBin::paper
