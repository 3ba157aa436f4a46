// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Vec3d>

#include <optional>
#include <string>

namespace osgAnalyticBin::plugin {

/// What the metadata.xml of a photogrammetry set says.
struct PhotogrammetryMetadata {
    std::string srs;    ///< "ENU:LAT,LON", "EPSG:CODE", well-known text; empty: none
    osg::Vec3d origin;  ///< added to the coordinates of the tiles
};

/// Whether a file is the metadata of a photogrammetry set: an XML file with the element ModelMetadata, or one of the
/// name metadata.xml.
[[nodiscard]] bool isPhotogrammetryMetadata(const std::string& path);

/// Returns: nullopt when the file says nothing that can be understood; then `error` says why.
[[nodiscard]] std::optional<PhotogrammetryMetadata> readPhotogrammetryMetadata(const std::string& path,
                                                                               std::string& error);

/// "1.5, 2,3" makes three numbers. Returns: nullopt unless the text is just `count` finite numbers between commas.
[[nodiscard]] std::optional<osg::Vec3d> numbersFrom(const std::string& text, int count);

}  // namespace osgAnalyticBin::plugin
