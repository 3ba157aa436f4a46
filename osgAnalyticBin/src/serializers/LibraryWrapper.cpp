// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgDB/Registry>

USE_SERIALIZER_WRAPPER(osgAnalyticBin_AnalyticBinCullCallback)
USE_SERIALIZER_WRAPPER(osgAnalyticBin_ContentWatch)
USE_SERIALIZER_WRAPPER(osgAnalyticBin_InstallBinsCallback)
USE_SERIALIZER_WRAPPER(osgAnalyticBin_PackedTerrain)

extern "C" __attribute__((visibility("default"))) void wrapper_serializer_library_osgAnalyticBin(void) {}
