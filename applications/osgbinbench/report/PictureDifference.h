// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Image>

#include <cstdint>
#include <string>

namespace osgAnalyticBin::report {

/// How many pixels of two picture files differ in a channel. Throws: Failure when a file cannot be read, or the sizes
/// or formats differ.
[[nodiscard]] std::uint64_t differingPixels(const std::string& first, const std::string& second);

/// The same of images with 8 bits per channel in memory.
[[nodiscard]] std::uint64_t differingPixels(const osg::Image& first, const osg::Image& second);

}  // namespace osgAnalyticBin::report
