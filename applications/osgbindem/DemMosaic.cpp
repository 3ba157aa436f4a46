// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DemMosaic.h"

#include "Failure.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <utility>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

// A raster that is up to so many times as coarse knows more of a void than the posts around it.
constexpr double kRival = 1.5;

constexpr const char* kAdvice = "; install the package proj-data, or see --geoid (none takes heights as they are)";

// Half of the memory is GDAL's cache, the other half what the threads keep.
double postsPerThread(const Settings& settings) {
    const double bytes = std::ldexp(0.5 * settings.memoryMib, 20) / settings.threads.value_or(1);
    return std::min(bytes / sizeof(double), DemSource::kMostPosts);
}

std::string markText(const RasterLook& look, double posts) {
    std::ostringstream out;
    out << ": " << (look.posts < posts ? "some " : "") << std::round(look.marks * posts / look.posts)
        << " posts with numbers like " << look.lastMark
        << ", which no terrain has (where they are heights, see --height-unit)";
    return out.str();
}

}  // namespace

VerticalShift::VerticalShift(const std::string& vertical, const std::string& geoid, const std::string& path) {
    if (geoid == "none" || (geoid.empty() && vertical.empty())) return;
    OGRSpatialReference source;
    if (geoid.empty()) {
        OGRSpatialReference positions;
        OGRSpatialReference heights;
        positions.importFromEPSG(4326);
        heights.importFromWkt(vertical.c_str());
        source.SetCompoundCS("positions and heights", &positions, &heights);
        _what = std::string("the vertical reference \"") + heights.GetName() + "\" of \"" + path + "\"";
    } else {
        const bool isFile = geoid != "egm96";
        _what = isFile ? "the geoid \"" + geoid + "\"" : "the geoid EGM96";
        const std::string grid = isFile ? std::filesystem::absolute(geoid).string() : "egm96_15.gtx";
        const std::string text = "+proj=longlat +datum=WGS84 +geoidgrids=" + grid + " +vunits=m +no_defs";
        if (source.importFromProj4(text.c_str()) != OGRERR_NONE) {
            throw Failure("PROJ does not take \"" + grid + "\" for a grid of the geoid; see --geoid");
        }
    }
    OGRSpatialReference target;
    target.importFromEPSG(4979);
    source.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    target.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    OGRCoordinateTransformationOptions options;
    options.SetBallparkAllowed(false);
    _transformation.reset(OGRCreateCoordinateTransformation(&source, &target, options));
    if (!_transformation) throw Failure("PROJ has no grid for " + _what + kAdvice);
}

double VerticalShift::at(const PositionDeg& position) const {
    if (!_transformation) return 0.0;
    double x = std::remainder(position.longitudeDeg, 360.0);
    double y = position.latitudeDeg;
    double z = 0.0;
    if (_transformation->Transform(1, &x, &y, &z) == 0 || !std::isfinite(z)) {
        throw Failure("PROJ finds no height of " + _what + " at latitude " + std::to_string(position.latitudeDeg) +
                      ", longitude " + std::to_string(position.longitudeDeg) + kAdvice);
    }
    return z;
}

DemMosaic::DemMosaic(const Settings& settings, const TileLayout* layout) {
    RasterLayer::Layers layers = RasterLayer::elevationOf(settings, layout);
    const double mostPosts = postsPerThread(settings) / static_cast<double>(layers.size());
    for (auto& layer : layers) {
        _shifts.emplace_back(layer->vertical(), settings.geoid, layer->path());
        _sources.push_back(std::make_unique<DemSource>(std::move(layer), mostPosts));
    }
    for (std::size_t i = 0; i + 1 < _sources.size(); ++i) {
        const bool hasRivals = _sources[i + 1]->layer().spacingDeg() <= kRival * _sources[i]->layer().spacingDeg();
        _sources[i]->voids().setCoarser(
            [this, i](int column, int row) { return below(i, _sources[i]->grid().position(column, row)); }, hasRivals);
    }
}

FoundHeight DemMosaic::below(std::size_t source, const PositionDeg& position) {
    auto found = heightFrom(source + 1, position);
    if (!found) return {};
    const double rivalDeg = kRival * _sources[source]->layer().spacingDeg();
    found->metres -= _shifts[source].at(position);
    found->isRival = !found->isFilled && _sources[found->source]->layer().spacingDeg() <= rivalDeg;
    return *found;
}

std::optional<FoundHeight> DemMosaic::heightFrom(std::size_t source, const PositionDeg& position) {
    for (std::size_t i = source; i < _sources.size(); ++i) {
        auto found = _sources[i]->height(position);
        if (!found) continue;
        found->source = i;
        if (!_shifts[i].isNone()) found->metres += _shifts[i].at(position);
        const double own = _sources[i]->layer().share(position);
        if (own == 1.0) return found;
        const auto coarser = heightFrom(i + 1, position);
        if (coarser) found->metres = coarser->metres + own * (found->metres - coarser->metres);
        return found;
    }
    return std::nullopt;
}

bool DemMosaic::addRange(std::size_t source, const RectDeg& rect, Interval& range) {
    if (_shifts[source].isNone()) return _sources[source]->addRange(rect, range);
    Interval above = Interval::none();
    const bool isComplete = _sources[source]->addRange(rect, above);
    if (above.width() < 0.0) return isComplete;
    // Between these places the geoid differs by no more than its steepest slope allows.
    constexpr int kPlaces = 16;
    constexpr double kSteepest = 25.0;  // metres a degree
    const double margin = kSteepest * std::max(rect.north - rect.south, rect.east - rect.west) / kPlaces;
    Interval shift = Interval::none();
    for (int row = 0; row <= kPlaces; ++row) {
        for (int column = 0; column <= kPlaces; ++column) {
            const PositionDeg position{rect.south + (rect.north - rect.south) * row / kPlaces,
                                       rect.west + (rect.east - rect.west) * column / kPlaces};
            if (_sources[source]->grid().locate(position)) shift.expandBy(_shifts[source].at(position));
        }
    }
    if (shift.width() < 0.0) return isComplete;
    range.expandBy(above.lower + shift.lower - margin);
    range.expandBy(above.upper + shift.upper + margin);
    return isComplete;
}

Interval DemMosaic::range(const RectDeg& rect) {
    Interval range = Interval::none();
    bool isCovered = false;
    for (std::size_t i = 0; i < _sources.size(); ++i) {
        const bool isComplete = addRange(i, rect, range);
        if (isComplete && !_sources[i]->layer().isBlendedIn(rect)) return range;
        isCovered = isCovered || isComplete;
    }
    if (!isCovered) range.expandBy(0.0);
    return range;
}

bool DemMosaic::hasFinerRaster(const RectDeg& rect, double spacingDeg) const noexcept {
    return std::any_of(_sources.begin(), _sources.end(), [&](const auto& source) {
        return TileLayout::isFiner(source->grid().resolutionDeg(), spacingDeg) && source->grid().overlap(rect) > 0.0;
    });
}

bool DemMosaic::hasFinerData(const RectDeg& rect, double spacingDeg) {
    return std::any_of(_sources.begin(), _sources.end(), [&](const auto& source) {
        return TileLayout::isFiner(source->grid().resolutionDeg(), spacingDeg) && source->hasData(rect);
    });
}

std::vector<std::string> DemMosaic::inspect() {
    std::map<std::string, std::vector<std::string>> notes;  // each with the paths of what it is true of
    for (std::size_t i = 0; i < _sources.size(); ++i) {
        for (const RasterLayer::Member& member : _sources[i]->layer().members()) {
            const RasterFile& file = *member.file;
            const RasterLook look = file.look();
            const std::string marks = look.marks > 0.0 ? markText(look, file.posts()) : std::string();
            if (look.missing == look.posts) {
                throw Failure("no heights in \"" + file.path() + "\", only missing data" + marks +
                              "; leave it out, or see --nodata, --height-unit and --radii");
            }
            for (const std::string& note : file.notes()) notes[note].push_back(file.path());
            if (!_shifts[i].isNone())
                notes["heights above " + _shifts[i].what() + ", converted by PROJ"].push_back(file.path());
            if (!marks.empty()) notes["missing data" + marks].push_back(file.path());
        }
    }
    std::vector<std::string> lines;
    for (const auto& [note, paths] : notes) {
        const std::string others = paths.size() > 1 ? " and " + std::to_string(paths.size() - 1) + " others" : "";
        lines.push_back("\"" + paths.front() + "\"" + others + ": " + note);
    }
    return lines;
}

double DemMosaic::finestDeg() const noexcept {
    return _sources.front()->layer().spacingDeg();
}

double DemMosaic::finestGlobalDeg() const noexcept {
    for (const auto& source : _sources) {
        if (source->grid().isGlobal()) return source->grid().resolutionDeg();
    }
    return finestDeg();
}

double DemMosaic::posts(const RectDeg& rect) const noexcept {
    double sum = 0.0;
    for (const auto& source : _sources) {
        for (const RasterLayer::Member& member : source->layer().members()) {
            const double resolution = member.grid.resolutionDeg();
            sum += member.grid.overlap(rect) / resolution / resolution;  // whose square may be too small for a number
        }
    }
    return sum;
}

}  // namespace osgbindem
