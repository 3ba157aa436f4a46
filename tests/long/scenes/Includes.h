// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What several sources of this folder need.

#pragma once

#include <osgAnalyticBin/InstallBins.h>

#include <osg/ArgumentParser>
#include <osg/Billboard>
#include <osg/Depth>
#include <osg/Drawable>
#include <osg/Geode>
#include <osg/Image>
#include <osg/LOD>
#include <osg/MatrixTransform>
#include <osg/Notify>
#include <osg/PagedLOD>
#include <osg/PolygonMode>
#include <osg/Sequence>
#include <osg/StateSet>
#include <osg/Switch>
#include <osgDB/DatabasePager>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgTerrain/Layer>
#include <osgTerrain/Terrain>
#include <osgTerrain/TerrainTile>
#include <osgUtil/IntersectionVisitor>
#include <osgUtil/LineSegmentIntersector>
#include <osgUtil/RenderBin>
#include <osgUtil/UpdateVisitor>

#include <chrono>
#include <cstdio>
#include <kit/CullFixture.h>
#include <sstream>
#include <support/Random.h>
#include <type_traits>
