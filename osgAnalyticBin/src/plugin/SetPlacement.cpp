// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The only file that calls PROJ.

#include "SetPlacement.h"

#include <osg/Notify>

#include <cmath>
#include <memory>
#include <proj.h>

namespace osgAnalyticBin::plugin {

namespace {

struct Destroy {
    void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
    void operator()(PJ* object) const { proj_destroy(object); }
};
using Context = std::unique_ptr<PJ_CONTEXT, Destroy>;
using Object = std::unique_ptr<PJ, Destroy>;

constexpr const char* kGeocentric = "EPSG:4978";  // WGS 84, earth-centred

// Heights of a system that has none are above the ellipsoid.
Object systemFrom(PJ_CONTEXT* context, const std::string& srs, std::string& error) {
    Object system(proj_create(context, srs.c_str()));
    if (!system || !proj_is_crs(system.get())) {
        error = "the SRS \"" + srs +
                "\" is not known to PROJ; correct it, or empty the element SRS to open the set "
                "without a globe";
        return nullptr;
    }
    Object horizontal(proj_crs_get_sub_crs(context, system.get(), 0));
    const PJ_TYPE type = proj_get_type(horizontal ? horizontal.get() : system.get());
    if (type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS) {
        error = "the SRS \"" + srs + "\" has coordinates in degrees; one in metres is expected";
        return nullptr;
    }
    return system;
}

Object operationFrom(PJ_CONTEXT* context, const PJ* system, const char* ballpark) {
    const Object earth(proj_create(context, kGeocentric));
    if (!earth) return nullptr;
    const char* const options[] = {ballpark, nullptr};
    const Object operation(proj_create_crs_to_crs_from_pj(context, system, earth.get(), nullptr, options));
    return Object(operation ? proj_normalize_for_visualization(context, operation.get()) : nullptr);
}

// The affine mapping that agrees with the operation at a point and, to second order, about it.
std::optional<osg::Matrixd> tangentAt(PJ* operation, const osg::Vec3d& point) {
    constexpr double kStep = 100.0;
    bool isFinite = true;
    const auto mapped = [&](const osg::Vec3d& at) {
        const PJ_COORD to = proj_trans(operation, PJ_FWD, proj_coord(at.x(), at.y(), at.z(), HUGE_VAL));
        isFinite = isFinite && std::isfinite(to.xyz.x) && std::isfinite(to.xyz.y) && std::isfinite(to.xyz.z);
        return osg::Vec3d(to.xyz.x, to.xyz.y, to.xyz.z);
    };
    osg::Matrixd matrix;
    for (int axis = 0; axis < 3; ++axis) {
        osg::Vec3d step;
        step[axis] = kStep;
        const osg::Vec3d slope = (mapped(point + step) - mapped(point - step)) / (2.0 * kStep);
        for (int i = 0; i < 3; ++i) matrix(axis, i) = slope[i];
    }
    const osg::Vec3d place = mapped(point);
    if (!isFinite) return std::nullopt;
    matrix.setTrans(place - osg::Matrixd::transform3x3(point, matrix));
    return matrix;
}

void stayQuiet(void*, int, const char*) {}

}  // namespace

std::optional<SetPlacement> projectedPlacement(const std::string& srs, const osg::Vec3d& origin,
                                               const osg::Vec3d& center, std::string& error) {
    const Context context(proj_context_create());
    proj_log_func(context.get(), nullptr, stayQuiet);
    const Object system = systemFrom(context.get(), srs, error);
    if (!system) return std::nullopt;
    SetPlacement placement;
    Object operation = operationFrom(context.get(), system.get(), "ALLOW_BALLPARK=NO");
    if (!operation) {
        operation = operationFrom(context.get(), system.get(), "ALLOW_BALLPARK=YES");
        placement.warning = "PROJ has no exact way from \"" + srs +
                            "\" to WGS 84, or lacks a grid for it; the set may stand some metres or more from its "
                            "place";
    }
    const auto matrix = operation ? tangentAt(operation.get(), origin + center) : std::optional<osg::Matrixd>();
    if (!matrix) {
        error = "PROJ cannot convert the coordinates of the set from \"" + srs + "\"; are SRS and SRSOrigin right?";
        return std::nullopt;
    }
    placement.localToEcef = osg::Matrixd::translate(origin) * *matrix;
    return placement;
}

}  // namespace osgAnalyticBin::plugin
