// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Parts.h"
#include "RandomScene.h"

namespace osgAnalyticBin::test {

namespace {

/// Where to look from and at, in the world.
struct Look {
    osg::Vec3d eye, center;
    osg::Vec3d up;
    double altitude;           // above all terrain
    double widestDeg = 110.0;  // field of view
};

double highestOf(const DatabaseSpec& database) {
    return database.relief * std::max(1.0, std::abs(database.verticalScale)) + 1.0;
}

osg::Vec3d vectorOf(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

std::vector<const Part*> partsOf(const Description& description, bool areModels, int frame) {
    std::vector<const Part*> parts;
    for (const Part& part : description.parts) {
        const bool isModel = part.kind == PartKind::Tower || part.kind == PartKind::Vehicle;
        const bool isThere = part.frame <= frame && (part.until == 0 || part.until > frame);
        if (isModel == areModels && isThere) parts.push_back(&part);
    }
    return parts;
}

const Part* pickPart(Random& random, const std::vector<const Part*>& parts) {
    return parts.empty() ? nullptr
                         : parts[static_cast<std::size_t>(random.integer(0, static_cast<int>(parts.size()) - 1))];
}

osg::Vec3d upAt(const DatabaseSpec& database, double latitude, double longitude, int frame) {
    return osg::Matrixd::transform3x3(osg::Vec3d(0.0, 0.0, 1.0),
                                      localFrame(database, latitude, longitude, 0.0) * database.toWorld(frame));
}

/// Latitude and longitude of a place so far away.
std::pair<double, double> movedBy(const DatabaseSpec& database, double latitude, double longitude, double north,
                                  double east, double unit) {
    const double parallel = database.isMap ? 1.0 : std::max(0.1, std::cos(latitude));
    return {latitude + north / unit, longitude + east / unit / parallel};
}

/// At the upper part of a model, as often from below it as from above.
Look lookAtModel(Random& random, const Description& description, const Part& part, int frame) {
    const DatabaseSpec& database = description.database(part.tile.database);
    const int frames = part.kind == PartKind::Vehicle ? frame - part.frame : 0;
    const double altitude = part.low + random.uniform(0.3, 1.0) * (part.high - part.low);
    const osg::Matrixd there = localFrame(database, part.latitude, part.longitude, altitude);
    const osg::Vec3d center = osg::Vec3d(part.amount * frames, 0.0, 0.0) * there;
    // often from so low that there is nothing but sky behind it
    const double higher = altitude - highestOf(database);
    const bool isBelow = higher > 100.0 && random.chance(0.6);
    const double distance = random.logUniform(0.5, isBelow ? 6.0 : 100.0) * std::max(part.high, part.high - part.low);
    double above = random.logUniform(10.0, isBelow ? 0.5 * higher : 2.0 * distance + 20.0);
    // the eye may have to be above all that the bins hold
    const double overBins = CullOptions::kTerrainOnEarth.upper * database.scale() - highestOf(database);
    if (isBelow && overBins < 0.9 * higher && random.chance(0.7))
        above = random.uniform(std::max(overBins, 10.0), 0.95 * higher);
    const double bearing = random.uniform(0.0, 6.28), unit = database.isMap ? 1.0 : database.polar;
    const auto [latitude, longitude] = movedBy(database, part.latitude, part.longitude, distance * std::cos(bearing),
                                               distance * std::sin(bearing) + part.amount * frames, unit);
    const osg::Matrixd world = database.toWorld(frame);
    const osg::Vec3d up = upAt(database, latitude, longitude, frame);
    Look look{place(database, latitude, longitude, highestOf(database) + above) * world, center * world, up, above};
    if (isBelow) look.widestDeg = 0.6 * osg::RadiansToDegrees(std::atan2(higher - above, distance));
    return look;
}

/// At a tile, from above the database.
Look lookAtTile(Random& random, const Description& description, const TileKey& tile, int frame) {
    const DatabaseSpec& database = description.database(tile.database);
    const Extents e = extentsOf(database, tile);
    const double latitude = e.south + random.uniform() * (e.north - e.south);
    const double longitude = e.west + random.uniform() * (e.east - e.west);
    const double size = database.size();
    const double altitude = random.logUniform(1e-6, 3.0) * size;
    const double away = std::min(1.5, std::sqrt(2.0 * altitude / size) * random.uniform(0.0, 1.5));
    const double bearing = random.uniform(0.0, 6.28);
    const double unit = database.isMap ? size : 1.0;
    const osg::Vec3d center = place(database, latitude, longitude, database.relief * random.uniform(-1.0, 1.0));
    const auto [eyeLatitude, eyeLongitude] =
        movedBy(database, latitude, longitude, unit * away * std::cos(bearing), unit * away * std::sin(bearing), 1.0);
    const osg::Vec3d eye = place(database, eyeLatitude, eyeLongitude, highestOf(database) + altitude);
    const osg::Matrixd world = database.toWorld(frame);
    return {eye * world, center * world, upAt(database, eyeLatitude, eyeLongitude, frame), altitude};
}

/// From a plain at a high place of scaled terrain.
Look lookAtSummit(Random& random, const Description& description, const TileKey& tile, int frame) {
    const DatabaseSpec& database = description.database(tile.database);
    double scale = database.verticalScale;
    for (const Part& part : description.parts) {
        const bool isScaled = part.kind == PartKind::SetScale && part.tile.database == tile.database;
        if (isScaled && part.frame <= frame) scale = part.amount;
    }
    const Extents e = extentsOf(database, tile);
    double latitude = 0.0, longitude = 0.0, top = 0.0;
    // meshes are lower between their posts
    for (int attempt = 0; attempt < 8; ++attempt) {
        const int last = database.posts - 1;
        const double p = e.south + random.integer(0, last) * (e.north - e.south) / last;
        const double l = e.west + random.integer(0, last) * (e.east - e.west) / last;
        const double height = scale * surfaceHeight(database, p, l);
        if (attempt > 0 && height < top) continue;
        latitude = p, longitude = l, top = height;
    }
    const double distance = random.logUniform(2.0, 40.0) * database.relief * std::max(1.0, std::abs(scale));
    const double bearing = random.uniform(0.0, 6.28);
    const osg::Vec3d eye =
        place(database, latitude + distance * std::cos(bearing) / database.polar,
              longitude + distance * std::sin(bearing) / database.polar, top * random.uniform(0.2, 1.1));
    const osg::Matrixd world = database.toWorld(frame);
    return {eye * world, place(database, latitude, longitude, top) * world, upAt(database, latitude, longitude, frame),
            distance, 10.0};
}

/// From little above the ground to a place that is mostly as low.
Look lookThroughValley(Random& random, const Description& description, const TileKey& tile, int frame) {
    const DatabaseSpec& database = description.database(tile.database);
    const Extents e = extentsOf(database, tile);
    const double latitude = e.south + random.uniform() * (e.north - e.south);
    const double longitude = e.west + random.uniform() * (e.east - e.west);
    const double above = database.relief * random.logUniform(0.01, 1.0);
    const double altitude = surfaceHeight(database, latitude, longitude) + above;
    const double distance = random.logUniform(0.1, 5.0) * database.waveLength();
    const double bearing = random.uniform(0.0, 6.28);
    const auto [there, east] =
        movedBy(database, latitude, longitude, distance * std::cos(bearing), distance * std::sin(bearing), 1.0);
    const osg::Vec3d center = place(database, there, east, database.relief * random.uniform(-1.0, 1.0));
    const osg::Matrixd world = database.toWorld(frame);
    const osg::Vec3d eye = place(database, latitude, longitude, altitude);
    const osg::Vec3d up = upAt(database, latitude, longitude, frame);
    // at a region from beside it
    const bool isBackward = !database.isWhole() && random.chance(0.5);
    return isBackward ? Look{center * world, eye * world, up, above} : Look{eye * world, center * world, up, above};
}

/// Down at a tile, and at what is behind it where it has a hole.
Look lookThrough(Random& random, const Description& description, const TileKey& tile, int frame) {
    const DatabaseSpec& database = description.database(tile.database);
    const Extents e = extentsOf(database, tile);
    const double altitude = random.logUniform(0.01, 1.0) * database.size();
    const auto somewhere = [&](double height) {
        return place(database, e.south + random.uniform() * (e.north - e.south),
                     e.west + random.uniform() * (e.east - e.west), height);
    };
    const double latitude = 0.5 * (e.south + e.north), longitude = 0.5 * (e.west + e.east);
    const osg::Matrixd world = database.toWorld(frame);
    return {somewhere(highestOf(database) + altitude) * world, somewhere(0.0) * world,
            upAt(database, latitude, longitude, frame), altitude};
}

/// From beyond the horizon, or from anywhere.
Look lookAtSign(Random& random, const Description& description, const Part& part, int frame) {
    const DatabaseSpec& database = description.database(part.tile.database);
    const double altitude = random.logUniform(1e-3, 2.0) * database.size();
    const double unit = database.isMap ? database.size() : 1.0;
    const double away = random.uniform(0.0, 3.1) * unit;
    const double latitude = part.latitude + away;
    const osg::Matrixd world = database.toWorld(frame);
    return {place(database, latitude, part.longitude, highestOf(database) + altitude) * world,
            place(database, part.latitude, part.longitude, part.high) * world,
            upAt(database, latitude, part.longitude, frame), altitude};
}

bool isOfApplication(PartKind kind) {
    return altersDrawing(kind) || kind == PartKind::Adding || kind == PartKind::Sign || kind == PartKind::Unculled;
}

/// At what the application has done to a tile.
std::optional<Look> lookAtApplication(Random& random, const Description& description, int frame) {
    std::vector<const Part*> parts;
    for (const Part& part : description.parts)
        if (isOfApplication(part.kind) && part.frame <= frame) parts.push_back(&part);
    const Part* const part = pickPart(random, parts);
    if (!part || random.chance(0.3)) return std::nullopt;
    if (part->kind == PartKind::Sign || part->kind == PartKind::Unculled)
        return lookAtSign(random, description, *part, frame);
    TileKey tile = part->tile;
    if (tile.level < 0) tile = {tile.database, 0, 2 * tile.column, 2 * tile.row};
    return lookThrough(random, description, tile, frame);
}

Look anyLook(Random& random, const Description& description, int frame) {
    if (const auto look = lookAtApplication(random, description, frame)) return *look;
    const double kind = random.uniform();
    if (kind < (description.theme == Theme::Models ? 0.8 : 0.4)) {
        if (const Part* model = pickPart(random, partsOf(description, true, frame)))
            return lookAtModel(random, description, *model, frame);
    }
    const int number = random.integer(0, static_cast<int>(description.databases.size()) - 1);
    const DatabaseSpec& database = description.database(number);
    TileKey tile{number, 0, random.integer(0, database.shownColumns - 1), random.integer(0, database.rows - 1)};
    if (random.chance(0.6)) {
        if (const Part* part = pickPart(random, partsOf(description, false, frame))) {
            tile = part->tile;
            if (part->kind == PartKind::Instance && random.chance(0.5)) tile.column = part->variant;
        }
    }
    const bool isSummit = description.theme == Theme::ScaledTerrain && number == 0 && random.chance(0.6);
    const bool isValley = description.theme == Theme::Hills && number == 0 && random.chance(0.7);
    Look look = isSummit   ? lookAtSummit(random, description, tile, frame)
                : isValley ? lookThroughValley(random, description, tile, frame)
                           : lookAtTile(random, description, tile, frame);
    const double size = database.size();
    if (random.chance(0.07)) look.eye += vectorOf(random.direction()) * random.logUniform(0.01, 1.0) * size;
    if (random.chance(0.1)) look.center += vectorOf(random.direction()) * random.logUniform(0.001, 1.0) * size;
    return look;
}

osg::Matrixd anyProjection(Random& random, const Look& look, double farthest) {
    const double distance = (look.center - look.eye).length();
    const double nearest = 0.01 * std::min(look.altitude, distance);
    if (random.chance(0.06)) {
        const double half = distance * random.logUniform(0.01, 2.0);
        return osg::Matrixd::ortho(-half, half, -half, half, nearest, farthest);
    }
    const double half =
        nearest *
        std::tan(0.5 * osg::DegreesToRadians(random.logUniform(std::min(0.5, 0.5 * look.widestDeg), look.widestDeg)));
    double x = 0.0, y = 0.0;
    if (random.chance(0.15)) {
        x = half * random.uniform(-2.0, 2.0);
        y = half * random.uniform(-2.0, 2.0);
    }
    const double aspect = random.uniform(0.5, 2.0);
    return osg::Matrixd::frustum(x - half * aspect, x + half * aspect, y - half, y + half, nearest, farthest);
}

}  // namespace

ViewSpec randomView(Random& random, const Description& description, int frame) {
    const Look look = anyLook(random, description, frame);
    double farthest = 0.0;
    for (const DatabaseSpec& database : description.databases)
        farthest =
            std::max(farthest, (look.eye - osg::Vec3d() * database.toWorld(frame)).length() + 2.0 * database.size());
    ViewSpec view;
    const osg::Vec3d along = look.center - look.eye;
    const bool isUpright = (along ^ look.up).length() > 0.01 * along.length() && random.chance(0.7);
    view.view = osg::Matrixd::lookAt(look.eye, look.center, isUpright ? look.up : vectorOf(random.direction()));
    view.projection = anyProjection(random, look, farthest);
    if (random.chance(0.3)) view.computeNearFar = osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES;
    const double mode = random.uniform();
    if (mode > 0.8) view.cullingMode = osg::CullSettings::VIEW_FRUSTUM_CULLING;
    if (mode > 0.88) view.cullingMode = osg::CullSettings::NO_CULLING;
    if (mode > 0.93) view.cullingMode = osg::CullSettings::DEFAULT_CULLING;
    view.smallFeaturePixels = random.logUniform(0.5, 20.0);
    return view;
}

ViewSpec nextView(Random& random, const ViewSpec& view) {
    double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0, nearest = 1.0, farthest = 0.0;
    (void)view.projection.getFrustum(left, right, bottom, top, nearest, farthest);
    // near planes are at a hundredth of the distance to the ground or to what is looked at
    const osg::Vec3d step = vectorOf(random.direction()) * std::abs(nearest) * random.logUniform(0.01, 20.0);
    const double turn = random.chance(0.5) ? 0.0 : random.logUniform(1e-4, 0.1);
    ViewSpec next = view;
    next.view = view.view * osg::Matrixd::translate(step) * osg::Matrixd::rotate(turn, vectorOf(random.direction()));
    return next;
}

}  // namespace osgAnalyticBin::test
