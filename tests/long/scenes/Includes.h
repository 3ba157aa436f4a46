// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What several sources of this folder need.

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/Declarations.h>
#include <osgAnalyticBin/InstallBins.h>

#include <osg/ArgumentParser>
#include <osg/Billboard>
#include <osg/Camera>
#include <osg/CoordinateSystemNode>
#include <osg/Drawable>
#include <osg/FrameStamp>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/Image>
#include <osg/LOD>
#include <osg/MatrixTransform>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/NodeCallback>
#include <osg/NodeVisitor>
#include <osg/Notify>
#include <osg/PagedLOD>
#include <osg/PolygonMode>
#include <osg/Program>
#include <osg/Sequence>
#include <osg/StateSet>
#include <osg/Switch>
#include <osg/Vec3d>
#include <osgDB/DatabasePager>
#include <osgDB/Options>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgTerrain/Layer>
#include <osgTerrain/Terrain>
#include <osgTerrain/TerrainTile>
#include <osgUtil/CullVisitor>
#include <osgUtil/IntersectionVisitor>
#include <osgUtil/LineSegmentIntersector>
#include <osgUtil/RenderBin>
#include <osgUtil/UpdateVisitor>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <kit/CullFixture.h>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <support/Random.h>
#include <type_traits>
#include <utility>
#include <vector>
