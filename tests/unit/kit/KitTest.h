// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What several tests of the node kit need.

#pragma once

#include "ApplicationGlobe.h"
#include "CameraGlobe.h"
#include "PlanarMap.h"
#include "TileFixture.h"

#include <osgAnalyticBin/CoveredPicture.h>
#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/InstallBinsCallback.h>
#include <osgAnalyticBin/TileFinder.h>
#include <osgAnalyticBin/TileSurface.h>

#include <gtest/gtest.h>
#include <osg/AutoTransform>
#include <osg/Billboard>
#include <osg/ClusterCullingCallback>
#include <osg/Depth>
#include <osg/FrameStamp>
#include <osg/LOD>
#include <osg/LightSource>
#include <osg/Projection>
#include <osg/Texture2D>
#include <osg/ValueObject>
#include <osg/Viewport>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgDB/WriteFile>
#include <osgTerrain/GeometryTechnique>
#include <osgTerrain/Layer>
#include <osgTerrain/ValidDataOperator>
#include <osgUtil/PositionalStateContainer>
#include <osgUtil/RenderStage>
#include <osgUtil/StateGraph>
#include <osgUtil/UpdateVisitor>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <support/CapturedNotes.h>
#include <support/GridMesh.h>
#include <support/SyntheticDatabase.h>
#include <support/VisitNodes.h>
#include <thread>
