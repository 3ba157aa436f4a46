// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/TileFrame.h>

#include <osgDB/FileNameUtils>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin {

std::string pagedFilePath(const std::string& referringFile, const std::string& name) {
    if (osgDB::isAbsolutePath(name) || osgDB::containsServerAddress(name)) return name;
    std::vector<std::string> parts;
    const auto append = [&](const std::string& path) {
        for (std::size_t begin = 0; begin <= path.size();) {
            const std::size_t end = std::min(path.find_first_of("/\\", begin), path.size());
            const std::string part = path.substr(begin, end - begin);
            if (part == ".." && !parts.empty() && parts.back() != "..") {
                parts.pop_back();
            } else if (!part.empty() && part != ".") {
                parts.push_back(part);
            }
            begin = end + 1;
        }
    };
    append(osgDB::getFilePath(referringFile));
    append(name);
    std::string path;
    for (const std::string& part : parts) path += (path.empty() ? "" : "/") + part;
    return path;
}

bool areValidRadii(double equatorial, double polar) {
    const auto isValid = [](double radius) { return std::isfinite(radius) && radius > 0.0; };
    return isValid(equatorial) && isValid(polar);
}

TileFrame pagedFrame(const TileFrame& frame, const std::string& name, bool isTile) {
    TileFrame inside = frame;
    inside.file = pagedFilePath(frame.file, name);
    inside.isBelowTile = frame.isBelowTile || isTile;
    inside.isAttached = false;
    return inside;
}

bool hasValidRadii(const osg::EllipsoidModel& ellipsoid) {
    return areValidRadii(ellipsoid.getRadiusEquator(), ellipsoid.getRadiusPolar());
}

const osg::EllipsoidModel* mapPlane() {
    static const osg::ref_ptr<const osg::EllipsoidModel> plane = new osg::EllipsoidModel(HUGE_VAL, HUGE_VAL);
    return plane.get();
}

bool isMapPlane(const osg::EllipsoidModel& ellipsoid) {
    return std::isinf(ellipsoid.getRadiusEquator()) && std::isinf(ellipsoid.getRadiusPolar());
}

osg::Matrixd frameInside(const osg::Transform& node, const TileFrame& frame) {
    osg::Matrixd inside;
    // Without a CoordinateSystemNode above, a tile's own frame is ECEF, whatever moves the globe.
    if (!frame.isKnown()) return inside;
    node.computeLocalToWorldMatrix(inside, nullptr);
    return inside * frame.localToEcef;
}

}  // namespace osgAnalyticBin
