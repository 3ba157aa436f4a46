// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Parts.h"
#include "RandomScene.h"

namespace osgAnalyticBin::test {

namespace {

void chooseRadii(Random& random, DatabaseSpec& database) {
    struct Radii {
        double equatorial, polar;
    };
    static constexpr std::array<Radii, 5> kOthers{{{6371000.0, 6371000.0},
                                                   {1738100.0, 1736000.0},
                                                   {60268000.0, 54364000.0},
                                                   {6000000.0, 6300000.0},
                                                   {6378137.0, 5000000.0}}};
    if (random.chance(0.7)) return;
    const Radii& radii = random.pick(kOthers);
    database.equatorial = radii.equatorial;
    database.polar = radii.polar;
}

// Between two parallels.
void chooseRegion(Random& random, DatabaseSpec& database) {
    database.columns = random.pick(std::array<int, 4>{8, 16, 32, 64});
    database.shownColumns = random.integer(1, 6);
    database.rows = random.integer(1, 4);
    database.firstRow = random.integer(0, database.columns / 2 - database.rows);
}

void chooseTiles(Random& random, DatabaseSpec& database) {
    static constexpr std::array<int, 5> kColumns{4, 8, 8, 8, 16};
    static constexpr std::array<int, 5> kLevels{0, 0, 1, 1, 2};
    database.columns = random.pick(kColumns);
    database.rows = database.columns / 2;
    database.levels = database.columns == 16 ? random.integer(0, 1) : random.pick(kLevels);
    database.shownColumns = random.chance(0.93) ? database.columns : random.integer(1, database.columns);
    if (random.chance(0.15)) chooseRegion(random, database);
    database.posts = random.integer(3, 5);
    const double kind = random.uniform();
    database.mesh = kind < 0.5 ? MeshKind::Local : kind < 0.7 ? MeshKind::Ecef : MeshKind::Terrain;
    const double shape = random.uniform();
    database.fileShape = shape < 0.4 ? FileShape::Tiles : shape < 0.85 ? FileShape::Slots : FileShape::Whole;
    database.storesBins = random.chance(0.3);
    database.groupsLeaves = random.chance(database.mesh == MeshKind::Terrain ? 0.1 : 0.5);
    database.hasSkirts = random.chance(0.75);
    database.isLoaded = random.chance(0.3) && database.columns << database.levels <= 16;
    database.leavesArePaged = random.chance(0.25);
    database.requestsBins = random.chance(0.15);
    database.range = random.uniform(1.0, 6.0);
}

void chooseScale(Random& random, DatabaseSpec& database) {
    static constexpr std::array<double, 5> kScales{2.0, 10.0, 10.0, 0.5, -1.0};
    if (database.mesh == MeshKind::Terrain && random.chance(0.4)) database.verticalScale = random.pick(kScales);
}

void makeMap(Random& random, DatabaseSpec& database) {
    database.isMap = true;
    database.columns = random.integer(2, 6);
    database.rows = random.integer(2, 6);
    database.shownColumns = database.columns;
    database.firstRow = 0;
    database.storesBins = false;
}

}  // namespace

DatabaseSpec randomDatabase(Random& random, int number) {
    DatabaseSpec database;
    chooseTiles(random, database);
    if (random.chance(0.06))
        makeMap(random, database);
    else
        chooseRadii(random, database);
    database.relief = random.logUniform(10.0, 5000.0) * (database.isMap ? 0.5 : database.scale());
    chooseScale(random, database);
    if (number > 0 || random.chance(0.2)) {
        const glm::dvec3 at = random.direction() * (number * 4.0 + random.uniform()) * 6.4e6;
        database.position.set(at.x, at.y, at.z);
        if (random.chance(0.5)) database.turn = random.uniform(0.0, 6.0);
    }
    if (random.chance(0.1)) {
        const glm::dvec3 step = random.direction() * random.logUniform(1.0, 1e6);
        database.drift.set(step.x, step.y, step.z);
    }
    database.options = randomOptions(random, database);
    return database;
}

CullOptions randomOptions(Random& random, const DatabaseSpec& database) {
    CullOptions options;
    const double method = random.uniform();
    options.method = method < 0.7 ? Method::Quadratic : method < 0.96 ? Method::Exact : Method::None;
    const double horizon = random.uniform();
    const bool isFixed = database.mesh != MeshKind::Terrain && database.isWhole();
    if (horizon > 0.95) options.horizonUse = HorizonUse::Off;
    if (horizon > 0.85 && horizon < 0.95 && isFixed) {
        options.horizonUse = HorizonUse::Given;
        options.horizon = -database.relief - sagOf(database, 0) - 1.0;
    }
    options.inheritViewpoint = random.chance(0.1);
    if (random.chance(0.15)) options.edges = random.chance(0.5);
    options.occlusion = random.pick(
        std::array<OcclusionUse, 4>{OcclusionUse::Off, OcclusionUse::On, OcclusionUse::On, OcclusionUse::Auto});
    if (random.chance(0.3)) options.expiry = random.uniform(0.0, 5.0);
    if (random.chance(0.3))
        options.heights = {-database.relief - 1.0, database.relief + 4000.0 * std::max(1.0, database.scale())};
    return options;
}

TileKey randomTile(Random& random, const DatabaseSpec& database, int number, int level) {
    const int finest = database.fileShape == FileShape::Whole ? 0 : database.levels;
    const int used = std::clamp(level, 0, finest);
    return {number, used, random.integer(0, (database.shownColumns << used) - 1),
            random.integer(0, (database.rows << used) - 1)};
}

double highestWithinBins(const DatabaseSpec& database) {
    if (database.storesBins) return 0.95 * database.relief;
    const double scale = database.isMap ? 1.0 : std::max(1.0, database.scale());
    return std::min(database.relief + 3500.0 * scale, 8500.0 * scale);
}

}  // namespace osgAnalyticBin::test
