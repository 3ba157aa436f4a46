// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SceneText.h"

#include "Parts.h"

#include <charconv>

namespace osgAnalyticBin::test {

namespace {

using Words = std::vector<const char*>;

// In the order of the enumerators.
const Words& wordsOf(PartKind) {
    static const Words words{// built in
                             "switch", "sequence", "lod", "paged", "proxy", "group", "turned", "instance", "again",
                             "moving-tiles", "caster", "group-tree",
                             // what tiles draw, and files hold
                             "hole", "reversed-faces", "narrow", "draws-nothing", "adding", "objects", "equal-names",
                             // on nodes
                             "culling-off", "user-cull", "user-update", "drawable-bin", "outline", "fill", "state",
                             "leaves-out", "pushes-state", "masks", "meddles", "vanish", "one-shot", "bound",
                             "no-bound", "drawable-cull", "drawable-draw", "drawable-update", "drawable-bound", "raise",
                             // models, cameras
                             "tower", "vehicle", "sign", "unculled", "traffic", "camera", "pick",
                             // events
                             "toggle", "set-options", "install", "uninstall", "set-scale", "clone", "save-and-load",
                             "expire", "move", "shove", "tile-data"};
    return words;
}
const Words& wordsOf(Theme) {
    static const Words words{"anything", "models", "scaled", "hills"};
    return words;
}
const Words& wordsOf(MeshKind) {
    static const Words words{"local", "ecef", "terrain"};
    return words;
}
const Words& wordsOf(FileShape) {
    static const Words words{"tiles", "slots", "whole"};
    return words;
}
const Words& wordsOf(Hook) {
    return hookWords();
}

[[noreturn]] void refuse(const std::string& text) {
    throw std::runtime_error("cannot read \"" + text + '"');
}

template <class Number>
std::enable_if_t<std::is_arithmetic_v<Number>, std::string> write(Number value) {
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}
template <class Number>
std::enable_if_t<std::is_arithmetic_v<Number>> read(const std::string& text, Number& value) {
    const char* const end = text.data() + text.size();
    if (const auto result = std::from_chars(text.data(), end, value); result.ptr != end) refuse(text);
}

std::string write(bool value) {
    return value ? "1" : "0";
}
void read(const std::string& text, bool& value) {
    value = text == "1";
    if (!value && text != "0") refuse(text);
}

template <class Enum>
std::enable_if_t<std::is_enum_v<Enum>, std::string> write(Enum value) {
    return wordsOf(value)[static_cast<std::size_t>(value)];
}
template <class Enum>
std::enable_if_t<std::is_enum_v<Enum>> read(const std::string& text, Enum& value) {
    const Words& words = wordsOf(value);
    const auto found = std::find(words.begin(), words.end(), text);
    if (found == words.end()) refuse(text);
    value = static_cast<Enum>(found - words.begin());
}

std::string write(const double* numbers, std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text += (i > 0 ? "," : "") + write(numbers[i]);
    return text;
}
void read(const std::string& text, double* numbers, std::size_t count) {
    std::istringstream in(text);
    std::string number;
    for (std::size_t i = 0; i < count; ++i) {
        if (!std::getline(in, number, ',')) refuse(text);
        read(number, numbers[i]);
    }
    if (!in.eof()) refuse(text);
}

using Sides = std::array<double, 6>;  // left, right, bottom, top, near, far

std::string write(const Sides& sides) {
    return write(sides.data(), sides.size());
}
void read(const std::string& text, Sides& sides) {
    read(text, sides.data(), sides.size());
}
std::string write(const osg::Vec3d& vector) {
    return write(vector.ptr(), 3);
}
void read(const std::string& text, osg::Vec3d& vector) {
    read(text, vector.ptr(), 3);
}
std::string write(const osg::Matrixd& matrix) {
    return write(matrix.ptr(), 16);
}
void read(const std::string& text, osg::Matrixd& matrix) {
    read(text, matrix.ptr(), 16);
}

std::string write(const TileKey& tile) {
    return tile.text();
}
void read(const std::string& text, TileKey& tile) {
    char point = 0;
    std::istringstream in(text);
    in >> tile.database >> point >> tile.level >> point >> tile.column >> point >> tile.row;
    if (!in) refuse(text);
}

std::string write(const CullOptions& options) {
    std::string text = osgAnalyticBin::toText(options);
    std::replace(text.begin(), text.end(), ' ', ',');
    return text;
}
void read(const std::string& text, CullOptions& options) {
    std::string error;
    const auto found = cullOptionsFromText(text, error);
    if (!found) throw std::runtime_error(error);
    options = *found;
}

/// A state by its name, without blanks.
struct StateName {
    int& number;
};
std::string write(const StateName& state) {
    std::string text = stateName(state.number);
    std::replace(text.begin(), text.end(), ' ', '-');
    return text;
}
void read(const std::string& text, const StateName& state) {
    for (state.number = 0; state.number < stateCount(); ++state.number)
        if (write(state) == text) return;
    refuse(text);
}

/// The position and the frustum of a view's camera.
struct Gaze {
    osg::Vec3d eye, at, up;
    Sides frustum{}, ortho{};
};

template <class Table>
void eachField(Table& table, DatabaseSpec& d) {
    table("equatorial", d.equatorial);
    table("polar", d.polar);
    table("map", d.isMap);
    table("columns", d.columns);
    table("rows", d.rows);
    table("shown", d.shownColumns);
    table("firstrow", d.firstRow);
    table("levels", d.levels);
    table("posts", d.posts);
    table("mesh", d.mesh);
    table("files", d.fileShape);
    table("stored", d.storesBins);
    table("groups", d.groupsLeaves);
    table("skirts", d.hasSkirts);
    table("quads", d.hasQuads);
    table("loaded", d.isLoaded);
    table("leavespaged", d.leavesArePaged);
    table("requested", d.requestsBins);
    table("relief", d.relief);
    table("waves", d.waves);
    table("scale", d.verticalScale);
    table("range", d.range);
    table("options", d.options);
    table("position", d.position);
    table("turn", d.turn);
    table("drift", d.drift);
}

template <class Table>
void eachField(Table& table, Part& part) {
    table("id", part.id);
    table("frame", part.frame);
    table("until", part.until);
    table("late", part.isLate);
    table("hook", part.hook);
    table("tile", part.tile);
    StateName state{part.variant};
    if (part.kind == PartKind::State || part.kind == PartKind::PushesState)
        table("state", state);
    else
        table("variant", part.variant);
    table("value", part.value);
    table("latitude", part.latitude);
    table("longitude", part.longitude);
    table("low", part.low);
    table("high", part.high);
    table("amount", part.amount);
    table("asks", part.asks);
    table("view", part.view);
    table("projection", part.projection);
    table("options", part.options);
}

template <class Table>
void eachField(Table& table, ViewSpec& view) {
    int mode = view.cullingMode, nearFar = view.computeNearFar;
    Gaze look;
    view.view.getLookAt(look.eye, look.at, look.up);
    Sides& f = look.frustum;
    Sides& o = look.ortho;
    const osg::Matrixd& projection = view.projection;
    if (!projection.getFrustum(f[0], f[1], f[2], f[3], f[4], f[5]) && !projection.isIdentity())
        (void)projection.getOrtho(o[0], o[1], o[2], o[3], o[4], o[5]);
    table("active", view.isActive);
    table("eye", look.eye);
    table("at", look.at);
    table("up", look.up);
    table("frustum", f);
    table("ortho", o);
    table("mode", mode);
    table("nearfar", nearFar);
    table("pixels", view.smallFeaturePixels);
    table("tilebytile", view.isTileByTile);
    view.cullingMode = mode;
    view.computeNearFar = static_cast<osg::CullSettings::ComputeNearFarMode>(nearFar);
    if (look.at != look.eye) view.view = osg::Matrixd::lookAt(look.eye, look.at, look.up);
    if (f[5] > 0.0) view.projection = osg::Matrixd::frustum(f[0], f[1], f[2], f[3], f[4], f[5]);
    if (o[1] > o[0]) view.projection = osg::Matrixd::ortho(o[0], o[1], o[2], o[3], o[4], o[5]);
}

template <class Table>
void eachField(Table& table, Description& description) {
    table("seed", description.seed);
    table("theme", description.theme);
    table("bins", description.hasBins);
}

template <class Table>
void eachField(Table& table, Expectation& expectation) {
    table("spheres", expectation.spheres);
    table("bins", expectation.bins);
    table("culled", expectation.culled);
}

struct Writing {
    template <class Value>
    void operator()(const char* name, const Value& value) {
        fields.emplace_back(name, write(value));
    }
    std::vector<std::pair<std::string, std::string>> fields;
};

struct Reading {
    template <class Value>
    void operator()(const char* name, Value& value) {
        const auto given = fields.find(name);
        if (given == fields.end()) return;
        read(given->second, value);
        fields.erase(given);
    }
    std::map<std::string, std::string> fields;
};

/// The fields in which a thing differs from a plain one.
template <class Thing>
std::string line(const std::string& word, Thing thing, Thing plain) {
    Writing own, other;
    eachField(own, thing);
    eachField(other, plain);
    std::string text = word;
    for (std::size_t i = 0; i < own.fields.size(); ++i)
        if (own.fields[i] != other.fields[i]) text += ' ' + own.fields[i].first + '=' + own.fields[i].second;
    return text;
}

template <class Thing>
Thing readFields(Reading& reading, Thing thing) {
    eachField(reading, thing);
    if (!reading.fields.empty()) refuse(reading.fields.begin()->first);
    return thing;
}

template <class Thing>
std::vector<Thing> simplerThan(Thing thing, Thing plain) {
    Writing own, other;
    eachField(own, thing);
    eachField(other, plain);
    std::vector<Thing> found;
    for (std::size_t i = 0; i < own.fields.size(); ++i) {
        const auto& [name, text] = own.fields[i];
        if (own.fields[i] == other.fields[i]) continue;
        std::vector<std::string> texts{other.fields[i].second};
        for (std::size_t at = 0, end = 0; name == "options" && end != std::string::npos; at = end + 1) {
            end = text.find(',', at);
            texts.push_back(text.substr(0, at) + (end == std::string::npos ? "" : text.substr(end + 1)));
        }
        for (const std::string& simpler : texts) {
            Reading reading;
            reading.fields[name] = simpler;
            found.push_back(readFields(reading, thing));
        }
    }
    return found;
}

Part plainPart(PartKind kind, std::size_t number) {
    Part part;
    part.kind = kind;
    part.id = static_cast<int>(number);
    return part;
}

void readLine(const std::string& text, NamedScene& scene) {
    std::istringstream in(text);
    std::string word, field;
    if (!(in >> word) || word.front() == '#') return;
    Reading reading;
    while (in >> field) {
        const std::size_t end = field.find('=');
        if (end == std::string::npos) refuse(field);
        reading.fields[field.substr(0, end)] = field.substr(end + 1);
    }
    Description& description = scene.description;
    if (word == "scene") {
        description = readFields(reading, description);
    } else if (word == "database") {
        description.databases.push_back(readFields(reading, DatabaseSpec()));
    } else if (word == "view") {
        const ViewSpec before = description.views.empty() ? ViewSpec() : description.views.back();
        description.views.push_back(readFields(reading, before));
    } else if (word == "expect") {
        scene.expected = readFields(reading, Expectation());
    } else {
        PartKind kind{};
        read(word, kind);
        description.parts.push_back(readFields(reading, plainPart(kind, description.parts.size())));
    }
}

// The text once for each combination of the values that bars separate.
std::vector<std::string> alternatives(const std::string& text) {
    const std::size_t bar = text.find('|');
    if (bar == std::string::npos) return {text};
    const std::size_t begin = text.find_last_of("= \n", bar) + 1, end = text.find_first_of(" \n", bar);
    std::istringstream values(text.substr(begin, end - begin));
    std::vector<std::string> all;
    std::string value;
    while (std::getline(values, value, '|'))
        for (const std::string& one : alternatives(text.substr(0, begin) + value + text.substr(end)))
            all.push_back(one);
    return all;
}

}  // namespace

std::vector<NamedScene> readScenes(std::istream& in) {
    std::ostringstream all;
    all << in.rdbuf();
    std::vector<NamedScene> scenes;
    for (const std::string& text : alternatives(all.str())) {
        NamedScene& scene = scenes.emplace_back();
        std::istringstream lines(text);
        std::string line;
        while (std::getline(lines, line)) {
            try {
                readLine(line, scene);
            } catch (const std::runtime_error& error) {
                throw std::runtime_error(std::string(error.what()) + " in: " + line);
            }
        }
    }
    return scenes;
}

std::vector<Part> simpler(const Part& part) {
    return simplerThan(part, plainPart(part.kind, static_cast<std::size_t>(part.id)));
}

std::vector<DatabaseSpec> simpler(const DatabaseSpec& database) {
    return simplerThan(database, DatabaseSpec());
}

std::string toText(const Part& part) {
    return line(write(part.kind), part, plainPart(part.kind, 0));
}

std::string toText(const Description& description) {
    std::string text = line("scene", description, Description()) + '\n';
    for (const DatabaseSpec& database : description.databases)
        text += line("database", database, DatabaseSpec()) + '\n';
    for (std::size_t i = 0; i < description.parts.size(); ++i) {
        const Part& part = description.parts[i];
        text += line(write(part.kind), part, plainPart(part.kind, i)) + '\n';
    }
    ViewSpec before;
    for (const ViewSpec& view : description.views) text += line("view", view, std::exchange(before, view)) + '\n';
    return text;
}

std::string toText(const Expectation& expectation) {
    return line("expect", expectation, Expectation());
}

}  // namespace osgAnalyticBin::test
