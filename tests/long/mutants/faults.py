# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
"""Faults that tests have to notice. Each is a text that stands in one place of one file, what stands there instead, and
the tests that are expected to fail then. The texts are short, so that they outlive changes round about."""

from dataclasses import dataclass

CORE = "osganalyticbin_core_tests"
NODE = "osganalyticbin_node_tests"
PLUGIN = "osganalyticbin_plugin_tests"


@dataclass(frozen=True)
class Fault:
    name: str
    file: str  # below osgAnalyticBin/
    text: str
    instead: str
    target: str
    tests: str = "*"  # as --gtest_filter takes them


FAULTS = [
    # those that no test noticed once
    Fault("database callback drops what is nested in it", "src/node/page/DatabaseCallbacks.cpp",
          "cull->setNestedCallback(node.getCullCallback());", "", NODE, "*NestedDatabaseCallback*"),
    Fault("statistics count the bin's verdict alone", "src/node/cull/BinCulling.cpp",
          "traversal.count(culled ? core::Side::Outside : verdict.side,", "traversal.count(verdict.side,", NODE, "CulledCounts.*"),
    Fault("no rounding in the edge search", "src/core/edge/HullSeparation.cpp",
          "kRounding = 16.0 *", "kRounding = 0.0 *", CORE, "HullSeparation*"),
    Fault("no tolerance of longitudes", "src/core/GeodeticBin.cpp",
          "kAngleTolerance = 2e-15", "kAngleTolerance = 0.0", CORE, "GeodeticBin.*"),
    Fault("an option is not listed", "src/plugin/ReaderWriterAnalyticBin.cpp",
          'supportsOption("skirts=cracks|all",', 'supportsOption("index=on|off",', PLUGIN, "OptionString.*"),

    # the polynomial and its proof
    Fault("no remainder", "src/core/bin/QuadraticBin.cpp", "(mapping.remainder(box) + margin)", "(margin)",
          CORE, "*QuadraticBin*"),
    Fault("no margin", "src/core/bin/QuadraticBin.cpp", "remainder(box) + margin)", "remainder(box))", CORE, "*QuadraticBin*"),
    Fault("no rounding of the polynomial", "src/core/bin/QuadraticBin.cpp", "kRounding = 128.0 *", "kRounding = 0.0 *", CORE,
          "*QuadraticBin*:PlaneSet*:PlaneKernels*:Classify*:Planets*"),
    Fault("mixed derivatives swapped", "src/core/bin/QuadraticBin.cpp", "hessians.uw * (e.x * e.z)", "hessians.vw * (e.x * e.z)",
          CORE, "*QuadraticBin*"),
    Fault("sign of a second derivative", "src/core/bin/GeodeticMapping.cpp", "- (m + h) * frame.up;  // f_pp",
          "+ (m + h) * frame.up;", CORE, "GeodeticMapping*:*QuadraticBin*"),
    Fault("no extremum inside the cube", "src/core/bin/QuadraticRange.cpp",
          "acceptOntoBox(v) && acceptOntoBox(w)) include(range, q(u, v, w))",
          "acceptOntoBox(v) && acceptOntoBox(w)) range.lower = range.lower", CORE, "QuadraticRange*"),
    Fault("sign of the extremum on an edge", "src/core/bin/QuadraticRange.cpp", "q.a - 0.5 * q.b", "q.a + 0.5 * q.b", CORE,
          "QuadraticRange*"),

    # the closed form
    Fault("a corner of the bottom in place of one of the top", "src/core/bin/ExactGeodeticBin.cpp",
          "addCorner(_numbers[row::SinNorth], _numbers[row::CosNorth], bin.altitude().upper)",
          "addCorner(_numbers[row::SinNorth], _numbers[row::CosNorth], bin.altitude().lower)", CORE, "ExactGeodeticBin*"),
    Fault("no rounding of the closed form", "src/core/bin/ExactGeodeticBin.cpp", "kRounding = 32.0 *", "kRounding = 0.0 *",
          CORE, "ExactGeodeticBin*:PlaneSet*:PlaneKernels*:Classify*:Planets*"),
    Fault("wide bins are taken for narrow ones", "src/core/bin/ExactGeodeticBin.cpp", ": row::kWide", ": row::kNarrow",
          CORE, "ExactGeodeticBin*"),
    Fault("a sphere that is a tenth too small", "src/core/bin/ExactGeodeticBin.cpp",
          "(convex ? farthest : farthest + sag) * kNormalTolerance", "(convex ? farthest : farthest + sag) * 0.9", CORE,
          "ExactGeodeticBin*"),

    # kernels
    Fault("a wide bin's dip is missed", "src/core/kernels/ExactTest.inl",
          "either(hasDipBetween(west, middle), hasDipBetween(middle, east))", "hasDipBetween(west, middle)", CORE,
          "ExactGeodeticBin*:PlaneSet*:PlaneKernels*:BinFamily*"),
    Fault("no rounding of the sphere's test", "src/core/kernels/QuadraticTest.inl",
          "distance >= bin[row::Reach] + plane.rounding", "distance >= bin[row::Reach]", CORE,
          "ExactGeodeticBin*:*QuadraticBin*:PlaneSet*:PlaneKernels*:BinFamily*"),
    Fault("smallest corner of three", "src/core/kernels/ExactTest.inl",
          "smaller(alongCorner(bin, 2, c.lower, nz), alongCorner(bin, 3, c.lower, nz))", "alongCorner(bin, 2, c.lower, nz)",
          CORE, "ExactGeodeticBin*:PlaneSet*:PlaneKernels*:BinFamily*"),
    Fault("no bulge above", "src/core/kernels/ExactTest.inl", "upper + bulge", "upper", CORE,
          "ExactGeodeticBin*:PlaneSet*:PlaneKernels*:BinFamily*"),
    Fault("families: a slot is tested by planes that are decided", "src/core/kernels/FamilyStages.inl",
          "whereBit<Real>(known.open, bit)", "whereBit<Real>(bits<Real>(~0u), bit)", CORE, "BinFamily*"),
    Fault("families: exact lanes are lost beside quadratic ones", "src/core/kernels/FamilyStages.inl",
          "openExact = exclusive(known.open, openQuadratic)", "openExact = bits<Real>(0)", CORE, "BinFamily*"),
    Fault("planes that are decided stay undecided", "src/core/PlaneSet.cpp", "undecided &= ~sides.inside();", "", CORE,
          "PlaneSet*:Classify*"),

    # the horizon
    Fault("occluder higher than the deepest terrain", "src/core/horizon/Horizon.cpp", "(1.0 - depth / radius) * kDown",
          "(1.0 + depth / radius) * kDown", CORE, "Horizon*"),
    Fault("radii of the occluder swapped", "src/core/horizon/Horizon.cpp", "depth >= 0.0 ? smallerRadius", "depth < 0.0 ? smallerRadius",
          CORE, "Horizon*:Planets*"),
    Fault("a corner of the bin's latitudes swapped", "src/core/horizon/Horizon.cpp",
          "isNorthOf(southLow, southHigh) ? southHigh : southLow", "isNorthOf(southLow, southHigh) ? southLow : southHigh",
          CORE, "Horizon*"),
    Fault("dip and radius beyond half a turn", "src/core/kernels/HorizonTest.inl",
          "isAny = cosC > broadcast<Real>(0.0);", "isAny = cosC == cosC;", CORE, "Horizon*"),
    Fault("a point spreads to the nearer end of its bin", "src/core/horizon/Horizon.cpp", "std::min(radial * rows[row::CosSouthern]",
          "std::max(radial * rows[row::CosSouthern]", CORE, "HorizonPoint*"),
    Fault("the bin's margin does not spread its directions", "src/core/horizon/Horizon.cpp",
          "_numbers[row::SinMargin] = step / lowest * kUp;",
          "_numbers[row::SinMargin] = 0.0 * step / lowest;", CORE, "Horizon*"),

    # bounds of meshes
    Fault("meshes across the date line", "src/core/mesh/GeodeticMeshBounds.cpp", "    noteCrossing(corners);\n", "", CORE,
          "GeodeticMeshBounds*:*Planet*"),
    Fault("chords do not run poleward", "src/core/mesh/GeodeticMeshBounds.cpp",
          "corner.z >= 0.0 ? raiseNorth(latitude) : lowerSouth(latitude);", "(void)latitude;", CORE,
          "GeodeticMeshBounds*:*Planet*"),
    Fault("chords do not run poleward, quick form", "src/core/mesh/QuickMeshBounds.cpp", "runs[side] = end.guess * end.pole > 0.0;",
          "runs[side] = false;", CORE, "QuickMeshBounds*:*Planet*"),
    Fault("chords of grids sag half as far", "src/core/mesh/GeodeticGridBounds.cpp", "return terms.radius * versine + rounding;",
          "return 0.5 * terms.radius * versine + rounding;", CORE, "GeodeticGridBounds*:*Planet*"),
    Fault("cracks along southern edges", "src/core/mesh/CrackBounds.cpp", "std::max({southArc, northArc,", "std::max({0.0 * southArc, northArc,",
          CORE, "*Crack*"),

    # a node's test
    Fault("planes that are decided stay set for the subgraph", "src/node/cull/BinCulling.h",
          "setUndecided(frustum, undecided);", "", NODE, "AnalyticBinCullCallback*"),
    Fault("no small features", "src/node/cull/BinCulling.h", "isSmall(cullingSet, sphere) ||", "", NODE,
          "AnalyticBinCullCallback*:CulledCounts*"),
    Fault("no occluders", "src/node/cull/BinCulling.h", "isOccluded(cullStack, nv.getNodePath(), sphere)", "false", NODE,
          "AnalyticBinCullCallback*:CulledCounts*:Occluders*"),
    Fault("occluders are asked again below a tile", "src/node/cull/BinCulling.h", "const OccluderScope occluders(*cullStack);", "",
          NODE, "Occluders*:AnalyticBinCullCallback*"),
    Fault("holes that OSG has dropped", "src/node/cull/Occluders.cpp", "|| !hasAllHoles(occluder)", "", NODE, "Occluders*"),
    Fault("occluders hide what is below them", "src/node/cull/Occluders.cpp", "isBelow(path, occluder.getNodePath()) ||", "", NODE,
          "Occluders*:CulledCounts*"),
    Fault("horizon in shadow passes", "src/node/cull/Viewpoint.cpp",
          "if (!inShadowPasses && isShadowPass(visitor)) return std::nullopt;", "(void)visitor, (void)inShadowPasses, (void)&isShadowPass;",
          NODE, "*Shadow*:NestedCameras*"),
    Fault("a near plane behind the horizon's eye", "src/node/cull/Viewpoint.cpp",
          "if (_nearReach > 0.0 && !(_nearReach < distanceTo(ellipsoid, depth, _point))) return std::nullopt;",
          "(void)&distanceTo;", NODE, "*NearFar*:Projections*:HorizonCulling*"),
    Fault("skirts are not in the bin", "src/node/cull/AnalyticBinCullCallback.cpp", "altitude.lower - _skirt", "altitude.lower",
          NODE, "*Skirt*:Border*:*Surface*"),
    Fault("eyes of other cameras", "src/node/cull/AnalyticBinCullCallback.cpp",
          "database->projection == cullStack.getProjectionMatrix() && ", "", NODE, "NestedCamera*:*Stereo*"),
    Fault("planes of the frustum before", "src/node/cull/CullTraversal.cpp",
          "if (list[i][k] != _coefficients[4 * i + k]) return false;", "", NODE),
    Fault("chords of flattened meshes", "src/node/AnalyticBin.cpp", "verticalScale * h.lower - unscaledSag", "verticalScale * h.lower",
          NODE, "AnalyticBin.*:VerticalScale*:*Surface*"),

    # databases
    Fault("descendants are no higher than their tile", "src/node/install/TileFit.cpp",
          "altitude.upper = std::max(altitude.upper, heights.upper);", "", NODE),
    Fault("false stored bins are not widened", "src/node/install/TileFit.cpp", "if (!isWithinBin || (link.hasNewContent && surface.valid())) fit.bin.expandBy(surface);", "",
          NODE, "FalseBins*:StoredBinNearPole*"),
    Fault("coarse meshes beside poles", "src/node/install/TileFit.cpp", "runBeyond(-latitude.lower, sag, ellipsoid)", "0.0", NODE,
          "StoredBinNearPole*"),
    Fault("a PagedLOD's stand-in is not looked at", "src/node/cull/ShownDepth.cpp",
          "if (isOneAwaited && children > 0) searchChild(node, children - 1, tile);", "(void)isOneAwaited;", NODE, "ShownDepth*"),
    Fault("own expiry times are forgotten", "src/node/page/PagingExpiry.cpp",
          "node.setUserValue(keyOf(i), own);", "", NODE, "PagingExpiry*"),
    Fault("culling that was suspended stays off", "src/node/install/MeshCulling.cpp", "node.setUserValue(kWasCulling, true);", "", NODE,
          "SwitchedCulling*:BinInstaller*"),
    Fault("damaged indexes are read", "src/node/index/BinIndexFile.cpp",
          "if (in.number<std::uint32_t>() != checksum) throw Refusal{kDamaged};", "(void)in.number<std::uint32_t>();", NODE,
          "BinIndex*"),

    # files
    Fault("a tile's frame is not saved", "src/serializers/AnalyticBinCullCallback.cpp",
          "    ADD_USER_SERIALIZER(LocalToEcef);\n", "", PLUGIN, "*Serializer*"),
    Fault("a database's request forgets its options", "src/serializers/InstallBinsCallback.cpp",
          "    ADD_USER_SERIALIZER(Options);\n", "", PLUGIN, "*Serializer*:Plugin*"),
    Fault("the option string wins over the file name", "src/plugin/ReaderWriterAnalyticBin.cpp",
          "shared.items + request.parameters", "request.parameters + ' ' + shared.items", PLUGIN, "Plugin.*"),
    Fault("a database is cached with its bins", "src/plugin/ReaderWriterAnalyticBin.cpp",
          "~osgDB::Options::CACHE_NODES", "~osgDB::Options::CACHE_NONE", PLUGIN, "Plugin.*"),
    Fault("keys that look like ours pass", "src/plugin/OptionString.cpp", "const std::size_t most = key.size() < 6 ? 1 : 2;",
          "const std::size_t most = 0;", PLUGIN, "OptionString.*"),

    # the last: all of the kit is compiled for it
    Fault("terrain on earth up to 8000 m", "include/osgAnalyticBin/CullOptions.h",
          "kTerrainOnEarth{-11500.0, 9000.0}", "kTerrainOnEarth{-11500.0, 8000.0}", NODE, "HeightsOnEarth.*"),

    # what applications do with a database
    Fault("copies of callbacks cull", "src/node/install/InstalledTile.h", "return node == _culled;", "return true;", NODE,
          "Clones.*"),
    Fault("new content does not keep tiles visible", "src/node/install/ContentWatch.cpp", "tile->keepVisible(true);\n        if",
          "if", NODE, "AddedContent.*"),
    Fault("bins do not grow", "src/node/install/ContentWatch.cpp",
          "if (_isMerged) tile->database().noteContent(", "if (false) tile->database().noteContent(", NODE, "AddedContent.*"),
    Fault("content of files is not looked at when they are merged", "src/node/install/ContentWatch.cpp",
          "if (watch->_isPending) watch->check(child);", "", NODE, "AddedContent.*"),
    Fault("tiles are believed wherever they stand", "src/node/cull/AnalyticBinCullCallback.cpp",
          "standsAsInstalled(cullStack, *database);", "true;", NODE, "Instances.*"),
    Fault("instances get bins", "src/node/install/BinInstaller.cpp",
          "if (isInstanced(*tile.node, tile.frame)) {", "if (false) {", NODE, "Instances.*"),
    Fault("wireframe hides", "src/node/cull/SeeThrough.cpp", "drawsNoFaces(state) ||", "", NODE, "SeeThroughTerrain.*"),
    Fault("masked tiles hide", "src/node/cull/ShownDepth.cpp", "return _visitor.validNodeMask(node) && ", "return ", NODE,
          "HoledGlobe.*"),
    Fault("tiles that stand in several places hide whatever they are drawn as", "src/node/install/BinInstaller.cpp",
          "if (installsBins()) database().noteStrayTile(tile.frame.file);", "", NODE, "TilesWithoutBins.*"),
    Fault("tiles that move hide whatever they are drawn as", "src/node/install/BinInstaller.cpp",
          "if (installsBins() && hasTileBelow(node)) database().noteStrayTile(frame().file);", "(void)hasTileBelow(node);", NODE, "TilesWithoutBins.*"),
    Fault("tiles that are moved away leave no hole", "src/node/cull/ShownDepth.cpp",
          "if (!standsAsInstalled(node, bin)) _hasHole = true;", "", NODE, "HoledGlobe.*"),
    Fault("eyes below the ground have a horizon", "src/node/cull/GroundBelow.cpp",
          "if (!(glm::dot(hit - point, up) < 0.0)) return false;", "", NODE, "UndergroundEyes.*"),
    Fault("undo forgets what was off", "src/node/install/InstalledTile.cpp", "if (!_wasActive.back()) return;", "", NODE, "Undo.*"),
    Fault("saved scenes forget the skirt", "src/node/cull/AnalyticBinCullCallbackText.cpp",
          'if (_skirt != 0.0) text += "; skirt " + numberToText(_skirt);', "", PLUGIN, "*Serializer*"),

    # terrain that hides terrain
    Fault("occlusion: borders of meshes count as covered", "src/core/occlusion/GroundPlates.cpp", "        addBorders();\n", "",
          CORE, "GroundPlates.*"),
    Fault("occlusion: folds count as covered", "src/core/occlusion/GroundPlates.cpp",
          "if (bounds.empty() || !isUpward(corners)) {", "if (bounds.empty()) {", CORE, "GroundPlates.*"),
    Fault("occlusion: chords of parallels stay on them", "src/core/occlusion/GroundPlates.cpp",
          "!(bulge < 0.5 * kRim * along) || ", "", CORE, "GroundPlates.*"),
    Fault("occlusion: the higher end of a chord counts", "src/core/occlusion/HorizonBuffer.cpp",
          "std::min(y0, y1) - chord.room", "std::max(y0, y1) - chord.room", CORE, "HorizonBuffer.*"),
    Fault("occlusion: earth hides what is nearer", "src/core/occlusion/HorizonBuffer.cpp",
          "_pending.front().farthest <= near", "true", CORE, "HorizonBuffer.*"),
    Fault("occlusion: order does not matter", "src/core/occlusion/HorizonBuffer.cpp",
          "if (!(near > 0.0 && reach >= 0.0) || near < _reached) return false;", "if (!(near > 0.0)) return false;", CORE, "HorizonBuffer.*"),
    Fault("occlusion: strips that earth covers in part count", "src/core/occlusion/HorizonBuffer.cpp",
          "if (!(chord.left <= x0 && x1 <= chord.right)) continue;",
          "if (!(chord.left <= x1 && x0 <= chord.right)) continue;", CORE, "HorizonBuffer.*"),
    Fault("occlusion: reach is forgotten", "src/core/occlusion/HorizonBuffer.cpp",
          "pictureError(reach + rounding, forwardOf(corner),", "pictureError(rounding, forwardOf(corner),", CORE, "HorizonBuffer.*"),

    # families of tiles
    Fault("family: eyes of other cameras", "src/node/cull/TileFamily.cpp",
          "view.projection == cullStack.getProjectionMatrix() &&", "", NODE, "NestedCamera*"),
    Fault("family: whatever has the number of a tile is the tile", "src/node/cull/TileFamily.cpp",
          "std::uint64_t{_nodes[i] == group.getChild(static_cast<unsigned int>(i))}", "std::uint64_t{_nodes[i].valid()}",
          NODE, "TileFamily.*"),
    Fault("family: tiles that are taken away leave no hole", "src/node/cull/TileFamily.cpp",
          "verdicts.lacksTiles = verdicts.members != part.members;", "", NODE, "HoledGlobe.*"),
    Fault("family: decided planes are tested again", "src/node/cull/TileFamily.cpp",
          "setMask(undecided);", "", NODE, "DecidedPlanes.*"),
    Fault("family: decided planes are left to siblings", "src/node/cull/TileFamily.cpp", "setMask(before);", "", NODE,
          "DecidedPlanes.*:TileFamily.*"),
    Fault("family: tiles that are kept visible are culled", "src/node/install/InstalledTile.cpp",
          "_isSlotFilled && !isKeptVisible() && ", "_isSlotFilled && ", NODE, "AddedContent.*"),
    Fault("family: callbacks behind it are not run", "src/node/cull/TileFamily.cpp", "&group == _group && !getNestedCallback() && ",
          "&group == _group && ", NODE, "TileFamily.*"),
    Fault("family: meshes that are taken away leave no hole", "src/node/install/ContentWatch.cpp",
          "if (group && fitted < _fitted.size())", "if (group && fitted > _fitted.size())", NODE, "HoledGlobe.*"),
    Fault("family: bins that grow do not grow in it", "src/node/cull/AnalyticBinCullCallback.cpp", "    discardPrepared();\n    fillSlot();",
          "    discardPrepared();", NODE, "AddedContent.*:FalseBin*:TerrainShape*"),

    Fault("family: planes that are left out below transforms stay out for siblings", "src/node/cull/BinCulling.h",
          "~PlanesBelow() { _cullStack.getProjectionCullingStack().back().getFrustum().getCurrentMask() = _before; }",
          "~PlanesBelow() { (void)_cullStack; }", NODE, "DecidedPlanes.*"),
    Fault("family: a tile's state is not pushed", "src/node/cull/TileFamily.cpp",
          "if (state) visitor.pushStateSet(state);", "", NODE, "TileFamily.*"),
    Fault("family: a tile's node mask is not asked", "src/node/cull/TileFamily.cpp",
          "if (!nv.validNodeMask(child)) return;", "", NODE, "TileFamily.*"),
    Fault("family: other callbacks of a tile are passed over", "src/node/cull/TileFamily.cpp",
          "child.getCullCallback() == member.tile && !member.tile->getNestedCallback();", "true;", NODE, "TileFamily.*"),
    Fault("family: tiles beyond an edge are kept", "src/node/cull/TileFamily.cpp",
          "if (isBeyond) verdicts.separated |=", "if (false) verdicts.separated |=", NODE, "TileFamily.*"),
    Fault("family: an edge is no edge in the slots", "src/core/bin/BinFamily.cpp",
          "return core::isSeparated(SlotBin(", "return true || core::isSeparated(SlotBin(", CORE, "BinFamily.*"),

    # found by the generator of scenes, and in databases of others
    Fault("stored bins are believed by a quarter of the sag", "src/node/install/TileFit.cpp", "{least + sag, least, least",
          "{least + sag, least + 0.25 * sag, least", NODE, "FalseBins.*"),
    Fault("clusters in the mesh of a leaf cull", "src/node/install/BinInstaller.cpp", "} else if (!_isInMesh) {", "} else {", NODE,
          "ClusterCulling.*"),
]
