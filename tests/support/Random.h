// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace osgAnalyticBin::test {

inline constexpr const char* kSeedVariable = "OSGANALYTICBIN_SEED";

/// The seed of this run: the environment variable OSGANALYTICBIN_SEED, or a fixed number.
[[nodiscard]] inline std::uint64_t seed() {
    static const std::uint64_t value = [] {
        const char* text = std::getenv(kSeedVariable);
        return text != nullptr ? std::strtoull(text, nullptr, 0) : std::uint64_t{20260101};
    }();
    return value;
}

/// A source of random numbers that gives the same sequence on every machine and standard library.
/// Source: [SLF], SplitMix64.
class Random final {
public:
    /// Streams of one seed are independent of each other: a test takes one of its own, a thread too.
    explicit Random(std::uint64_t stream, std::uint64_t seedValue = seed()) noexcept : _state(seedValue) {
        _state = bits() ^ (stream * 0xD1342543DE82EF95u);
        _state = bits();
    }

    [[nodiscard]] std::uint64_t bits() noexcept {
        _state += 0x9E3779B97F4A7C15u;
        std::uint64_t z = _state;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }

    /// In [0, 1).
    [[nodiscard]] double uniform() noexcept { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    [[nodiscard]] double uniform(double lower, double upper) noexcept { return lower + (upper - lower) * uniform(); }

    /// Every order of magnitude between the two is equally likely. Requires: 0 < lower <= upper.
    [[nodiscard]] double logUniform(double lower, double upper) noexcept {
        return lower * std::exp(uniform() * std::log(upper / lower));
    }

    /// Both ends included.
    [[nodiscard]] int integer(int lower, int upper) noexcept {
        return lower + static_cast<int>(uniform() * (static_cast<double>(upper) - lower + 1.0));
    }

    [[nodiscard]] bool chance(double probability) noexcept { return uniform() < probability; }
    [[nodiscard]] double sign() noexcept { return chance(0.5) ? 1.0 : -1.0; }

    /// A unit vector, all directions equally likely.
    [[nodiscard]] glm::dvec3 direction() noexcept {
        const double z = uniform(-1.0, 1.0);
        const double angle = uniform(0.0, 6.28318530717958647692);
        const double rho = std::sqrt(1.0 - z * z);
        return {rho * std::cos(angle), rho * std::sin(angle), z};
    }

    template <class T, std::size_t N>
    [[nodiscard]] const T& pick(const std::array<T, N>& choices) noexcept {
        return choices[static_cast<std::size_t>(integer(0, static_cast<int>(N) - 1))];
    }

private:
    std::uint64_t _state;
};

}  // namespace osgAnalyticBin::test
