// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "AllowedOccluders.h"

#include <algorithm>

namespace osgAnalyticBin::test {

bool mayHide(const AllowedOccluder& occluder, const Description& description, const MetDatabase& met,
             const Sight& sight) {
    const DatabaseSpec& database = description.databases[static_cast<std::size_t>(met.number)];
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
    // a near plane within the globe has cut away what hides from the eye
    return passesBehind(sight.start) || (isBelow && sight.isPerspective && passesBehind(osg::Vec3d()));
}

}  // namespace osgAnalyticBin::test
