// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "HeightPyramid.h"
#include "Methods.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace osgAnalyticBin::paper {

/// What a method did, summed over cameras.
struct Counts {
    std::uint64_t tested = 0;
    std::uint64_t kept = 0;          // tiles of all levels that were not culled
    std::uint64_t drawn = 0;         // kept leaves
    std::uint64_t wrongCulls = 0;    // tiles culled although a point of them is in the frustum
    std::uint64_t holes = 0;         // of these, such where terrain that the globe does not hide is missing
    std::uint64_t lostLeaves = 0;    // leaves with a point in the frustum that were not drawn
    std::uint64_t wrongKeeps = 0;    // leaves drawn although proven to be outside
    std::uint64_t wrongInsides = 0;  // tiles found inside although a point of them is outside

    void add(const Counts& other) noexcept;
};

struct CountColumn {
    const char* name;
    std::uint64_t Counts::*count;
};

inline constexpr std::array<CountColumn, 8> kCountColumns{{{"tested", &Counts::tested},
                                                           {"kept", &Counts::kept},
                                                           {"drawn", &Counts::drawn},
                                                           {"wrong_culls", &Counts::wrongCulls},
                                                           {"holes", &Counts::holes},
                                                           {"lost_leaves", &Counts::lostLeaves},
                                                           {"wrong_keeps", &Counts::wrongKeeps},
                                                           {"wrong_insides", &Counts::wrongInsides}}};

/// One number a level.
using LevelCounts = std::array<Counts, HeightPyramid::kDeepest + 1>;

[[nodiscard]] Counts sumOf(const LevelCounts& levels) noexcept;

/// What the cameras of one kind gave.
struct ViewResult {
    std::uint64_t cameras = 0;
    std::array<LevelCounts, kMethods> methods{};
    std::array<std::uint64_t, HeightPyramid::kDeepest + 1> leaves{};      // of the level of detail, all round the globe
    std::array<std::uint64_t, HeightPyramid::kDeepest + 1> seenLeaves{};  // with a point in the frustum
    std::array<double, kMethods> nanoseconds{};                           // for each tile tested

    void add(const ViewResult& other) noexcept;

    [[nodiscard]] std::uint64_t seen() const noexcept;
};

/// A tile that a method culls wrongly, and the proof.
struct WrongCull {
    Camera camera;
    std::size_t kind = 0;
    std::size_t number = 0;
    TileId tile;
    core::GeodeticBin box;
    core::Geodetic witness;
    double depth = 0.0;  // metres from the witness to the nearest side
    bool isHole = false;
};

}  // namespace osgAnalyticBin::paper
