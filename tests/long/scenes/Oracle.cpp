// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Oracle.h"

#include "Triangles.h"

#include <algorithm>
#include <cmath>
#include <memory>

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
        for (const auto& [key, delivered] : delivery.drawables) {
            if (delivered.camera == _camera && delivered.isFilled) _drawn.push_back({&delivered, nullptr});
        }
        for (const MetDatabase& met : delivery.databases) {
            if (met.camera == _camera) _met.push_back(&met);
        }
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
                       (!isHilly || occluder.fromEverywhere || isUnderground(*met, sight));
            };
            return std::any_of(_allowed.begin(), _allowed.end(), isAllowedBy);
        });
    }

    // Whether terrain is above the eye, or above the near plane where the line of sight begins.
    [[nodiscard]] bool isUnderground(const MetDatabase& met, const Sight& sight) {
        const DatabaseSpec& database = _description.databases[static_cast<std::size_t>(met.number)];
        const auto hasTerrainAbove = [&](const osg::Vec3d& point) {
            osg::Vec3d up(0.0, 0.0, 1.0);
            if (!database.isMap) up = point * osg::Matrixd::inverse(met.modelView);
            up.normalize();
            return isBlocked(point, point + osg::Matrixd::transform3x3(up, met.modelView) * database.size());
        };
        return hasTerrainAbove(sight.start) || (sight.isPerspective && hasTerrainAbove(osg::Vec3d()));
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
        if (isInPicture && !picture.isHidden(*sight)) return FalseCull{key, sample, sight->inPicture};
    }
    return std::nullopt;
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

}  // namespace osgAnalyticBin::test
