// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "FailedReads.h"

#include <osgDB/Options>
#include <osgDB/ReadFile>
#include <osgDB/ReaderWriter>

#include <functional>
#include <string>

namespace osgAnalyticBin {

/// A read that failed, with a line that says why.
[[nodiscard]] osgDB::ReaderWriter::ReadResult unreadable(const std::string& fileName, const char* why);

/// Reads by the callback that was there before, if any, else by the Registry's, else by OSG.
[[nodiscard]] osgDB::ReaderWriter::ReadResult readPlain(const std::string& fileName, const osgDB::Options* options,
                                                        osgDB::ReadFileCallback* previous);

/// Runs `read`, unless the file failed lately. What it throws becomes unreadable(): a corrupt file may ask for absurd
/// amounts of memory, and the pager's thread must outlive that.
[[nodiscard]] osgDB::ReaderWriter::ReadResult readCarefully(
    const std::string& fileName, FailedReads& failures, const std::function<osgDB::ReaderWriter::ReadResult()>& read);

}  // namespace osgAnalyticBin
