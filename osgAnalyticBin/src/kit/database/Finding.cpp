// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Finding.h"

#include <osg/Notify>

#include <mutex>

namespace osgAnalyticBin {

namespace {

struct Message {
    osg::NotifySeverity severity;
    const char* text;  // null: none; %: the file
};

Message messageOf(Finding finding, bool isInMap) {
    switch (finding) {
        case Finding::Gap:
            if (isInMap)
                return {osg::INFO,
                        "the tiles of % leave gaps in the map, or it is not known whether they do. No tile is hidden "
                        "behind terrain."};
            return {osg::NOTICE,
                    "the tiles of % leave gaps: their meshes cover neither the globe nor a rectangle of latitude and "
                    "longitude. The horizon is not used."};
        case Finding::Hole:
            return {osg::NOTICE,
                    "in % a mesh has a hole, or it is not known whether it covers all of its tile. The horizon is not "
                    "used while such tiles are in view."};
        case Finding::StrayTile:
            return {osg::INFO,
                    "% has tiles that stand in several places, below a transform that moves, or elsewhere than where "
                    "they belong, or that belong to another Terrain; where they leave a gap, the horizon is not used."};
        case Finding::TooDeep:
            return {osg::WARN,
                    "% has tiles nested hundreds deep; the innermost get no bins, and the horizon is not used."};
        case Finding::UnknownTechnique:
            return {osg::INFO,
                    "the Terrain has a technique that is not osgTerrain::GeometryTechnique; its tiles are not culled, "
                    "unless techniquemargin= says how far from the heights it draws."};
        case Finding::UnknownNearPlane:
            return {
                osg::INFO,
                "the near plane that OSG computes has no known bound because of %: nothing is hidden behind terrain. "
                "Set DO_NOT_COMPUTE_NEAR_FAR, and near and far planes of your own."};
        case Finding::EyeBesideRegion:
            return {osg::NOTICE,
                    "the camera is not over the regional database. The horizon is not used in such views."};
        case Finding::OtherThanIndexed:
            return {osg::WARN,
                    "% is not as the index knows it; tiles are kept visible there. Run osgbinconv --index again."};
        case Finding::LargerThanStored:
            return {osg::WARN,
                    "% holds a tile that is larger than the bin stored with it or above it; bins are widened there. "
                    "Make the database again."};
        case Finding::Unverifiable:
            return {osg::WARN,
                    "% holds content that cannot be compared with the bin stored with it or above it: it stands on "
                    "another globe, or its mesh has no known bounds. Such bins are not used; OSG culls these tiles by "
                    "their spheres."};
        default:
            return {osg::INFO, nullptr};
    }
}

}  // namespace

void tell(Finding finding, const std::string& file, bool isInMap) {
    const Message message = messageOf(finding, isInMap);
    if (!message.text) return;
    std::string text = message.text;
    const std::size_t at = text.find('%');
    if (at != std::string::npos) text.replace(at, 1, file.empty() ? "the root file" : '"' + file + '"');
    // OSG's stream is one for all threads
    static std::mutex printing;
    const std::lock_guard<std::mutex> lock(printing);
    OSG_NOTIFY(message.severity) << "osgAnalyticBin: " << text << std::endl;
}

}  // namespace osgAnalyticBin
