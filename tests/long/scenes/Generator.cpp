// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Parts.h"
#include "RandomScene.h"

namespace osgAnalyticBin::test {

namespace {

constexpr std::uint64_t kStream = 15;
constexpr std::uint64_t kApplicationStream = 16;
constexpr std::uint64_t kTrafficStream = 19;
constexpr double kTwoPi = 6.28318530717958647692;

/// Adds random parts to a description that has databases.
class PartMaker {
public:
    PartMaker(Random& random, Description& description, int frames)
        : _random(random), _description(description), _frames(frames) {}

    void addAll() {
        for (std::size_t i = 0; i < _description.databases.size(); ++i) {
            _number = static_cast<int>(i);
            addBetweenTiles();
            addInstances();
            addOnNodes();
            addModels();
            addEvents();
        }
        addCameras();
    }

private:
    [[nodiscard]] const DatabaseSpec& database() const { return _description.database(_number); }
    [[nodiscard]] int anyFrame() { return _random.integer(1, _frames); }
    [[nodiscard]] int anyLevel() { return _random.chance(0.6) ? 0 : _random.integer(0, 2); }

    Part& add(PartKind kind, Hook hook = Hook::Globe) {
        Part part;
        part.kind = kind;
        part.id = static_cast<int>(_description.parts.size());
        part.hook = hook;
        part.tile = randomTile(_random, database(), _number, anyLevel());
        _description.parts.push_back(part);
        return _description.parts.back();
    }
    Part& addEvent(PartKind kind, Hook hook = Hook::Globe) {
        Part& part = add(kind, hook);
        part.frame = anyFrame();
        return part;
    }

    void addBetweenTiles() {
        static constexpr std::array<PartKind, 8> kKinds{PartKind::Switch, PartKind::Sequence,   PartKind::Lod,
                                                        PartKind::Paged,  PartKind::Proxy,      PartKind::PlainGroup,
                                                        PartKind::Turned, PartKind::MovingTiles};
        for (int count = _random.integer(-1, 3); count > 0; --count) {
            const PartKind kind = _random.pick(kKinds);
            if (kind == PartKind::MovingTiles && _random.chance(0.6)) continue;
            Part& part = add(kind, Hook::Tile);
            // what moves below a tile is culled with it
            if (kind == PartKind::MovingTiles) part.tile = randomTile(_random, database(), _number, 0);
            part.variant = kind == PartKind::Switch ? _random.integer(0, 2) : _random.integer(0, 1);
            part.amount = _random.uniform(0.0, kTwoPi);
            if (kind == PartKind::MovingTiles) part.amount = _random.uniform(0.0, 3000.0);
            if (kind != PartKind::Switch) continue;
            Part toggle = part;
            toggle.kind = PartKind::Toggle;
            toggle.id = static_cast<int>(_description.parts.size());
            toggle.frame = anyFrame();
            if (_random.chance(0.6)) _description.parts.push_back(toggle);
        }
    }

    void addInstances() {
        if (!_random.chance(0.2) || database().shownColumns < 2) return;
        Part& part = add(PartKind::Instance, Hook::Tile);
        part.tile = randomTile(_random, database(), _number, 0);
        part.variant = (part.tile.column + _random.integer(1, database().shownColumns - 1)) % database().shownColumns;
    }

    void addOnNodes() {
        static constexpr std::array<Hook, 5> kHooks{Hook::Tile, Hook::Own, Hook::Mesh, Hook::Geode, Hook::Globe};
        if (_random.chance(0.25)) add(PartKind::CullingOff, _random.pick(kHooks));
        if (_random.chance(0.25)) {
            Part& part = add(PartKind::UserCull, _random.pick(kHooks));
            part.variant = _random.integer(0, 3);
            if (_random.chance(0.5)) part.frame = anyFrame();
        }
        if (_random.chance(0.1)) add(PartKind::UserUpdate, _random.pick(kHooks));
        if (_random.chance(0.04)) add(PartKind::DrawableBin, Hook::Geode);
        if (_random.chance(0.12)) {
            static constexpr std::array<Hook, 4> kAbove{Hook::Root, Hook::Globe, Hook::Globe, Hook::Tile};
            Part& part = add(PartKind::Outline, _random.pick(kAbove));
            part.variant = _random.chance(0.4) ? 0 : _random.integer(0, 11);
            if (_random.chance(0.5)) part.frame = anyFrame();
            if (!_random.chance(0.3)) return;
            Part& fill = add(PartKind::Fill, _random.pick(kAbove));
            fill.variant = 4 * _random.integer(0, 2);
            if (_random.chance(0.5)) fill.frame = anyFrame();
        }
    }

    void addModels() {
        const bool isTheme = _description.theme == Theme::Models;
        for (int count = isTheme ? _random.integer(2, 4) : _random.integer(0, 3); count > 0; --count) addModel();
    }

    void addModel() {
        static constexpr std::array<Hook, 8> kForTowers{Hook::Globe, Hook::Root, Hook::Own,  Hook::Own,
                                                        Hook::Mesh,  Hook::Slot, Hook::File, Hook::Geode};
        static constexpr std::array<Hook, 5> kForVehicles{Hook::Globe, Hook::Root, Hook::Slot, Hook::Slot, Hook::File};
        const bool isVehicle = _random.chance(0.4);
        Part& part = add(isVehicle ? PartKind::Vehicle : PartKind::Tower,
                         isVehicle ? _random.pick(kForVehicles) : _random.pick(kForTowers));
        const bool hasSlots = database().fileShape == FileShape::Slots && database().levels > 0;
        if (_description.theme == Theme::Models && hasSlots && _random.chance(0.6)) part.hook = Hook::Slot;
        const bool isInFile = part.hook == Hook::Slot || part.hook == Hook::File;
        // of the level that is seen
        if (part.hook == Hook::Own && _random.chance(0.7)) part.tile = randomTile(_random, database(), _number, 0);
        if (part.hook == Hook::Slot) part.tile = randomTile(_random, database(), _number, _random.chance(0.8) ? 1 : 2);
        if (_random.chance(0.65)) part.frame = anyFrame();
        if (_random.chance(0.2)) part.until = part.frame + _random.integer(1, 3);
        const Extents e = extentsOf(database(), part.tile);
        part.latitude = e.south + _random.uniform(0.2, 0.8) * (e.north - e.south);
        part.longitude = e.west + _random.uniform(0.2, 0.8) * (e.east - e.west);
        const bool isBelowTile = isInFile || part.tile.level > 0;
        // what a bin is stored for is in it
        const bool isBuiltIn = part.frame == 0 && database().storesBins;
        const double highest = (isBelowTile || isBuiltIn) && part.hook != Hook::Globe && part.hook != Hook::Root
                                   ? highestWithinBins(database())
                                   : 6e4 * (database().isMap ? 0.1 : database().scale());
        part.high = highest * _random.uniform(0.3, 1.0);
        part.low = isVehicle ? part.high * _random.uniform(0.7, 0.95) : -0.5 * database().relief;
        // a vehicle crosses a small part of its tile in the frames of a scene
        const double across = (e.north - e.south) * (database().isMap ? 1.0 : database().polar);
        if (isVehicle) part.amount = 0.01 * across * _random.uniform(0.0, 1.0);
        // a billboard that turns stays within its tile
        const bool isNarrow = part.high - part.low < 0.04 * across;
        if (isNarrow && !isBuiltIn && _random.chance(0.3)) part.variant = _random.integer(1, 3);
        // the heights of bins are scaled
        const bool isFlattened = database().mesh == MeshKind::Terrain;
        if (isBelowTile && isFlattened && part.hook != Hook::Globe && part.hook != Hook::Root)
            _description.parts.pop_back();
    }

    void addEvents() {
        if (_random.chance(0.15)) {
            Part& part = addEvent(PartKind::SetOptions);
            part.options = anyOptions();
        }
        const bool isScaled = _description.theme == Theme::ScaledTerrain;
        if (_random.chance(isScaled ? 0.8 : 0.25) && database().mesh == MeshKind::Terrain) {
            static constexpr std::array<double, 6> kScales{1.0, 3.0, 10.0, 10.0, 0.3, -2.0};
            Part& part = addEvent(PartKind::SetScale);
            part.amount = _random.pick(kScales);
        }
        if (_random.chance(0.15)) addEvent(PartKind::Expire, Hook::Tile);
        // what is paged below a tile would stay where it is
        if (database().levels == 0 && _random.chance(0.2)) {
            static constexpr std::array<Hook, 3> kHooks{Hook::Tile, Hook::Mesh, Hook::Mesh};
            Part& part = addEvent(PartKind::Shove, _random.pick(kHooks));
            part.amount =
                _random.chance(0.3) ? _random.uniform(0.0, kTwoPi) : _random.sign() * _random.logUniform(1e-6, 1.0);
        }
        if (_random.chance(0.05)) {
            Part& part = addEvent(PartKind::Move);
            part.amount = _random.uniform(-1e6, 1e6);
        }
        if (_number > 0) return;
        addEventsOnAll();
    }

    void addEventsOnAll() {
        const double more = _description.theme == Theme::ScaledTerrain ? 0.3 : 0.0;
        if (_random.chance(0.12 + more)) {
            Part& part = addEvent(PartKind::Clone);
            part.variant = _random.chance(0.6) ? 0 : _random.integer(1, 3);
        }
        if (_random.chance(0.1 + more)) {
            Part& part = addEvent(PartKind::SaveAndLoad);
            part.variant = _random.chance(0.2) ? 1 : 0;
        }
        if (_random.chance(0.25)) add(PartKind::Uninstall).frame = anyFrame();
        if (_random.chance(0.12)) {
            Part& part = addEvent(PartKind::Install);
            part.options = anyOptions();
        }
    }

    // They are for all databases of the scene: what they declare has to hold for each.
    CullOptions anyOptions() {
        CullOptions options = randomOptions(_random, database());
        if (_description.databases.size() > 1) {
            if (options.horizonUse == HorizonUse::Given) options.horizonUse = HorizonUse::Declared;
            options.heights = CullOptions::kTerrainOnEarth;
        }
        if (_random.chance(0.15)) options.method = Method::Sphere;
        return options;
    }

    void addCameras() {
        _number = 0;
        if (_random.chance(0.08)) {
            Part& part = add(PartKind::Again);
            const glm::dvec3 at = _random.direction() * 3.0 * database().equatorial;
            part.view = osg::Matrixd::translate(at.x, at.y, at.z);
        }
        if (!_random.chance(0.15)) return;
        Part& part = add(PartKind::Camera);
        part.variant = _random.integer(0, 2 * kFixedCameras - 1);
        const bool isRelative = part.variant % 3 == 0;
        const ViewSpec own = randomView(_random, _description, 1);
        part.view = isRelative ? osg::Matrixd::rotate(_random.uniform(-0.5, 0.5), osg::Vec3d(0.1, 1.0, 0.2)) : own.view;
        part.projection = isRelative ? osg::Matrixd::translate(_random.uniform(-1.0, 1.0), 0.0, 0.0) : own.projection;
    }

    Random& _random;
    Description& _description;
    const int _frames;
    int _number = 0;
};

// Plain groups with one mesh each, in files.
void chooseSlots(DatabaseSpec& database) {
    database.mesh = MeshKind::Local;
    database.fileShape = FileShape::Slots;
    database.levels = 1;
    database.storesBins = false;
    database.leavesArePaged = false;
}

// Many that one view shows.
void chooseSmallTiles(Random& random, DatabaseSpec& database) {
    database.columns = random.pick(std::array<int, 3>{16, 32, 64});
    const bool isWhole = database.columns == 16 && random.chance(0.5);
    database.shownColumns = isWhole ? database.columns : random.integer(5, 10);
    database.rows = isWhole ? database.columns / 2 : random.integer(4, 8);
    database.firstRow = isWhole ? 0 : random.integer(0, database.columns / 2 - database.rows);
}

void chooseTheme(Random& random, Description& description) {
    const double theme = random.uniform();
    DatabaseSpec& database = description.databases.front();
    if (theme < 0.2) {
        description.theme = Theme::Models;
        if (database.mesh == MeshKind::Terrain) database.mesh = MeshKind::Local;
        database.verticalScale = 1.0;
        database.levels = random.integer(0, 1);
        database.isLoaded = database.columns <= 8;
        if (random.chance(0.5)) chooseSlots(database);
    } else if (theme < 0.3 && !database.isMap) {
        description.theme = Theme::ScaledTerrain;
        database.mesh = MeshKind::Terrain;
        database.relief = random.uniform(2000.0, 5000.0) * database.scale();
        if (random.chance(0.5)) database.verticalScale = 10.0;
        if (database.options.horizonUse == HorizonUse::Given) database.options.horizonUse = HorizonUse::Declared;
        database.options.heights = CullOptions::kTerrainOnEarth;
    } else if (theme < (database.isMap ? 0.9 : 0.45)) {
        description.theme = Theme::Hills;
        if (database.mesh == MeshKind::Terrain) database.mesh = MeshKind::Local;
        if (!database.isMap) {
            // the smaller the globe, the higher its mountains are beside its radius
            database.equatorial = random.logUniform(2e3, 4e5);
            database.polar = database.equatorial * random.uniform(0.996, 1.004);
            chooseSmallTiles(random, database);
        }
        // wide enough for plates to stand in hills
        const double waveLength = database.tileWidth(0) * random.logUniform(1.0, 8.0);
        database.setWaveLength(waveLength);
        const double highest = 0.09 * database.size();
        const double unit = database.isMap ? 1.0 : database.size();
        database.relief = std::min(highest, 0.16 * waveLength * unit * random.logUniform(0.02, 0.7));
        database.posts = random.integer(9, 17);
        // the kit knows the surfaces of triangles alone
        database.hasQuads = random.chance(0.2);
        database.levels = std::min(database.levels, 1);
        database.verticalScale = 1.0;
        database.options.occlusion = OcclusionUse::On;
        database.options.heights = {-database.relief - 1.0, database.relief + 1.0};
        database.options.horizonUse = HorizonUse::Declared;
    }
}

void addTraffic(Random& random, Description& description, int frames) {
    if (!random.chance(description.theme == Theme::Hills ? 0.7 : 0.15)) return;
    static constexpr std::array<Hook, 3> kHooks{Hook::Globe, Hook::Root, Hook::Root};
    const DatabaseSpec& database = description.databases.front();
    Part part;
    part.kind = PartKind::Traffic;
    part.id = static_cast<int>(description.parts.size());
    part.hook = random.pick(kHooks);
    part.variant = random.integer(1, 1 << 20);
    part.amount = random.logUniform(0.02, 1.0) * std::max(database.relief, 1e-4 * database.size());
    if (random.chance(0.5)) part.frame = random.integer(1, frames);
    description.parts.push_back(part);
}

}  // namespace

Description randomDescription(std::uint64_t seed) {
    Random random(kStream, seed);
    Description description;
    description.seed = seed;
    const int databases = random.chance(0.12) ? 2 : 1;
    for (int i = 0; i < databases; ++i) description.databases.push_back(randomDatabase(random, i));
    chooseTheme(random, description);
    const int frames = random.integer(3, 6);
    // terrain with gaps hides nothing
    if (description.theme != Theme::Hills || random.chance(0.4)) PartMaker(random, description, frames).addAll();
    Random ofApplication(kApplicationStream, seed);
    if (ofApplication.chance(0.5)) addApplication(ofApplication, description, frames);
    addPick(ofApplication, description, frames);
    for (int frame = 1; frame <= frames; ++frame) {
        // what terrain hides is kept from view to view
        const bool isFlight = frame > 1 && description.theme == Theme::Hills && random.chance(0.6);
        description.views.push_back(isFlight ? nextView(random, description.views.back())
                                             : randomView(random, description, frame));
    }
    // views do not depend on it
    Random ofTraffic(kTrafficStream, seed);
    addTraffic(ofTraffic, description, frames);
    return description;
}

}  // namespace osgAnalyticBin::test
