// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/occlusion/HorizonBuffer.h>

#include <array>
#include <cstddef>
#include <vector>

namespace osgAnalyticBin::core {

/// The earth of a HorizonBuffer, sorted, so that bodies may be asked for in any order: for each strip of the picture,
/// what is covered by the earth up to each distance.
/// Source: doc/theory/occlusion.md, section 8.
class HorizonProfile final {
public:
    /// Takes all earth that was added. Cost: a sort of it.
    explicit HorizonProfile(HorizonBuffer buffer);

    /// See HorizonBuffer.
    [[nodiscard]] HorizonBuffer::Outline outlineOf(const BinBall& ball) const noexcept {
        return _buffer.outlineOf(ball);
    }
    /// See HorizonBuffer.
    [[nodiscard]] bool isAboveLowest(const HorizonBuffer::Outline& body) const noexcept {
        return _buffer.isAboveLowest(body);
    }

    /// Whether all lines of sight from the eye to a body meet earth before the body, as far as they lie in the picture.
    /// Guarantee: true is a proof, rounding included; tests: HorizonProfile.*.
    /// Cost: a search among some ten numbers per strip that the body spans.
    [[nodiscard]] bool hides(const HorizonBuffer::Outline& body) const noexcept;

private:
    // What earth up to a distance covers in a strip.
    struct Step {
        double farthest;
        Interval heights;
    };

    HorizonBuffer _buffer;
    std::vector<Step> _steps;  // strip by strip, by distance
    std::array<std::size_t, HorizonBuffer::kStrips + 1> _first{};
};

}  // namespace osgAnalyticBin::core
