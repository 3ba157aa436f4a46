// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Group>

namespace osgAnalyticBin::test {

/// The scene as it comes back from a file, .osgt or .osgb.
[[nodiscard]] osg::ref_ptr<osg::Group> writtenAndRead(const osg::Group& scene, bool asText);

/// `variant`: what is copied, and what is shared.
[[nodiscard]] osg::ref_ptr<osg::Group> clonedScene(const osg::Group& scene, int variant);

}  // namespace osgAnalyticBin::test
