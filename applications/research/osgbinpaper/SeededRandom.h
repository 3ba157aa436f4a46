// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cmath>
#include <cstdint>

namespace osgAnalyticBin::paper {

/// A source of random numbers that gives the same sequence on every machine. Streams of one seed are independent.
/// Source: [SLF], SplitMix64.
class SeededRandom final {
public:
    SeededRandom(std::uint64_t seed, std::uint64_t stream) noexcept : _state(seed) {
        _state = bits() ^ (stream * 0xD1342543DE82EF95u);
    }

    /// In [lower, upper).
    [[nodiscard]] double uniform(double lower, double upper) noexcept {
        return lower + (upper - lower) * static_cast<double>(bits() >> 11) * 0x1p-53;
    }

    /// Every order of magnitude between the two is equally likely. Requires: 0 < lower <= upper.
    [[nodiscard]] double logUniform(double lower, double upper) noexcept {
        return lower * std::exp(uniform(0.0, 1.0) * std::log(upper / lower));
    }

private:
    [[nodiscard]] std::uint64_t bits() noexcept {
        _state += 0x9E3779B97F4A7C15u;
        std::uint64_t z = _state;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }

    std::uint64_t _state;
};

}  // namespace osgAnalyticBin::paper
