// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What several tests of the node kit need.

#pragma once

#include "ApplicationGlobe.h"
#include "CameraGlobe.h"
#include "PlanarMap.h"

#include <osgAnalyticBin/CoveredPicture.h>
#include <osgAnalyticBin/InstallBinsCallback.h>
#include <osgAnalyticBin/TileFinder.h>
#include <osgAnalyticBin/TileSurface.h>

#include <osg/AutoTransform>
#include <osg/Billboard>
#include <osg/ClusterCullingCallback>
#include <osg/Depth>
#include <osg/LOD>
#include <osg/LightSource>
#include <osg/Projection>
#include <osg/Texture2D>
#include <osg/ValueObject>
#include <osgDB/Registry>
#include <osgTerrain/GeometryTechnique>
#include <osgTerrain/ValidDataOperator>

#include <chrono>
#include <support/AnyScene.h>
#include <support/CapturedNotes.h>
#include <support/SyntheticDatabase.h>
#include <thread>
