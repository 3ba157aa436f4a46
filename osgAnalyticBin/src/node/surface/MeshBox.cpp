// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "MeshBox.h"

#include "../Spheres.h"

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace osgAnalyticBin {

namespace {

constexpr double kUnits = core::Ellipsoid::kMapUnitsInRadian;

bool isFinite(const osg::BoundingBoxd& box) {
    const double sum = box.xMin() + box.xMax() + box.yMin() + box.yMax() + box.zMin() + box.zMax();
    return std::isfinite(sum);
}

}  // namespace

MeshBox::MeshBox(const AnalyticBin& bin) : _isBoundless(!bin.valid()) {
    const core::Interval &x = bin.bin().longitude(), &y = bin.bin().latitude(), &z = bin.bin().altitude();
    if (!_isBoundless)
        _box.set(x.lower * kUnits, y.lower * kUnits, z.lower, x.upper * kUnits, y.upper * kUnits, z.upper);
}

MeshBox MeshBox::boundless() {
    MeshBox box;
    box._isBoundless = true;
    return box;
}

void MeshBox::expandBy(const MeshBox& other) {
    if (other._isBoundless) *this = boundless();
    if (_isBoundless || !other._box.valid()) return;
    _box.expandBy(other._box);
    if (!isFinite(_box)) *this = boundless();
}

bool MeshBox::contains(const MeshBox& other) const {
    if (_isBoundless || other.isEmpty()) return true;
    return !other._isBoundless && _box.valid() && _box.contains(other._box._min) && _box.contains(other._box._max);
}

MeshBox MeshBox::moved(const osg::Matrixd& matrix) const {
    if (!_box.valid()) return *this;
    MeshBox result;
    for (unsigned int i = 0; i < 8; ++i) result._box.expandBy(_box.corner(i) * matrix);
    return isFinite(result._box) ? result : boundless();
}

AnalyticBin MeshBox::bin() const {
    const auto isInMap = [](double x) { return std::abs(x) <= core::Ellipsoid::kFarthestInMap; };
    if (!_box.valid() || !isInMap(_box.xMin()) || !isInMap(_box.xMax()) || !isInMap(_box.yMin()) ||
        !isInMap(_box.yMax()))
        return {};
    return AnalyticBin(core::GeodeticBin({_box.yMin() / kUnits, _box.yMax() / kUnits},
                                         {_box.xMin() / kUnits, _box.xMax() / kUnits}, {_box.zMin(), _box.zMax()}));
}

TestedBox::TestedBox(const osg::BoundingBoxd& box)
    : _center(box.center()),
      _half((box._max - box._min) * 0.5),
      _reach(_center.length() + _half.length()),
      _sphere(roundedOutward(_center, _half.length())) {}

core::Side TestedBox::classify(const osg::Polytope::PlaneList& planes, core::PlaneMask& undecided,
                               const osg::BoundingSphere* also) const {
    constexpr double kRounding = 32.0 * std::numeric_limits<double>::epsilon();
    for (std::size_t i = 0; i < planes.size() && i < core::kMaxPlanes; ++i) {
        const core::PlaneMask bit = core::PlaneMask{1} << i;
        if (!(undecided & bit)) continue;
        const osg::Plane& plane = planes[i];
        const double middle = plane[0] * _center.x() + plane[1] * _center.y() + plane[2] * _center.z() + plane[3];
        const double half =
            std::abs(plane[0]) * _half.x() + std::abs(plane[1]) * _half.y() + std::abs(plane[2]) * _half.z();
        const double slack = kRounding * (_reach + std::abs(plane[3]));
        double low = middle - half - slack;
        double high = middle + half + slack;
        if (also && also->valid()) {
            const double other = plane.distance(osg::Vec3d(also->center()));
            low = std::min(low, other - static_cast<double>(also->radius()) - slack);
            high = std::max(high, other + static_cast<double>(also->radius()) + slack);
        }
        // written so that NaN is undecided
        if (high < 0.0) return core::Side::Outside;
        if (low >= 0.0) undecided &= ~bit;
    }
    return undecided == 0 ? core::Side::Inside : core::Side::Straddling;
}

}  // namespace osgAnalyticBin
