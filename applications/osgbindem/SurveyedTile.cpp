// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SurveyedTile.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace osgbindem {

namespace {

std::string placeOf(const Tally::Extreme& extreme) {
    std::ostringstream out;
    const double longitude = std::remainder(extreme.position.longitudeDeg, 360.0);
    out << std::fixed << std::setprecision(1) << extreme.metres << " m (" << std::setprecision(4)
        << std::abs(extreme.position.latitudeDeg) << (extreme.position.latitudeDeg < 0.0 ? " S, " : " N, ")
        << std::abs(longitude) << (longitude < 0.0 ? " W)" : " E)");
    return out.str();
}

}  // namespace

void Tally::add(const Tally& other) noexcept {
    tiles += other.tiles;
    deepest = std::max(deepest, other.deepest);
    files += other.files;
    bytes += other.bytes;
    posts += other.posts;
    filled += other.filled;
    missing += other.missing;
    if (other.lowest.metres < lowest.metres) lowest = other.lowest;
    if (other.highest.metres > highest.metres) highest = other.highest;
}

std::string Tally::text(const std::string& name, int startLevel, double seconds) const {
    std::ostringstream out;
    out << std::fixed << std::setprecision(0) << name << ": " << tiles << " tiles in levels " << startLevel << " to "
        << deepest << ", " << files << " files, " << std::setprecision(1) << std::ldexp(bytes, -20) << " MiB, "
        << seconds << " s";
    if (missing < posts) out << "\nheights from " << placeOf(lowest) << " to " << placeOf(highest);
    out << std::setprecision(0) << "; of " << posts << " posts, " << filled << " are filled voids and " << missing
        << " are at 0 m without data";
    return out.str();
}

std::string Tally::warning() const {
    if (missing == 0.0) return {};
    std::ostringstream out;
    out << "osgbindem: warning: no raster has data for " << std::fixed << std::setprecision(0) << missing << " of "
        << posts << " posts, which are at 0 m; add a raster below, or build a part of the earth with -te";
    return out.str();
}

}  // namespace osgbindem
