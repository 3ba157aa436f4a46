// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../core/LocalFrame.h"
#include "GlmBridge.h"
#include "Spheres.h"
#include "Text.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>

#include <osg/Node>
#include <osg/Notify>
#include <osg/ValueObject>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin {

namespace {

constexpr const char* kUserValueName = "osgAnalyticBin";
constexpr const char* kSurfaceLowName = "osgAnalyticBin.surfaceLow";
constexpr double kDegreesPerRadian = 57.29577951308232087680;
// Radians: wider bins may fill only a small part of the box about them.
constexpr double kWidestBox = 1.0;

// The sphere about the bin's box along east, north and up of its middle, which hardly extends beyond the bin's corners.
osg::BoundingSphere sphereOfBox(const core::ExactGeodeticBin& bin, const core::Geodetic& middle) {
    const core::LocalFrame frame(middle.latitude, middle.longitude);
    glm::dvec3 center(0.0);
    double squaredRadius = 0.0;
    for (const glm::dvec3& axis : {frame.east, frame.north, frame.up}) {
        const core::Interval range = bin.distanceRange({axis, 0.0});
        center += range.middle() * axis;
        squaredRadius += 0.25 * range.width() * range.width();
    }
    return roundedOutward(toOsg(center), std::sqrt(squaredRadius));
}

// The sphere that the test of a bin in either form begins with.
template <class Numbers>
osg::BoundingSphere firstSphere(const Numbers& numbers) {
    using namespace core::row;
    return roundedOutward({numbers[CenterX], numbers[CenterY], numbers[CenterZ]}, numbers[Reach]);
}

double radians(double degrees) {
    return core::GeodeticBin::fromDegrees({0.0, 0.0}, {degrees, degrees}, {0.0, 0.0}).longitude().lower;
}

// A number of degrees that reads back as `angle` where one exists, else as the next angle in `direction` (+1, -1).
double degreesTowards(double angle, double direction) {
    const double nearest = angle * kDegreesPerRadian;
    double degrees = nearest;
    for (const double candidate : {nearest, std::nextafter(nearest, 1e9), std::nextafter(nearest, -1e9)}) {
        if (radians(candidate) == angle) {
            // dyadic fractions of a degree, as quadtrees have them, survive bit for bit
            const double dyadic = std::round(candidate * 4194304.0) / 4194304.0;
            return radians(dyadic) == angle ? dyadic : candidate;
        }
    }
    while ((radians(degrees) - angle) * direction < 0.0) degrees = std::nextafter(degrees, direction * 1e9);
    return degrees;
}

bool areOrderedAndInRange(const std::vector<double>& v) {
    const bool ordered = v[0] <= v[3] && v[1] <= v[4] && v[2] <= v[5] && v[6] >= 0.0 && v[7] >= 0.0;
    return ordered && v[0] >= -90.0 && v[3] <= 90.0 && std::abs(v[1]) <= 720.0 && std::abs(v[4]) <= 720.0;
}

}  // namespace

void AnalyticBin::expandBy(const AnalyticBin& other) {
    if (!other.valid()) return;
    _bin.expandBy(other._bin);
    _margin = std::max(_margin, other._margin);
    _sag = std::max(_sag, other._sag);
}

bool AnalyticBin::contains(const AnalyticBin& other) const {
    return !other.valid() || (_bin.contains(other._bin) && other._margin <= _margin && other._sag <= _sag);
}

AnalyticBin AnalyticBin::exaggerated(double verticalScale) const {
    if (!valid() || !std::isfinite(verticalScale)) return {};
    if (verticalScale == 1.0) return *this;
    const core::Interval& h = _bin.altitude();
    AnalyticBin result = *this;
    if (verticalScale >= 0.0) {
        // chords of a flattened mesh sag as far as before
        const double unscaledSag = std::max(0.0, 1.0 - verticalScale) * _sag;
        result._bin = _bin.withAltitude({verticalScale * h.lower - unscaledSag, verticalScale * h.upper});
    } else {
        result._bin = _bin.withAltitude({verticalScale * h.upper - _sag, verticalScale * h.lower});
    }
    return result;
}

AnalyticBin AnalyticBin::withSkirts(double metres) const {
    if (!valid()) return *this;
    AnalyticBin result = *this;
    result._bin = _bin.withAltitude({_bin.altitude().lower - metres, _bin.altitude().upper});
    result._sag += metres;
    return result;
}

osg::Vec3d AnalyticBin::center(const osg::EllipsoidModel& ellipsoid) const {
    return toOsg(toCore(ellipsoid).toEcef(_bin.center()));
}

osg::BoundingSphere AnalyticBin::boundingSphere(const osg::EllipsoidModel& ellipsoid) const {
    if (!valid()) return {};
    const core::Ellipsoid globe = toCore(ellipsoid);
    if (!core::ExactGeodeticBin::holds(globe, _bin))
        return firstSphere(
            core::QuadraticBin(core::GeodeticMapping(globe), core::parameterBox(_bin), _margin).numbers());
    const core::ExactGeodeticBin bin(globe, _bin, _margin);
    const osg::BoundingSphere ofBox = sphereOfBox(bin, _bin.center()), first = firstSphere(bin.numbers());
    const bool isNarrow = _bin.longitude().width() < kWidestBox && _bin.latitude().width() < kWidestBox;
    return isNarrow || ofBox.radius() < first.radius() ? ofBox : first;
}

std::string AnalyticBin::toText() const {
    if (!valid()) return {};
    std::vector<double> numbers{std::max(degreesTowards(_bin.latitude().lower, -1.0), -90.0),
                                degreesTowards(_bin.longitude().lower, -1.0),
                                _bin.altitude().lower,
                                std::min(degreesTowards(_bin.latitude().upper, 1.0), 90.0),
                                degreesTowards(_bin.longitude().upper, 1.0),
                                _bin.altitude().upper,
                                _margin};
    if (_sag != 0.0) numbers.push_back(_sag);
    return numbersToText(numbers);
}

AnalyticBin AnalyticBin::fromText(const std::string& text) {
    auto v = numbersFromText(text, 8);
    if (!v) {
        v = numbersFromText(text, 7);
        if (v) v->push_back(0.0);
    }
    if (!v || !areOrderedAndInRange(*v)) return {};
    const auto& n = *v;
    AnalyticBin bin(core::GeodeticBin::fromDegrees({n[0], n[3]}, {n[1], n[4]}, {n[2], n[5]}), n[6]);
    bin.setSag(n[7]);
    return bin;
}

void setStoredBin(osg::Node& node, const AnalyticBin& bin) {
    node.setUserValue(kUserValueName, bin.toText());
}

AnalyticBin storedBin(const osg::Node& node) {
    std::string text;
    if (!node.getUserValue(kUserValueName, text)) return {};
    const AnalyticBin bin = AnalyticBin::fromText(text);
    if (!bin.valid()) {
        OSG_WARN << "osgAnalyticBin: the stored bin \"" << text.substr(0, 80)
                 << "\" is not seven or eight numbers in order; the tile is never culled." << std::endl;
    }
    return bin;
}

bool hasStoredBin(const osg::Node& node) {
    std::string text;
    return node.getUserValue(kUserValueName, text);
}

void setStoredSurfaceLow(osg::Node& node, double metres) {
    node.setUserValue(kSurfaceLowName, numbersToText({metres}));
}

std::optional<double> storedSurfaceLow(const osg::Node& node) {
    std::string text;
    if (!node.getUserValue(kSurfaceLowName, text)) return std::nullopt;
    const auto number = numbersFromText(text, 1);
    if (number) return number->front();
    OSG_WARN << "osgAnalyticBin: the stored lowest altitude \"" << text.substr(0, 80)
             << "\" is not a number; the horizon uses the declared lowest altitude." << std::endl;
    return std::nullopt;
}

}  // namespace osgAnalyticBin
