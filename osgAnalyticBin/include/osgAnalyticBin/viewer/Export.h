// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#if defined(_WIN32) && defined(OSGANALYTICBIN_STATIC)
#define OSGANALYTICBINVIEWER_EXPORT
#elif defined(_WIN32)
#if defined(osgAnalyticBinViewer_EXPORTS)
#define OSGANALYTICBINVIEWER_EXPORT __declspec(dllexport)
#else
#define OSGANALYTICBINVIEWER_EXPORT __declspec(dllimport)
#endif
#else
#define OSGANALYTICBINVIEWER_EXPORT __attribute__((visibility("default")))
#endif
