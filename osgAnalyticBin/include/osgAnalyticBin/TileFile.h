// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>

#include <osgDB/ReaderWriter>

#include <string>

namespace osgAnalyticBin {

/// Reads a tile as osgDB::Registry does, but stops at the end of a truncated file. OSG's own reader would continue with
/// undefined values and block the pager's thread for minutes. Local files in OSG's native formats are guarded; all
/// others, those in archives and on servers among them, are left to the Registry. Throws: std::exception when a guarded
/// file ends too early or asks for more memory than there is.
[[nodiscard]] OSGANALYTICBIN_EXPORT osgDB::ReaderWriter::ReadResult readTileFile(const std::string& fileName,
                                                                                 const osgDB::Options* options);

}  // namespace osgAnalyticBin
