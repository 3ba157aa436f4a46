// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PictureOracle.h"

#include <algorithm>
#include <sstream>

namespace osgAnalyticBin::test {

namespace {

/// Tells why pixels differ.
class Comparison {
public:
    Comparison(const Description& description, const Painter& painter, const Delivery& without, const Delivery& with,
               const std::vector<AllowedOccluder>& allowed)
        : _description(description), _painter(painter), _without(without), _with(with), _allowed(allowed) {}

    [[nodiscard]] std::string keyAt(const Painting& painting, std::size_t pixel) const {
        const std::string* const key = _painter.keyOf(painting.numbers[pixel]);
        return key ? *key : std::string();
    }

    [[nodiscard]] PictureDifference differenceAt(std::size_t pixel) const {
        return {textAt(_without, pixel), textAt(_with, pixel), static_cast<int>(pixel % Painting::kWidth),
                static_cast<int>(pixel / Painting::kWidth)};
    }

    /// Whether what was seen in the pixel, and is lost, may be hidden by something that is not drawn.
    [[nodiscard]] bool isAllowed(std::size_t pixel) const {
        const std::string key = keyAt(_without.painting, pixel);
        const auto found = _without.drawables.find(key);
        if (found == _without.drawables.end() || _with.drawables.count(key) > 0) return false;
        const auto sight = sightTo(pixel, found->second, _without.painting);
        return sight &&
               (mayHide(_without, found->second.camera, *sight) || mayHide(_with, found->second.camera, *sight));
    }

private:
    // What is in the pixel, and where in eye space.
    [[nodiscard]] std::string textAt(const Delivery& delivery, std::size_t pixel) const {
        const auto found = delivery.drawables.find(keyAt(delivery.painting, pixel));
        if (found == delivery.drawables.end()) return "nothing";
        std::ostringstream text;
        text.precision(10);
        text << found->first;
        if (const auto sight = sightTo(pixel, found->second, delivery.painting))
            text << " at " << sight->end.x() << " " << sight->end.y() << " " << sight->end.z();
        return text.str();
    }

    [[nodiscard]] static std::optional<Sight> sightTo(std::size_t pixel, const Delivered& delivered,
                                                      const Painting& painting) {
        osg::Matrixd unproject;
        if (!unproject.invert(*delivered.projection)) return std::nullopt;
        const auto column = static_cast<int>(pixel % Painting::kWidth);
        const auto row = static_cast<int>(pixel / Painting::kWidth);
        const bool isInner = column >= kInnerPictureStart;
        const double size = isInner ? kInnerPictureSize : kPictureSize;
        const double x = 2.0 * (column - (isInner ? kInnerPictureStart : 0) + 0.5) / size - 1.0;
        const double y = 2.0 * (row + 0.5) / size - 1.0;
        const osg::Vec3d start = osg::Vec3d(x, y, -1.0) * unproject;
        const osg::Vec3d along = osg::Vec3d(x, y, 1.0) * unproject - start;
        const osg::Matrixd& projection = *delivered.projection;
        const bool isPerspective = projection(3, 3) == 0.0;
        const float depth = painting.depths[pixel];
        double t = depth;
        if (isPerspective) {
            // w is linear along the line of sight
            const auto w = [&](const osg::Vec3d& point) { return (osg::Vec4d(point, 1.0) * projection).w(); };
            t = (Painter::distance(depth) - w(start)) / (w(start + along) - w(start));
        }
        const osg::Vec3d end = start + along * t;
        return Sight{start, end, end * projection, isPerspective};
    }

    [[nodiscard]] bool mayHide(const Delivery& delivery, const std::string& camera, const Sight& sight) const {
        return std::any_of(delivery.databases.begin(), delivery.databases.end(), [&](const MetDatabase& met) {
            return met.camera == camera &&
                   std::any_of(_allowed.begin(), _allowed.end(), [&](const AllowedOccluder& occluder) {
                       return occluder.database == met.number && test::mayHide(occluder, _description, met, sight);
                   });
        });
    }

    const Description& _description;
    const Painter& _painter;
    const Delivery& _without;
    const Delivery& _with;
    const std::vector<AllowedOccluder>& _allowed;
};

// Between the pictures there is nothing to compare.
bool isInPicture(std::size_t pixel) {
    const auto column = static_cast<int>(pixel % Painting::kWidth);
    const auto row = static_cast<int>(pixel / Painting::kWidth);
    return column < kPictureSize || (column >= kInnerPictureStart && row < kInnerPictureSize);
}

}  // namespace

Description picturable(Description description) {
    for (ViewSpec& view : description.views) {
        view.computeNearFar = osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR;
        view.cullingMode &= ~static_cast<int>(osg::CullSettings::SMALL_FEATURE_CULLING);
    }
    return description;
}

std::optional<PictureDifference> findPictureDifference(const Description& description, const Painter& painter,
                                                       const Delivery& without, const Delivery& with,
                                                       const std::vector<AllowedOccluder>& allowed,
                                                       PictureTotals& totals) {
    const Comparison comparison(description, painter, without, with, allowed);
    const std::vector<std::uint32_t>& before = without.painting.numbers;
    const std::vector<std::uint32_t>& after = with.painting.numbers;
    std::optional<PictureDifference> found;
    ++totals.pictures;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (painter.keyOf(before[i])) ++totals.covered;
        if (before[i] == after[i] || !isInPicture(i)) continue;
        if (comparison.isAllowed(i)) {
            ++totals.allowed;
            continue;
        }
        if (!found) found = comparison.differenceAt(i);
        ++found->pixels;
    }
    return found;
}

}  // namespace osgAnalyticBin::test
