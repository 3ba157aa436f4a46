// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/Export.h>

#include <osg/Callback>
#include <osg/Node>
#include <osgDB/Options>

#include <cstddef>
#include <string>

namespace osgAnalyticBin {

/// Puts bins on the tiles of databases: AnalyticBinCullCallbacks on those of a globe, boxes on those of a map. OSG's
/// sphere test is switched off on the tiles and below (drawables keep their boxes), and tiles that the DatabasePager
/// loads later are treated in the pager's thread. TileFinder decides which nodes are tiles; their bins come from what
/// is stored with them, from the database's index, or from their own surface and the heights that the options declare.
/// A tile that is drawn in several places, a drawable with a stored bin, and everything that is not a tile, is left to
/// OSG. Method::Sphere puts no bins on, but follows what is paged in, so that setCullOptions() can switch. A second
/// call replaces what the first installed. Call it between frames. What the application adds below a tile while bins
/// are installed is noticed with the next frame, be it static or moving: the tile and those above are kept visible, and
/// their bins grow to hold it in the next update traversal. Content that is to be independent of tiles belongs beside
/// them, on the CoordinateSystemNode or above it. Additions and moves are known from OSG's bounds: where vertices
/// change, call dirty() of the vertex array and dirtyBound() of the drawable. Where the application replaces a tile's
/// mesh, call installBins() again. Returns: the number of callbacks installed.
OSGANALYTICBIN_EXPORT std::size_t installBins(osg::Node& node, const CullOptions& options = {});

/// The same for the root of a database that was read from a file: its index, where there is one beside it and the
/// options allow it, tells the heights of what is not loaded yet. An index that cannot be used gives one warning.
/// `readOptions`: with what the database was read, for files in archives and over http; null: none. Returns: as above.
OSGANALYTICBIN_EXPORT std::size_t installBins(osg::Node& node, const CullOptions& options,
                                              const std::string& databaseFileName,
                                              const osgDB::Options* readOptions = nullptr);

/// The same with an index that the application has read.
OSGANALYTICBIN_EXPORT std::size_t installBinsByIndex(osg::Node& node, const CullOptions& options,
                                                     const BinIndex& index);

/// Culls databases by other options while they are shown, Method::Sphere and Method::None among them: from the next
/// frame on, tiles are culled as if the database had been read with these options. That goes for tiles that are loaded,
/// for those that the DatabasePager is reading just now, and for those that it reads later. What was known of the
/// database (its index, tiles that did not fit it) stays known. On a database without bins: installBins().
/// Call it between frames, in the event or update phase, where no cull traversal runs; the pager may work meanwhile.
/// Guarantee: the same tiles are drawn as after reading anew; tests: SwitchedCulling.*.
/// Returns: the number of callbacks installed. Cost: as installing bins on what is loaded.
OSGANALYTICBIN_EXPORT std::size_t setCullOptions(osg::Node& node, const CullOptions& options);

/// Takes bins off a node and all below it, and restores what installers changed: callbacks, culling flags, expiry
/// times, the pager's options, and groups that were put above tiles. Call it between frames. What the DatabasePager is
/// reading just now may still arrive with bins, which still cull it correctly.
OSGANALYTICBIN_EXPORT void removeBins(osg::Node& node);

/// Declares that an application's cull callback always goes on to what is nested in it or below its node, as a
/// user value "osgAnalyticBin.traversesAlways" of the callback. One that does not say so may leave out terrain, and so
/// the horizon is not used while it stands on a tile in view or above one.
OSGANALYTICBIN_EXPORT void setTraversesAlways(osg::Callback& callback);

/// Returns: whether setTraversesAlways() was called for the callback, or it is a plain osg::NodeCallback.
[[nodiscard]] OSGANALYTICBIN_EXPORT bool traversesAlways(const osg::Callback& callback);

}  // namespace osgAnalyticBin
