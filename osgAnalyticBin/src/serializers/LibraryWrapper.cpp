// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgDB/Registry>

USE_SERIALIZER_WRAPPER(osgAnalyticBin_AnalyticBinCullCallback)
USE_SERIALIZER_WRAPPER(osgAnalyticBin_ContentWatch)
USE_SERIALIZER_WRAPPER(osgAnalyticBin_HiddenByTerrainCallback)
USE_SERIALIZER_WRAPPER(osgAnalyticBin_InstallBinsCallback)

#if defined(_WIN32)
#define OSGANALYTICBIN_WRAPPER_EXPORT __declspec(dllexport)
#else
#define OSGANALYTICBIN_WRAPPER_EXPORT __attribute__((visibility("default")))
#endif

extern "C" OSGANALYTICBIN_WRAPPER_EXPORT void wrapper_serializer_library_osgAnalyticBin(void) {}
