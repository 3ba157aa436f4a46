// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/Declarations.h>
#include <osgAnalyticBin/Export.h>

#include <osg/Matrixd>
#include <osg/Node>
#include <osgDB/Options>

#include <cstddef>
#include <string>

/// Bins on the tiles of paged terrain. Applications begin with installBins().
namespace osgAnalyticBin {

/// Puts bins on the tiles of databases: AnalyticBinCullCallbacks on the tiles of a globe, boxes on those of a map.
/// OSG's culling flags stay as they are: groups above tiles are tested by their spheres, and so are nodes within tiles
/// and nodes that intersection visitors meet. Tiles that the DatabasePager loads later get their bins in the pager's
/// thread. A second call replaces what the first one installed. Call it between frames.
///
/// TileFinder decides which nodes are tiles. Their bins come from what is stored with them, from the database's index,
/// or from their own surface and the heights that the options declare. Nodes that are not tiles, tiles that are drawn
/// in several places, and drawables with a stored bin are left to OSG. Method::Sphere installs no bins, but follows
/// what is paged in, so that setCullOptions() can switch to another method.
///
/// What the application adds below a tile later is drawn. Which changes are noticed, and which the application
/// announces: doc/guide.md, section 5. Content that is independent of tiles belongs beside them, on the
/// CoordinateSystemNode or above it.
///
/// Returns: the number of callbacks installed.
OSGANALYTICBIN_EXPORT std::size_t installBins(osg::Node& node, const CullOptions& options = {});

/// The same for the root of a database that was read from a file. If there is an index beside the file, and the options
/// allow it, the index gives the heights of tiles that are not loaded yet. An index that cannot be used gives one
/// warning. Without an index, the default options make one in a thread of low priority. This thread ends with
/// removeBins() or with the scene. When the index is complete, the next update traversal fits the loaded tiles to it.
/// `readOptions`: the options that the database was read with, for archives and http; null: none. Returns: as
/// above.
OSGANALYTICBIN_EXPORT std::size_t installBins(osg::Node& node, const CullOptions& options,
                                              const std::string& databaseFileName,
                                              const osgDB::Options* readOptions = nullptr);

/// Whether an index of a database below the node is being made (IndexUse::Auto).
[[nodiscard]] OSGANALYTICBIN_EXPORT bool isIndexAwaited(osg::Node& node);

/// Waits until each index that is being made for a database below the node is complete, and applies it to the loaded
/// tiles. Use it in programs that compare or measure. Call it between frames. Returns: false when an index cannot be
/// made or is not complete after this time; culling works without it.
OSGANALYTICBIN_EXPORT bool waitForIndex(osg::Node& node, double seconds);

/// The same with an index that the application has read.
OSGANALYTICBIN_EXPORT std::size_t installBinsByIndex(osg::Node& node, const CullOptions& options,
                                                     const BinIndex& index);

/// Puts bins on a tile that the application has read and will attach below a database itself, as the tile manager of a
/// flight simulator does. Call it before the tile is attached; attach it anywhere below `database`, for instance by
/// DatabasePager::requestNodeFile() of a reader that calls this. Tiles in it are those of TileFinder or of
/// CullOptions::ground; a mesh that pages nothing is one, too. Wrap a tile that is a transform in an osg::Group: groups
/// are tested together with their siblings, transforms one by one.
/// `database`: the node that installBins() was called for, or the CoordinateSystemNode below it. Where there is no tile
/// at that time, CullOptions::globe has to be set. `parentToEcef`: from the frame of the node that the tile will be
/// attached to, to earth-centred coordinates.
/// The horizon is used where its altitude is given (`horizon=METRES`): what is shown may end anywhere. The root of the
/// database has to be updated: the next update has siblings tested together.
/// Threads: any, several at once, while the database is culled and updated; not while installBins(), setCullOptions()
/// or removeBins() run. Cost: that of reading the tile's vertices once; nothing beside the tile is visited.
/// Returns: the number of bins. 0: OSG culls the tile by itself; the first time, a line says why.
/// Tests: AddedTiles.*.
OSGANALYTICBIN_EXPORT std::size_t addTile(osg::Node& database, osg::Node& tile,
                                          const osg::Matrixd& parentToEcef = osg::Matrixd());

/// Takes the bins off a tile, with all below it. Call it before the tile is taken out of the scene, which has to be
/// done before the next frame: a tile that is missing without this counts as a hole in the terrain. There is no need
/// to call it for a tile below a group of its own that is taken away with it. Call it between frames. Cost: that of its
/// nodes and its siblings. Tests: AddedTiles.*.
OSGANALYTICBIN_EXPORT void removeTile(osg::Node& database, osg::Node& tile);

/// Changes the options of databases that are shown, also to Method::Sphere or Method::None. From the next frame on,
/// tiles are culled as if the database had been read with these options: tiles that are loaded, tiles that the
/// DatabasePager is reading, and tiles that it reads later. Knowledge of the database is kept: its index, and tiles
/// that did not fit it. On a database without bins: installBins(). Call it between frames, in the event or update
/// phase, where no cull traversal runs; the pager may work meanwhile.
/// Guarantee: the same tiles are drawn as after reading anew; tests: SwitchedCulling.*.
/// Returns: the number of callbacks installed. Cost: as installing bins on what is loaded.
OSGANALYTICBIN_EXPORT std::size_t setCullOptions(osg::Node& node, const CullOptions& options);

/// Takes bins off a node and all below it, and restores what installers changed: callbacks, expiry times, the pager's
/// options, and groups that were put above tiles. Call it between frames. Tiles that are being read then may arrive
/// with bins, which cull nothing. Around a part of a database without bins, nothing is hidden until all has bins again.
OSGANALYTICBIN_EXPORT void removeBins(osg::Node& node);

}  // namespace osgAnalyticBin
