// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Oracle.h"

namespace osgAnalyticBin::test {

namespace {

/// Where a pixel is in its picture: that of the view, or of a camera in the scene beside it.
struct Place {
    int column, row, size;

    explicit Place(std::size_t pixel) {
        const auto columnOfAll = static_cast<int>(pixel % Painting::kWidth);
        const bool isInner = columnOfAll >= kInnerPictureStart;
        column = isInner ? columnOfAll - kInnerPictureStart : columnOfAll;
        row = static_cast<int>(pixel / Painting::kWidth);
        size = isInner ? kInnerPictureSize : kPictureSize;
    }

    /// Between the pictures there is nothing to compare.
    [[nodiscard]] bool isInPicture() const { return column < size && row < size; }
    /// `width`: pixels.
    [[nodiscard]] bool isAtBorder(int width) const {
        return std::min(column, row) < width || std::max(column, row) >= size - width;
    }
};

// The name of the state that a part sets; empty: none.
std::string nameOfState(const Part& part) {
    const bool isState = part.kind == PartKind::State || part.kind == PartKind::PushesState;
    return isState ? stateName(part.variant) : std::string();
}

/// Tells why pixels differ.
class PictureComparison {
public:
    PictureComparison(const Description& description, const Painter& painter, const Delivery& without,
                      const Delivery& with, const std::vector<AllowedOccluder>& allowed)
        : _description(description), _painter(painter), _without(without), _with(with), _allowed(allowed) {}

    [[nodiscard]] std::string keyAt(const Painting& painting, std::size_t pixel) const {
        const std::string* const key = _painter.keyOf(painting.numbers[pixel]);
        return key ? *key : std::string();
    }

    [[nodiscard]] PictureDifference differenceAt(std::size_t pixel) const {
        return {textAt(_without, pixel), textAt(_with, pixel), static_cast<int>(pixel % Painting::kWidth),
                static_cast<int>(pixel / Painting::kWidth)};
    }

    /// Whether the documentation, or OSG, explains the difference.
    [[nodiscard]] bool isAllowed(std::size_t pixel) const {
        if (areBothPlain(pixel) && isTie(pixel, 0)) return true;
        if (_with.arePlanesComputed && isAtNearPlane(pixel)) return true;
        const std::string now = keyAt(_with.painting, pixel);
        if (!now.empty() && _without.drawables.count(now) == 0) return hasScaledTerrain(_description);
        const std::string key = keyAt(_without.painting, pixel);
        const auto found = _without.drawables.find(key);
        if (found == _without.drawables.end() || _with.drawables.count(key) > 0) return false;
        const Delivered& lost = found->second;
        if (lost.isPlain && !lost.isFilled && isTie(pixel, 1)) return true;
        // lines and points beside the picture are wide enough to be seen in it, lines also beside what they cross
        if (!lost.isFilled && Place(pixel).isAtBorder(2)) return true;
        const auto sight = sightTo(pixel, lost, _without.painting);
        if (lost.isPlain && isInCrack(pixel)) return true;
        if (sight && isInSlit(pixel) && isBehindCoarseTiles(lost, *sight)) return true;
        return sight && (mayHide(_without, lost.camera, *sight) || mayHide(_with, lost.camera, *sight));
    }

private:
    // Whether the depths of a pixel are those of the drawables in it.
    [[nodiscard]] bool areBothPlain(std::size_t pixel) const {
        const auto isPlain = [&](const Delivery& delivery) {
            const auto found = delivery.drawables.find(keyAt(delivery.painting, pixel));
            return found != delivery.drawables.end() && found->second.isPlain;
        };
        return isPlain(_without) && isPlain(_with);
    }

    // Where a near plane cuts, in projections of single precision that differ by their far planes.
    [[nodiscard]] bool isAtNearPlane(std::size_t pixel) const {
        constexpr double kRounding = 2e-4;  // of the plane's distance
        double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0, near = 0.0, far = 0.0;
        const float depth = std::min(_without.painting.depths[pixel], _with.painting.depths[pixel]);
        return _with.projection.getFrustum(left, right, bottom, top, near, far) &&
               std::abs(Painter::distance(depth) - near) <= kRounding * near;
    }

    // Where surfaces coincide, such as the skirts of neighbours, one that is left shows what both did. Lines that
    // coincide may be drawn a pixel apart.
    [[nodiscard]] bool isTie(std::size_t pixel, int around) const {
        constexpr float kDepthSteps = 4.0F / 16777216.0F;
        const Place place(pixel);
        for (int row = std::max(place.row - around, 0); row <= std::min(place.row + around, place.size - 1); ++row) {
            for (int columns = -around; columns <= around; ++columns) {
                const std::size_t other =
                    pixel + static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(row - place.row) * static_cast<std::size_t>(Painting::kWidth);
                if (other >= _with.painting.numbers.size() || _with.painting.numbers[other] == 0) continue;
                if (std::abs(_without.painting.depths[pixel] - _with.painting.depths[other]) <= kDepthSteps)
                    return true;
            }
        }
        return false;
    }

    // The proofs assume that skirts close the cracks between tiles (doc/theory/horizon.md, section 8). Without skirts,
    // a line of pixels between two tiles may show what is behind both.
    [[nodiscard]] bool isInCrack(std::size_t pixel) const {
        const auto hasSkirts = [](const DatabaseSpec& database) { return database.hasSkirts; };
        if (std::all_of(_description.databases.begin(), _description.databases.end(), hasSkirts)) return false;
        if (Place(pixel).isAtBorder(1)) return false;
        constexpr std::size_t kRow = Painting::kWidth;
        const std::vector<float>& depths = _without.painting.depths;
        const auto isNearer = [&](std::size_t other) { return depths[other] < depths[pixel]; };
        const std::size_t steps[] = {1, kRow - 1, kRow, kRow + 1};
        return std::any_of(std::begin(steps), std::end(steps),
                           [&](std::size_t step) { return isNearer(pixel - step) && isNearer(pixel + step); });
    }

    // Whether nearer terrain is on both sides of it.
    [[nodiscard]] bool isInSlit(std::size_t pixel) const {
        constexpr int kWidest = 8;
        const Place place(pixel);
        const std::vector<float>& depths = _without.painting.depths;
        const auto hasNearer = [&](int columns, int rows) {
            for (int i = 1; i <= kWidest; ++i) {
                const int column = place.column + i * columns, row = place.row + i * rows;
                if (std::min(column, row) < 0 || std::max(column, row) >= place.size) return false;
                const std::ptrdiff_t step = i * (std::ptrdiff_t{rows} * Painting::kWidth + columns);
                if (depths[pixel + static_cast<std::size_t>(step)] < depths[pixel]) return true;
            }
            return false;
        };
        constexpr int kSteps[][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}};
        return std::any_of(std::begin(kSteps), std::end(kSteps), [&](const int(&step)[2]) {
            return hasNearer(step[0], step[1]) && hasNearer(-step[0], -step[1]);
        });
    }

    // doc/limits.md: "Through a slit between tiles, pixels may show what is (...) below the skirts", and "On globes of
    // very coarse tiles (...) slits are kilometres wide".
    [[nodiscard]] bool isBehindCoarseTiles(const Delivered& lost, const Sight& sight) const {
        constexpr double kLongChord = 0.17;  // radians
        return std::any_of(_without.databases.begin(), _without.databases.end(), [&](const MetDatabase& met) {
            const DatabaseSpec& database = _description.database(met.number);
            const bool isCoarse =
                !database.isMap && database.levels > 0 && database.tileWidth(0) > kLongChord * (database.posts - 1);
            return isCoarse && met.camera == lost.camera &&
                   test::mayHide({met.number, database.relief, false, true}, _description, met, sight);
        });
    }

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

    // Looks through another pixel than the one whose depth it is: `columns` to the right and `rows` above.
    [[nodiscard]] static std::optional<Sight> sightTo(std::size_t pixel, const Delivered& delivered,
                                                      const Painting& painting, int columns = 0, int rows = 0) {
        osg::Matrixd unproject;
        if (!unproject.invert(*delivered.projection)) return std::nullopt;
        const Place place(pixel);
        const double x = 2.0 * (place.column + columns + 0.5) / place.size - 1.0;
        const double y = 2.0 * (place.row + rows + 0.5) / place.size - 1.0;
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

}  // namespace

Description picturable(Description description) {
    std::vector<Part>& parts = description.parts;
    // cameras in the scene may build on the view's projection, depths without the painter's program depend on it, and
    // logic operations mix surfaces whose order in depth is a matter of its rounding
    const bool isProjectionUsed = std::any_of(parts.begin(), parts.end(), [](const Part& part) {
        const std::string state = nameOfState(part);
        return part.kind == PartKind::Camera || state.find("program") != std::string::npos ||
               state.find("logic op") == 0;
    });
    for (ViewSpec& view : description.views) {
        const bool isOrthographic = view.projection(3, 3) != 0.0;
        if (isProjectionUsed || isOrthographic) view.computeNearFar = osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR;
        view.cullingMode &= ~static_cast<int>(osg::CullSettings::SMALL_FEATURE_CULLING);
    }
    const auto dependsOnOrder = [](const Part& part) {
        const std::string state = nameOfState(part);
        return state == "clip plane" || state == "primitive restart" || state == "rasterizer discard";
    };
    for (Part& part : parts) {
        if (part.kind == PartKind::Camera) part.variant %= kFixedCameras;
    }
    parts.erase(std::remove_if(parts.begin(), parts.end(), dependsOnOrder), parts.end());
    return description;
}

std::optional<PictureDifference> findPictureDifference(const Description& description, const Painter& painter,
                                                       const Delivery& without, const Delivery& with,
                                                       const std::vector<AllowedOccluder>& allowed,
                                                       PictureTotals& totals) {
    const PictureComparison comparison(description, painter, without, with, allowed);
    const std::vector<std::uint32_t>& before = without.painting.numbers;
    const std::vector<std::uint32_t>& after = with.painting.numbers;
    std::optional<PictureDifference> found;
    ++totals.pictures;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (painter.keyOf(before[i])) ++totals.covered;
        if (before[i] == after[i] || !Place(i).isInPicture()) continue;
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
