// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>

#include <osgDB/ReaderWriter>

#include <string>

namespace osgAnalyticBin {

/// Reads a tile as osgDB::Registry does, but stops at the end of a truncated file. OSG's own reader would continue with
/// undefined values and block the pager's thread for minutes. This works for local files in OSG's native formats; other
/// files, also those in archives and on servers, and those that an application has registered a reader for, are read by
/// the Registry alone. Throws: std::exception when such a local file ends too early or needs more memory than there is.
[[nodiscard]] OSGANALYTICBIN_EXPORT osgDB::ReaderWriter::ReadResult readTileFile(const std::string& fileName,
                                                                                 const osgDB::Options* options);

}  // namespace osgAnalyticBin
