// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace osgAnalyticBin::test {

inline constexpr const char* kSeedVariable = "OSGANALYTICBIN_SEED";

/// The seed of this run: the environment variable OSGANALYTICBIN_SEED, or a fixed number.
[[nodiscard]] std::uint64_t seed();

/// A source of random numbers that gives the same sequence on every machine and standard library.
/// Source: [SLF], SplitMix64.
class Random final {
public:
    /// Streams of one seed are independent of each other: a test takes one of its own, a thread too.
    explicit Random(std::uint64_t stream, std::uint64_t seedValue = seed()) noexcept;

    [[nodiscard]] std::uint64_t bits() noexcept;

    /// In [0, 1).
    [[nodiscard]] double uniform() noexcept;
    [[nodiscard]] double uniform(double lower, double upper) noexcept;

    /// Every order of magnitude between the two is equally likely. Requires: 0 < lower <= upper.
    [[nodiscard]] double logUniform(double lower, double upper) noexcept;

    /// Both ends included.
    [[nodiscard]] int integer(int lower, int upper) noexcept;

    [[nodiscard]] bool chance(double probability) noexcept { return uniform() < probability; }
    [[nodiscard]] double sign() noexcept { return chance(0.5) ? 1.0 : -1.0; }

    /// A unit vector, all directions equally likely.
    [[nodiscard]] glm::dvec3 direction() noexcept;

    template <class T, std::size_t N>
    [[nodiscard]] const T& pick(const std::array<T, N>& choices) noexcept {
        return choices[static_cast<std::size_t>(integer(0, static_cast<int>(N) - 1))];
    }

private:
    std::uint64_t _state;
};

}  // namespace osgAnalyticBin::test
