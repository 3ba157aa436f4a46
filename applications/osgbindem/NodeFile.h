// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>

#include <string>

namespace osgbindem {

/// Makes ready what OpenSceneGraph loads on first use, so that threads find everything loaded.
/// Throws Failure when the classes of a database cannot be stored.
void prepareNodeFiles();

/// The bytes of an .osgb file with the node. Throws Failure.
[[nodiscard]] std::string nodeFileBytes(const osg::Node& node, bool compress);

}  // namespace osgbindem
