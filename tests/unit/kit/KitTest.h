// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What several tests of the node kit need.

#pragma once

#include "ApplicationGlobe.h"
#include "CameraGlobe.h"
#include "CullFixture.h"
#include "DatabaseFixture.h"
#include "PlanarMap.h"
#include "TileFixture.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/CoveredPicture.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/Declarations.h>
#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/InstallBinsCallback.h>
#include <osgAnalyticBin/TileFinder.h>
#include <osgAnalyticBin/TileSurface.h>

#include <gtest/gtest.h>
#include <osg/AutoTransform>
#include <osg/Billboard>
#include <osg/Camera>
#include <osg/ClusterCullingCallback>
#include <osg/CoordinateSystemNode>
#include <osg/Depth>
#include <osg/Drawable>
#include <osg/FrameStamp>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/LOD>
#include <osg/LightSource>
#include <osg/MatrixTransform>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/NodeCallback>
#include <osg/PagedLOD>
#include <osg/Projection>
#include <osg/Texture2D>
#include <osg/ValueObject>
#include <osg/Viewport>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgDB/WriteFile>
#include <osgTerrain/GeometryTechnique>
#include <osgTerrain/Layer>
#include <osgTerrain/Terrain>
#include <osgTerrain/TerrainTile>
#include <osgTerrain/ValidDataOperator>
#include <osgUtil/CullVisitor>
#include <osgUtil/PositionalStateContainer>
#include <osgUtil/RenderStage>
#include <osgUtil/StateGraph>
#include <osgUtil/UpdateVisitor>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <support/CapturedNotes.h>
#include <support/GridMesh.h>
#include <support/Random.h>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>
#include <support/VisitNodes.h>
#include <thread>
#include <utility>
#include <vector>
