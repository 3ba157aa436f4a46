// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#if defined(_WIN32) && defined(OSGANALYTICBIN_STATIC)
#define OSGANALYTICBIN_EXPORT
#elif defined(_WIN32)
#if defined(osgAnalyticBin_EXPORTS)
#define OSGANALYTICBIN_EXPORT __declspec(dllexport)
#else
#define OSGANALYTICBIN_EXPORT __declspec(dllimport)
#endif
#else
#define OSGANALYTICBIN_EXPORT __attribute__((visibility("default")))
#endif
