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

/// Writes a file under a temporary name and renames it, so that it is either complete or not there.
/// OpenSceneGraph's own file writing does not notice a full disk; this does. Throws Failure.
void writeFile(const std::string& path, const std::string& bytes);

}  // namespace osgbindem
