// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "AllowedOccluders.h"

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::test {

namespace {

double largestScale(const Description& description, const DatabaseSpec& database, int number) {
    double largest = std::abs(database.verticalScale);
    for (const Part& part : description.parts) {
        if (part.kind == PartKind::SetScale && part.tile.database == number)
            largest = std::max(largest, std::abs(part.amount));
    }
    return std::max(largest, 1.0);
}

// Metres.
double mostRaised(const Description& description, int number) {
    double most = 0.0;
    for (const Part& part : description.parts) {
        if (part.kind == PartKind::Raise && part.tile.database == number) most = std::max(most, part.amount);
    }
    return most;
}

// Whether bins hold whole skirts in all frames.
bool holdsAllSkirts(const Description& description, const DatabaseSpec& database) {
    return database.options.skirts == SkirtUse::All &&
           std::all_of(description.parts.begin(), description.parts.end(), [](const Part& part) {
               const bool setsOptions = part.kind == PartKind::SetOptions || part.kind == PartKind::Install;
               return !setsOptions || part.options.skirts == SkirtUse::All;
           });
}

}  // namespace

// doc/limits.md:
// - "Bins hold those parts of skirts that an eye above the terrain can see through cracks.": eyes below the highest
//   terrain.
// - The horizon needs "a near plane that does not cut visible terrain away": lines of sight that begin below it.
// - "Through a slit between tiles, pixels may show what is far behind", and the proofs assume that skirts close the
//   cracks (doc/theory/tiles.md, section 4): databases without skirts.
std::vector<AllowedOccluder> allowedOccluders(const Description& description) {
    std::vector<AllowedOccluder> result;
    for (std::size_t i = 0; i < description.databases.size(); ++i) {
        const DatabaseSpec& database = description.databases[i];
        if (database.isMap && description.theme != Theme::Hills) continue;
        const int number = static_cast<int>(i);
        const double relief = database.relief * largestScale(description, database, number);
        const bool fromEverywhere = !database.hasSkirts && database.levels > 0;
        result.push_back({number, relief, !holdsAllSkirts(description, database), fromEverywhere});
        // raised terrain that the near plane cuts, from eyes above it
        if (const double raised = mostRaised(description, number); raised > 0.0)
            result.push_back({number, relief + raised, false, false});
    }
    return result;
}

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
