// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Oracle.h"

#include "Parts.h"

#include <osg/TriangleIndexFunctor>

namespace osgAnalyticBin::test {

namespace {

// Of half the picture, points this near to its border are left out.
constexpr double kBorder = 1e-5;
constexpr double kPixels = 512.0;

/// All that both traversals delivered for one camera.
class Picture {
public:
    Picture(const Description& description, const std::vector<AllowedOccluder>& allowed, std::string camera)
        : _description(description), _allowed(allowed), _camera(std::move(camera)) {}

    void add(const Delivery& delivery) {
        for (const auto& [key, delivered] : delivery.drawables)
            if (delivered.camera == _camera && delivered.isFilled) _drawn.push_back({&delivered, nullptr});
        for (const MetDatabase& met : delivery.databases)
            if (met.camera == _camera) _met.push_back(&met);
    }

    [[nodiscard]] bool isHidden(const Sight& sight) { return isBlocked(sight.start, sight.end) || isAllowed(sight); }

private:
    [[nodiscard]] bool isBlocked(const osg::Vec3d& from, const osg::Vec3d& to) {
        if (_last && _last->block(from, to)) return true;
        for (auto& [delivered, triangles] : _drawn) {
            if (!triangles) triangles = std::make_unique<Triangles>(*delivered->drawable, delivered->modelView);
            if (!triangles->block(from, to)) continue;
            _last = triangles.get();
            return true;
        }
        return false;
    }

    // Samples are of surfaces: where terrain hides terrain, an eye above the ground sees them from in front.
    [[nodiscard]] bool isAllowed(const Sight& sight) {
        const bool isHilly = _description.theme == Theme::Hills;
        return std::any_of(_met.begin(), _met.end(), [&](const MetDatabase* met) {
            const auto isAllowedBy = [&](const AllowedOccluder& occluder) {
                return occluder.database == met->number && mayHide(occluder, _description, *met, sight) &&
                       (!isHilly || occluder.fromEverywhere || isUnderground(*met, sight, occluder.highest));
            };
            return std::any_of(_allowed.begin(), _allowed.end(), isAllowedBy);
        });
    }

    // Whether terrain is above the eye, or above the point of the near plane where the line of sight begins. Terrain
    // out of view is not drawn, so that a point deeper than all terrain counts by its depth.
    [[nodiscard]] bool isUnderground(const MetDatabase& met, const Sight& sight, double relief) {
        const DatabaseSpec& database = _description.database(met.number);
        const osg::Matrixd toDatabase = osg::Matrixd::inverse(met.modelView);
        const auto hasTerrainAbove = [&](const osg::Vec3d& point) {
            osg::Vec3d up = database.isMap ? osg::Vec3d(0.0, 0.0, 1.0) : point * toDatabase;
            up.normalize();
            return isBlocked(point, point + osg::Matrixd::transform3x3(up, met.modelView) * database.size());
        };
        const double deepest = std::min(database.equatorial, database.polar) - relief - sagOf(database, 0);
        return (database.isWhole() && (sight.start * toDatabase).length() < deepest) || hasTerrainAbove(sight.start) ||
               (sight.isPerspective && hasTerrainAbove(osg::Vec3d()));
    }

    const Description& _description;
    const std::vector<AllowedOccluder>& _allowed;
    const std::string _camera;
    std::vector<std::pair<const Delivered*, std::unique_ptr<Triangles>>> _drawn;
    std::vector<const MetDatabase*> _met;
    const Triangles* _last = nullptr;
};

/// Projects the points of one drawable.
class Projector {
public:
    explicit Projector(const osg::Matrixd& projection) : _projection(projection) {
        _isUsable = _unproject.invert(projection);
    }

    /// Returns: nullopt when the point is not in the picture.
    [[nodiscard]] std::optional<Sight> sightTo(const osg::Vec3d& point) const {
        const osg::Vec4d clip = osg::Vec4d(point, 1.0) * _projection;
        const double w = clip.w();
        const double most = w * (1.0 - kBorder);
        const bool isInside =
            _isUsable && w > 0.0 && std::abs(clip.x()) <= most && std::abs(clip.y()) <= most && std::abs(clip.z()) <= w;
        if (!isInside) return std::nullopt;
        const osg::Vec3d inPicture(clip.x() / w, clip.y() / w, clip.z() / w);
        return Sight{osg::Vec3d(inPicture.x(), inPicture.y(), -1.0) * _unproject, point, inPicture,
                     _projection(3, 3) == 0.0};
    }

    /// How large the drawable is in the picture at most.
    [[nodiscard]] double pixels(const Triangles& triangles) const {
        const osg::Vec4d clip = osg::Vec4d(triangles.center, 1.0) * _projection;
        const double scale = std::max(std::abs(_projection(0, 0)), std::abs(_projection(1, 1)));
        return triangles.radius * scale / std::max(std::abs(clip.w()), 1e-9) * kPixels;
    }

private:
    const osg::Matrixd _projection;
    osg::Matrixd _unproject;
    bool _isUsable = false;
};

std::vector<osg::Vec3d> samplesOf(const Triangles& triangles, bool isFilled) {
    std::vector<osg::Vec3d> samples;
    for (const Triangle& t : triangles.surface) {
        samples.insert(samples.end(), t.begin(), t.end());
        if (isFilled) samples.push_back((t[0] + t[1] + t[2]) / 3.0);
    }
    return samples;
}

std::optional<FalseCull> findVisiblePoint(const std::string& key, const Delivered& lost, Picture& picture,
                                          const WhatCounts& counts) {
    const Triangles triangles(*lost.drawable, lost.modelView);
    const Projector projector(*lost.projection);
    if (projector.pixels(triangles) < counts.smallestPixels) return std::nullopt;
    const Projector given(lost.givenProjection);
    for (const osg::Vec3d& sample : samplesOf(triangles, lost.isFilled)) {
        const auto sight = projector.sightTo(sample);
        const bool isInPicture = sight && (!counts.onlyBetweenGivenPlanes || given.sightTo(sample));
        if (isInPicture && (lost.ignoresDepth || !picture.isHidden(*sight)))
            return FalseCull{key, sample, sight->inPicture};
    }
    return std::nullopt;
}

// Triangles are taken a little larger than they are: neighbours that are rounded to float leave no cracks.
constexpr double kEnlarged = 2e-3;
// A point is not behind what it touches.
constexpr double kNearlyThere = 1.0 - 1e-6;

struct IndexCollector {
    std::vector<unsigned int> indices;
    void operator()(unsigned int a, unsigned int b, unsigned int c) { indices.insert(indices.end(), {a, b, c}); }
};

// Source: Moeller and Trumbore 1997.
bool meets(const Triangle& t, const osg::Vec3d& from, const osg::Vec3d& along) {
    const osg::Vec3d e1 = t[1] - t[0];
    const osg::Vec3d e2 = t[2] - t[0];
    const osg::Vec3d p = along ^ e2;
    const double determinant = e1 * p;
    if (determinant == 0.0) return false;
    const osg::Vec3d s = from - t[0];
    const double u = (s * p) / determinant;
    if (!(u >= -kEnlarged && u <= 1.0 + kEnlarged)) return false;
    const osg::Vec3d q = s ^ e1;
    const double v = (along * q) / determinant;
    if (!(v >= -kEnlarged && u + v <= 1.0 + kEnlarged)) return false;
    const double at = (e2 * q) / determinant;
    return at > 0.0 && at < kNearlyThere;
}

double largestScale(const Description& description, const DatabaseSpec& database, int number) {
    double largest = std::abs(database.verticalScale);
    for (const Part& part : description.parts)
        if (part.kind == PartKind::SetScale && part.tile.database == number)
            largest = std::max(largest, std::abs(part.amount));
    return std::max(largest, 1.0);
}

// Metres.
double mostRaised(const Description& description, int number) {
    double most = 0.0;
    for (const Part& part : description.parts)
        if (part.kind == PartKind::Raise && part.tile.database == number) most = std::max(most, part.amount);
    return most;
}

// Whether terrain may hide tiles in any frame.
bool mayTerrainHide(const Description& description, const DatabaseSpec& database) {
    return database.options.horizonUse != HorizonUse::Off ||
           std::any_of(description.parts.begin(), description.parts.end(), [](const Part& part) {
               const bool setsOptions = part.kind == PartKind::SetOptions || part.kind == PartKind::Install;
               return setsOptions && part.options.horizonUse != HorizonUse::Off;
           });
}

}  // namespace

std::optional<FalseCull> findFalseCull(const Description& description, const Delivery& without, const Delivery& with,
                                       const std::vector<AllowedOccluder>& allowed, const WhatCounts& counts) {
    std::map<std::string, Picture> pictures;
    for (const auto& [key, delivered] : without.drawables) {
        if (with.drawables.count(key) > 0) continue;
        auto known = pictures.find(delivered.camera);
        if (known == pictures.end()) {
            known = pictures.emplace(delivered.camera, Picture(description, allowed, delivered.camera)).first;
            known->second.add(without);
            known->second.add(with);
        }
        if (auto found = findVisiblePoint(key, delivered, known->second, counts)) return found;
    }
    return std::nullopt;
}

Triangles::Triangles(const osg::Drawable& drawable, const osg::Matrixd& matrix) {
    const osg::Geometry* geometry = drawable.asGeometry();
    const auto* vertices = geometry ? dynamic_cast<const osg::Vec3Array*>(geometry->getVertexArray()) : nullptr;
    if (!vertices) return;
    std::vector<osg::Vec3d> points;
    points.reserve(vertices->size());
    for (const osg::Vec3& vertex : *vertices) points.push_back(osg::Vec3d(vertex) * matrix);
    for (const osg::Vec3d& point : points) center += point / static_cast<double>(points.size());
    for (const osg::Vec3d& point : points) radius = std::max(radius, (point - center).length());
    radius *= 1.0 + kEnlarged;
    for (const auto& primitives : geometry->getPrimitiveSetList()) {
        osg::TriangleIndexFunctor<IndexCollector> collector;
        primitives->accept(collector);
        std::vector<Triangle>& target = primitives->getMode() == GL_TRIANGLES ? surface : skirts;
        for (std::size_t i = 0; i + 2 < collector.indices.size(); i += 3)
            target.push_back(
                {points[collector.indices[i]], points[collector.indices[i + 1]], points[collector.indices[i + 2]]});
    }
}

bool Triangles::block(const osg::Vec3d& from, const osg::Vec3d& to) const {
    const osg::Vec3d along = to - from;
    const double square = along.length2();
    const double t = square > 0.0 ? std::clamp(((center - from) * along) / square, 0.0, 1.0) : 0.0;
    if ((from + along * t - center).length2() > radius * radius) return false;
    const auto meetsOne = [&](const Triangle& triangle) { return meets(triangle, from, along); };
    return std::any_of(surface.begin(), surface.end(), meetsOne) || std::any_of(skirts.begin(), skirts.end(), meetsOne);
}

// doc/limits.md:
// - The horizon and occlusion are for eyes above the terrain: eyes below the highest.
// - The horizon needs "a near plane that does not cut visible terrain away": lines of sight that begin below it.
// - "Through a slit between tiles, pixels may show what is far behind", and the proofs assume that skirts close the
//   cracks (doc/theory/horizon.md, section 8): databases without skirts.
std::vector<AllowedOccluder> allowedOccluders(const Description& description) {
    std::vector<AllowedOccluder> result;
    for (std::size_t i = 0; i < description.databases.size(); ++i) {
        const DatabaseSpec& database = description.databases[i];
        if (database.isMap && description.theme != Theme::Hills) continue;
        const int number = static_cast<int>(i);
        const double relief = database.relief * largestScale(description, database, number);
        const bool fromEverywhere = !database.hasSkirts && database.levels > 0;
        result.push_back({number, relief, mayTerrainHide(description, database), fromEverywhere});
        // raised terrain that the near plane cuts, from eyes above it
        if (const double raised = mostRaised(description, number); raised > 0.0)
            result.push_back({number, relief + raised, false, false});
    }
    return result;
}

bool mayHide(const AllowedOccluder& occluder, const Description& description, const MetDatabase& met,
             const Sight& sight) {
    const DatabaseSpec& database = description.database(met.number);
    const osg::Matrixd toDatabase = osg::Matrixd::inverse(met.modelView);
    // The database's surface, so many metres higher, is the unit sphere there, or the plane z = 1.
    const auto scaled = [&](const osg::Vec3d& point, double altitude) {
        const osg::Vec3d p = point * toDatabase;
        if (database.isMap) return osg::Vec3d(0.0, 0.0, 1.0 + (p.z() - altitude) / database.size());
        return osg::Vec3d(p.x() / (database.equatorial + altitude), p.y() / (database.equatorial + altitude),
                          p.z() / (database.polar + altitude));
    };
    const auto heightOver = [&](const osg::Vec3d& p) { return (database.isMap ? p.z() : p.length()) - 1.0; };
    const bool isBelow = heightOver(scaled(sight.start, occluder.highest)) < 0.0;
    const bool isEyeBelow = sight.isPerspective && heightOver(scaled(osg::Vec3d(), occluder.highest)) < 0.0;
    const bool isAllowed = isBelow && (occluder.fromBelow || !isEyeBelow);
    if (!isAllowed && !occluder.fromEverywhere) return false;
    const auto passesBehind = [&](const osg::Vec3d& start) {
        // from below the terrain, whatever is lower than the eye
        const double unit = database.isMap ? database.size() : database.polar;
        const double own = heightOver(scaled(start, 0.0)) * unit - 1.0;
        const double altitude = isBelow ? std::min(own, 0.0) : 0.0;
        const osg::Vec3d from = scaled(start, altitude);
        const osg::Vec3d along = scaled(sight.end, altitude) - from;
        const double square = along.length2();
        const double t = square > 0.0 ? std::clamp(-(from * along) / square, 0.0, 1.0) : 0.0;
        return heightOver(from + along * t) < 0.0;
    };
    // a near plane inside the globe cuts away the surface that would hide the point from the eye
    return passesBehind(sight.start) || (isBelow && sight.isPerspective && passesBehind(osg::Vec3d()));
}

}  // namespace osgAnalyticBin::test
