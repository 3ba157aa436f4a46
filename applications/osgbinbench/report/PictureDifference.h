// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Image>

#include <cstdint>
#include <string>

namespace osgAnalyticBin::report {

/// How two pictures of one size differ.
struct PictureDifference {
    std::uint64_t pixels = 0;          ///< pixels of which at least one channel differs
    osg::ref_ptr<osg::Image> picture;  ///< the differing pixels in red, the others a dim grey copy of the first picture
};

/// Compares two picture files pixel by pixel; any difference counts.
/// Throws: Failure when a file cannot be read or the sizes or formats differ.
[[nodiscard]] PictureDifference compareFiles(const std::string& first, const std::string& second);

/// The same for images with 8 bits per channel in memory.
[[nodiscard]] PictureDifference compare(const osg::Image& first, const osg::Image& second);

}  // namespace osgAnalyticBin::report
