// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Image>

namespace osgAnalyticBin {

/// The image in blocks of 4 x 4 texels with two colours and two between them each (S3TC, DXT1): a sixth of the bytes,
/// drawn as it is stored. The same bytes on every machine.
/// Requires: three bytes a texel, rows without padding, sides that are multiples of 4.
[[nodiscard]] osg::ref_ptr<osg::Image> inBlocks(const osg::Image& image);

}  // namespace osgAnalyticBin
