// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "MeshBox.h"

#include "TerrainLimits.h"

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <cmath>

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
    const core::GeodeticBin bin({_box.yMin() / kUnits, _box.yMax() / kUnits},
                                {_box.xMin() / kUnits, _box.xMax() / kUnits}, {_box.zMin(), _box.zMax()});
    return AnalyticBin(bin, drawingErrorOf(largestCoordinate(bin)));
}

}  // namespace osgAnalyticBin
