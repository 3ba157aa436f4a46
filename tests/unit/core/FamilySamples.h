// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CoreTest.h"

namespace osgAnalyticBin::test {

/// In which form a slot of a family got its bin.
enum class SlotKind { Either, Exact, Quadratic, Empty };

/// A bin in all forms, and which one the family has.
struct Slot {
    core::QuadraticOrExact either;
    core::ExactGeodeticBin exact;
    core::QuadraticBin quadratic;
    core::HorizonBin horizon;
    SlotKind kind;
    bool hasHorizon;
};

/// Planes most of which touch or nearly touch one of the bins: any number, now and then with what is no number.
inline void addRandomPlanes(Random& random, const std::vector<BinOracle>& oracles, core::PlaneSet& planes) {
    constexpr std::array<double, 4> kNoNumbers{kNaN, kInfinity, -kInfinity, std::numeric_limits<double>::max()};
    const int count = random.chance(0.5) ? random.integer(4, 6) : random.integer(0, static_cast<int>(core::kMaxPlanes));
    const bool allInside = random.chance(0.3);
    for (int i = 0; i < count; ++i) {
        const BinOracle& near =
            oracles[static_cast<std::size_t>(random.integer(0, static_cast<int>(oracles.size()) - 1))];
        core::Plane plane = randomPlane(random, near, random.pick(kPlaneKinds));
        if (allInside) plane.offset += random.uniform(0.0, 2.0) * sizeOf(near.ellipsoid(), near.bin());
        if (random.chance(0.01)) {
            double& number = random.chance(0.5) ? plane.offset : plane.normal[random.integer(0, 2)];
            number = random.pick(kNoNumbers);
        }
        planes.push_back(plane);
    }
}

/// Siblings, or bins of any kind beside each other, and planes about them. Masks have gaps, and slots are empty or
/// cleared.
struct FamilyCase {
    explicit FamilyCase(Random& random)
        : ellipsoid(randomEllipsoid(random)),
          family(static_cast<std::size_t>(random.chance(0.02) ? 64 : random.integer(1, 9))) {
        const bool areSiblings = random.chance(0.5);
        const core::GeodeticBin parent = randomTile(random, random.integer(0, kDeepestLevel), randomAltitude(random));
        const SlotKind common = random.chance(0.5) ? SlotKind::Either : SlotKind::Exact;
        const bool isMixed = random.chance(0.3);
        std::vector<BinOracle> oracles;
        for (std::size_t i = 0; i < family.size(); ++i) {
            oracles.emplace_back(ellipsoid, areSiblings ? siblingOf(random, parent, i) : randomBin(random));
            constexpr std::array<SlotKind, 4> kKinds{SlotKind::Either, SlotKind::Exact, SlotKind::Quadratic,
                                                     SlotKind::Empty};
            addSlot(random, oracles.back().bin(), i, isMixed ? random.pick(kKinds) : common);
        }
        addRandomPlanes(random, oracles, planes);
        undecided = random.chance(0.5) ? planes.all() : static_cast<core::PlaneMask>(random.bits());
        candidates = random.chance(0.5) ? ~std::uint64_t{0} : random.bits();
        const double depth = randomDepth(random);
        eye = core::HorizonEye::fromEye(ellipsoid, depth, randomEye(random, ellipsoid, depth));
    }

    core::Ellipsoid ellipsoid;
    core::BinFamily family;
    std::vector<Slot> slots;
    core::PlaneSet planes;
    core::PlaneMask undecided = 0;
    std::optional<core::HorizonEye> eye;
    std::uint64_t candidates = 0;

private:
    static core::GeodeticBin siblingOf(Random& random, const core::GeodeticBin& parent, std::size_t i) {
        const auto part = [](const core::Interval& whole, std::size_t k) {
            const double lower = whole.lower + whole.width() * (0.25 * static_cast<double>(k % 4));
            return core::Interval{lower, std::min(whole.upper, lower + 0.25 * whole.width())};
        };
        core::Interval altitude = parent.altitude();
        altitude.upper = altitude.lower + altitude.width() * random.uniform();
        return {part(parent.latitude(), i / 4), part(parent.longitude(), i), altitude};
    }

    void addSlot(Random& random, const core::GeodeticBin& bin, std::size_t i, SlotKind kind) {
        const double margin = random.chance(0.5) ? 0.0 : random.logUniform(1e-3, 1e4);
        slots.push_back({core::quadraticOrExact(ellipsoid, bin, margin), core::ExactGeodeticBin(ellipsoid, bin, margin),
                         core::QuadraticBin(core::GeodeticMapping(ellipsoid), core::parameterBox(bin), margin),
                         core::HorizonBin(ellipsoid, bin, margin), kind, random.chance(0.9)});
        const Slot& slot = slots.back();
        // What was in the slot before must not matter.
        if (random.chance(0.2)) family.set(i, slot.exact);
        if (random.chance(0.2)) family.set(i, slot.quadratic);
        if (random.chance(0.2)) {
            family.setHorizon(i, slot.horizon);
            family.clear(i);
        }
        if (kind == SlotKind::Empty && (random.chance(0.5) || family.filled() != 0)) family.clear(i);
        if (kind == SlotKind::Either) std::visit([&](const auto& form) { family.set(i, form); }, slot.either);
        if (kind == SlotKind::Exact) family.set(i, slot.exact);
        if (kind == SlotKind::Quadratic) family.set(i, slot.quadratic);
        if (slot.hasHorizon) family.setHorizon(i, slot.horizon);
    }
};

}  // namespace osgAnalyticBin::test
