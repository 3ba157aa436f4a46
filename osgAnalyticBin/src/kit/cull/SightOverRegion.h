// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/bin/BinFamily.h>
#include <osgAnalyticBin/core/horizon/RegionalSight.h>

#include <cstdint>
#include <optional>

namespace osgAnalyticBin {

/// The lines of sight of an eye over a region. Finding them takes microseconds, so they are looked for only when
/// something would be hidden; in many views of a region nothing is.
class SightOverRegion final {
public:
    /// All have to outlive it.
    SightOverRegion(const core::HorizonEye& eye, const core::CoveredRegion& region, const core::PlaneSet& frustum)
        : _eye(eye), _region(region), _frustum(frustum) {}

    /// See core::RegionalSight::holdsAll.
    [[nodiscard]] bool holdsAll() const { return sight() && sight()->holdsAll(); }

    /// See core::RegionalSight::holds.
    [[nodiscard]] bool holds(const core::HorizonBin& bin) const { return sight() && sight()->holds(bin); }

    /// The same for tiles of a family, one bit each.
    [[nodiscard]] std::uint64_t heldIn(const core::BinFamily& bins, std::uint64_t candidates) const {
        return sight() ? bins.heldIn(*sight(), candidates) : 0;
    }

private:
    [[nodiscard]] const std::optional<core::RegionalSight>& sight() const {
        if (!_sight) _sight = core::RegionalSight::from(_eye, _region, _frustum);
        return *_sight;
    }

    const core::HorizonEye& _eye;
    const core::CoveredRegion& _region;
    const core::PlaneSet& _frustum;
    mutable std::optional<std::optional<core::RegionalSight>> _sight;  // nullopt: not looked for yet
};

}  // namespace osgAnalyticBin
