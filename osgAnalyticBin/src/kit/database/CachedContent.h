// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Files that OSG's object caches keep. Bins are never installed on what these hold: others read it, too, and it
// outlives what belongs to an application.

#pragma once

#include <osg/Node>
#include <osgDB/Options>

#include <string>

namespace osgAnalyticBin {

/// What a cache has of a file that was just read with these options. Returns: nullptr when no cache has it.
[[nodiscard]] osg::ref_ptr<osg::Node> cachedNode(const std::string& fileName, const osgDB::Options& options);

/// A copy of all nodes, which shares drawables, states and callbacks. Returns: nullptr when the content has nodes that
/// cannot be copied, as those of an application's own classes without clone().
[[nodiscard]] osg::ref_ptr<osg::Node> copyForBins(const osg::Node& content);

/// Puts `fresh` in the place of `old` wherever that is below a node.
void replaceBelow(osg::Node& root, osg::Node& old, osg::Node& fresh);

}  // namespace osgAnalyticBin
