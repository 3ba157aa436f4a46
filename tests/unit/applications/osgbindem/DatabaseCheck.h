// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DatabaseWalk.h"

#include <functional>
#include <string>
#include <vector>

/// Builds a database by a command line, to which -o is added, and loads it. With a raster: by the raster's file and
/// these options.
[[nodiscard]] LoadedDatabase databaseOf(std::vector<std::string> words);
[[nodiscard]] LoadedDatabase databaseOf(const TestRaster& raster, std::vector<std::string> options = {});

/// The heights that the bin of a tile has to hold.
using SourceRange = std::function<Range(const Rect&)>;

/// Everything that holds for every database; failures are reported as GoogleTest failures.
void checkDatabase(const LoadedDatabase& database, const SourceRange& source);
void checkDatabase(const LoadedDatabase& database, const TestRaster& source);

/// Bins hold the source, the drawn triangles and the bins below, and are not much larger.
void checkBins(const LoadedDatabase& database, const SourceRange& source);

/// Tiles of one level draw their common posts at the same points, round the globe; children draw their parent's posts.
void checkSharedPosts(const LoadedDatabase& database);

/// The nodes are those that a database is made of, and OpenSceneGraph's own bounds hold.
void checkNodes(const LoadedDatabase& database);
