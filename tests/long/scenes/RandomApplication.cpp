// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Parts.h"
#include "RandomScene.h"

#include <osg/StateAttribute>

namespace osgAnalyticBin::test {

namespace {

using Attribute = osg::StateAttribute;

/// Adds parts of one subject after the other.
class ApplicationMaker {
public:
    ApplicationMaker(Random& random, Description& description, int frames)
        : _random(random), _description(description), _frames(frames) {}

    void addSubject() {
        using Subject = void (ApplicationMaker::*)();
        static constexpr std::array<Subject, 16> kSubjects{
            &ApplicationMaker::addMeshes,    &ApplicationMaker::addMeshes,   &ApplicationMaker::addStates,
            &ApplicationMaker::addStates,    &ApplicationMaker::addFacing,   &ApplicationMaker::addCullCallbacks,
            &ApplicationMaker::addBounds,    &ApplicationMaker::addDrawable, &ApplicationMaker::addCasters,
            &ApplicationMaker::addFiles,     &ApplicationMaker::addSigns,    &ApplicationMaker::addRaise,
            &ApplicationMaker::addGroupTree, &ApplicationMaker::addVanish,   &ApplicationMaker::addUnculled,
            &ApplicationMaker::addVanish};
        _number = _random.integer(0, static_cast<int>(_description.databases.size()) - 1);
        _tile = randomTile(_random, database(), _number, anyLevel());
        (this->*_random.pick(kSubjects))();
    }

    void addPick() {
        _number = _random.integer(0, static_cast<int>(_description.databases.size()) - 1);
        _tile = randomTile(_random, database(), _number, 0);
        Part& part = add(PartKind::Pick, Hook::Root);
        part.frame = _random.integer(1, _frames);
        placeInTile(part);
        part.high = 0.2 * database().size();
        part.low = -part.high;
    }

private:
    [[nodiscard]] const DatabaseSpec& database() const { return _description.database(_number); }
    [[nodiscard]] int anyLevel() { return _random.chance(0.7) ? 0 : _random.integer(0, 2); }
    /// From the beginning as often as later.
    [[nodiscard]] int anyFrame() { return _random.chance(0.5) ? 0 : _random.integer(1, _frames); }
    [[nodiscard]] bool hasTerrain() const { return database().mesh == MeshKind::Terrain; }

    Part& add(PartKind kind, Hook hook) {
        Part part;
        part.kind = kind;
        part.id = static_cast<int>(_description.parts.size());
        part.hook = hook;
        part.tile = _tile;
        if (hook == Hook::Above) part.tile = TileKey{_number, -1, _tile.column / 2, _tile.row / 2};
        _description.parts.push_back(part);
        return _description.parts.back();
    }

    void placeInTile(Part& part) {
        const Extents e = extentsOf(database(), _tile);
        part.latitude = e.south + _random.uniform(0.3, 0.7) * (e.north - e.south);
        part.longitude = e.west + _random.uniform(0.3, 0.7) * (e.east - e.west);
    }

    // Scenes that are saved lose what only this program knows.
    void drop(PartKind kind) {
        std::vector<Part>& parts = _description.parts;
        const auto isIt = [&](const Part& part) { return part.kind == kind; };
        parts.erase(std::remove_if(parts.begin(), parts.end(), isIt), parts.end());
    }

    // Own meshes, or those that a LOD in the file or a file has in their place.
    void addMeshes() {
        const bool isFiner = _random.chance(0.3);
        const bool isWhole = database().fileShape == FileShape::Whole && database().levels > 0;
        if (isFiner && !isWhole) {
            static constexpr std::array<PartKind, 3> kAbove{PartKind::Lod, PartKind::Lod, PartKind::Switch};
            Part& above = add(_random.pick(kAbove), Hook::Tile);
            above.amount = _random.logUniform(0.5, 20.0);
            above.variant = above.kind == PartKind::Switch ? 1 : 0;
        }
        const Hook hook = isFiner ? Hook::File : Hook::Drawable;
        const double kind = _random.uniform();
        if (kind < 0.25) {
            Part& part = add(PartKind::NarrowTile, hook);
            part.amount = _random.logUniform(1e-4, 0.6);
            return;
        }
        if (hasTerrain()) return;
        if (kind < 0.35) {
            add(PartKind::DrawsNothing, hook);
        } else if (kind < 0.5) {
            Part& part = add(PartKind::ReversedFaces, hook);
            if (hook == Hook::Drawable) part.frame = anyFrame();
            if (!_random.chance(0.7)) return;
            addState("cull face BACK", anyHook(), Attribute::ON).frame = anyFrame();
        } else {
            Part& part = add(PartKind::MeshHole, hook);
            part.variant = _random.integer(0, kHoles - 1);
            if (hook == Hook::Drawable && _random.chance(0.3)) part.frame = anyFrame();
        }
    }

    Part& addState(const std::string& name, Hook hook, unsigned int value) {
        Part& part = add(PartKind::State, hook);
        part.variant = stateOf(name);
        part.value = value;
        return part;
    }

    [[nodiscard]] Hook anyHook() {
        static constexpr std::array<Hook, 11> kHooks{Hook::View,  Hook::Root,     Hook::Place, Hook::Globe,
                                                     Hook::Tile,  Hook::Tile,     Hook::Own,   Hook::Mesh,
                                                     Hook::Geode, Hook::Drawable, Hook::File};
        return _random.pick(kHooks);
    }

    [[nodiscard]] unsigned int anyValue() {
        static constexpr std::array<unsigned int, 6> kValues{Attribute::ON,
                                                             Attribute::ON,
                                                             Attribute::ON | Attribute::OVERRIDE,
                                                             Attribute::ON | Attribute::PROTECTED,
                                                             Attribute::OFF,
                                                             Attribute::OFF | Attribute::OVERRIDE};
        return _random.pick(kValues);
    }

    void addStates() {
        for (int count = _random.integer(1, 2); count > 0; --count) {
            Part& part = add(PartKind::State, anyHook());
            part.variant = _random.integer(0, stateCount() - 1);
            part.value = anyValue();
            part.frame = anyFrame();
            // assembly programs are in force where there are none of GLSL
            if (stateName(part.variant).rfind("ARB", 0) != 0) continue;
            const Hook hook = part.hook;
            const int frame = part.frame;
            addState("no program", hook, Attribute::ON).frame = frame;
        }
    }

    // What faces are culled is said in several places.
    void addFacing() {
        const double kind = _random.uniform();
        const Hook some = anyHook(), other = anyHook();
        const int frame = anyFrame();
        if (kind < 0.4) {
            addState("cull face FRONT without its mode", some, anyValue()).frame = frame;
            addState("cull face mode alone", other, Attribute::ON).frame = anyFrame();
        } else if (kind < 0.8) {
            addState("front face CLOCKWISE", some, anyValue()).frame = frame;
            addState("cull face BACK", other, Attribute::ON).frame = anyFrame();
            if (_random.chance(0.5)) addState("front face COUNTER CLOCKWISE", anyHook(), Attribute::ON);
        } else {
            addState("cull face FRONT", some, Attribute::ON).frame = frame;
            addState("cull face mode alone", other, anyValue()).frame = anyFrame();
        }
    }

    void addCullCallbacks() {
        static constexpr std::array<Hook, 9> kHooks{Hook::Root, Hook::Globe, Hook::Globe, Hook::Tile, Hook::Own,
                                                    Hook::Mesh, Hook::Geode, Hook::File,  Hook::Place};
        static constexpr std::array<PartKind, 4> kKinds{PartKind::LeavesOut, PartKind::PushesState, PartKind::Masks,
                                                        PartKind::OneShot};
        Part& part = add(_random.pick(kKinds), _random.pick(kHooks));
        part.frame = anyFrame();
        part.variant = _random.integer(0, 40);
        if (part.kind != PartKind::PushesState) return;
        part.variant = _random.integer(0, stateCount() - 1);
        part.value = anyValue();
    }

    // A tower of which the bound callback may keep the kit from hearing.
    void addBounds() {
        static constexpr std::array<Hook, 8> kHooks{Hook::Tile,  Hook::Own,   Hook::Mesh, Hook::Geode,
                                                    Hook::Globe, Hook::Above, Hook::File, Hook::Slot};
        drop(PartKind::SaveAndLoad);
        if (_random.chance(0.3)) addGroupTree();
        const bool isCleared = _random.chance(0.4);
        const int frame = isCleared ? _random.integer(1, _frames) : anyFrame();
        if (!isCleared || _random.chance(0.3)) {
            Part& bound = add(PartKind::BoundCallback, _random.pick(kHooks));
            bound.frame = frame;
            if (bound.hook == Hook::Tile) bound.variant = _random.integer(0, 3);
            // what has a false sphere is not to be culled
            if (bound.variant > 0) add(PartKind::CullingOff, Hook::Tile).frame = frame;
        }
        if (isCleared) add(PartKind::NoBoundCallback, _random.pick(kHooks)).frame = frame;
        if (hasTerrain() || database().storesBins || _tile.level > 0) return;
        Part& tower = add(PartKind::Tower, _random.chance(0.5) ? Hook::Own : Hook::Geode);
        tower.frame = _random.integer(std::max(1, frame), _frames);
        placeInTile(tower);
        tower.low = -0.5 * database().relief;
        tower.high = 6e4 * (database().isMap ? 0.1 : database().scale()) * _random.uniform(0.3, 1.0);
    }

    void addDrawable() {
        static constexpr std::array<PartKind, 4> kKinds{PartKind::DrawableCull, PartKind::DrawableDraw,
                                                        PartKind::DrawableUpdate, PartKind::DrawableBound};
        drop(PartKind::SaveAndLoad);
        Part& part = add(_random.pick(kKinds), Hook::Drawable);
        part.variant = _random.integer(0, 1);
        part.frame = anyFrame();
    }

    void addCasters() {
        for (int count = _random.integer(1, 3); count > 0; --count) {
            _tile = randomTile(_random, database(), _number, _random.integer(0, 2));
            add(PartKind::Caster, _random.chance(0.5) ? Hook::Tile : Hook::Mesh);
        }
    }

    void addFiles() {
        const double kind = _random.uniform();
        if (kind < 0.35 && database().levels > 0) {
            drop(PartKind::SaveAndLoad);
            add(PartKind::EqualNames, Hook::Globe);
            return;
        }
        const bool isAdding = kind < 0.7 && database().levels > 0;
        static constexpr std::array<Hook, 4> kHooks{Hook::Own, Hook::Globe, Hook::File, Hook::Slot};
        if (isAdding) _tile = randomTile(_random, database(), _number, _random.integer(0, database().levels - 1));
        Part& part = add(isAdding ? PartKind::Adding : PartKind::Objects, isAdding ? Hook::Tile : _random.pick(kHooks));
        if (isAdding) part.variant = _random.integer(0, 2);
        if (part.hook == Hook::Slot) part.tile = _tile = randomTile(_random, database(), _number, 1);
        if (part.kind == PartKind::Objects) part.frame = anyFrame();
        placeInTile(part);
        part.high = 0.5 * highestWithinBins(database());
        part.low = -0.5 * database().relief;
        const double width = database().tileWidth(part.tile.level) * (database().isMap ? 1.0 : database().equatorial);
        part.amount = width * _random.logUniform(0.5, 5.0);
    }

    // As wide as stays within bins where the ground is curved.
    void addSigns() {
        static constexpr std::array<Hook, 5> kHooks{Hook::Own, Hook::Mesh, Hook::Geode, Hook::Slot, Hook::File};
        for (int count = _random.integer(1, 3); count > 0; --count) {
            _tile = randomTile(_random, database(), _number, anyLevel());
            Part& part = add(PartKind::Sign, _random.pick(kHooks));
            if (part.hook == Hook::Slot) part.tile = _tile = randomTile(_random, database(), _number, 1);
            part.frame = anyFrame();
            part.variant = _random.integer(0, 3);
            placeInTile(part);
            part.high = 0.7 * highestWithinBins(database());
            part.low = 0.0;
            const double width = database().tileWidth(part.tile.level) * (database().isMap ? 1.0 : database().polar);
            part.amount = std::min(0.1 * width, std::sqrt(0.3 * part.high * database().size()));
            if (hasTerrain() && (part.hook != Hook::Own || part.tile.level > 0)) _description.parts.pop_back();
        }
    }

    // Models that belong to one tile and stand on another.
    void addUnculled() {
        static constexpr std::array<Hook, 5> kHooks{Hook::Own, Hook::Mesh, Hook::Geode, Hook::Slot, Hook::File};
        Part& part = add(PartKind::Unculled, _random.pick(kHooks));
        if (part.hook == Hook::Slot) part.tile = randomTile(_random, database(), _number, 1);
        part.frame = anyFrame();
        _tile = randomTile(_random, database(), _number, anyLevel());
        placeInTile(part);
        part.high = highestWithinBins(database()) + 6e4 * (database().isMap ? 0.1 : database().scale());
        part.low = 0.0;
        if (hasTerrain() && (part.hook != Hook::Own || part.tile.level > 0)) _description.parts.pop_back();
    }

    void addRaise() {
        // what a bin is stored or declared for stays in it
        const bool isDeclared = database().options.heights.upper != CullOptions::kTerrainOnEarth.upper;
        if (hasTerrain() || database().storesBins || isDeclared) return;
        Part& part = add(PartKind::Raise, Hook::Drawable);
        part.frame = _random.integer(1, _frames);
        const double highest = part.tile.level > 0 ? highestWithinBins(database()) - database().relief
                                                   : 3e4 * (database().isMap ? 0.1 : database().scale());
        part.amount = _random.sign() * _random.uniform(0.0, highest);
    }

    void addGroupTree() {
        Part& part = add(PartKind::GroupTree, Hook::Globe);
        part.variant = _random.integer(1, 3);
        if (_random.chance(0.5)) part.amount = _random.integer(1, kGroupClasses - 1);
        const double more = _random.uniform();
        if (more < 0.3) {
            Part& state = add(PartKind::State, Hook::Above);
            state.variant = _random.integer(0, stateCount() - 1);
            state.value = anyValue();
            state.frame = anyFrame();
        } else if (more < 0.6) {
            Part& callback = add(_random.chance(0.5) ? PartKind::LeavesOut : PartKind::OneShot, Hook::Above);
            callback.frame = anyFrame();
            callback.variant = _random.integer(0, 3);
        }
    }

    // Tiles, parts of them, and groups above them.
    void addVanish() {
        static constexpr std::array<Hook, 8> kHooks{Hook::Tile,     Hook::Tile,  Hook::Own,  Hook::Mesh,
                                                    Hook::Drawable, Hook::Above, Hook::Slot, Hook::File};
        const Hook hook = _random.pick(kHooks);
        if (hook == Hook::Above || _random.chance(0.3)) addGroupTree();
        Part& part = add(PartKind::Vanish, hook);
        part.frame = _random.integer(1, _frames);
        part.variant = _random.integer(0, 3);
    }

    Random& _random;
    Description& _description;
    const int _frames;
    int _number = 0;
    TileKey _tile;
};

}  // namespace

void addApplication(Random& random, Description& description, int frames) {
    // the fewer other parts there are, the more is hidden
    if (random.chance(0.5)) description.parts.clear();
    // who gives a horizon vouches for terrain without holes
    const auto vouchForNothing = [](CullOptions& options) {
        if (options.horizonUse == HorizonUse::Given) options.horizonUse = HorizonUse::Declared;
    };
    for (DatabaseSpec& database : description.databases) vouchForNothing(database.options);
    for (Part& part : description.parts) vouchForNothing(part.options);
    for (int count = random.integer(1, 2); count > 0; --count)
        ApplicationMaker(random, description, frames).addSubject();
}

void addPick(Random& random, Description& description, int frames) {
    ApplicationMaker(random, description, frames).addPick();
}

}  // namespace osgAnalyticBin::test
