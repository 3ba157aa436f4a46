// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "IndexBuilder.h"

#include <optional>
#include <string>
#include <string_view>

namespace osgbinconv {

/// A record as bytes, little endian, bit for bit the same when read back.
[[nodiscard]] std::string bytesOf(const FileRecord& record);

/// Returns: nullopt when the bytes are no record.
[[nodiscard]] std::optional<FileRecord> recordFrom(std::string_view bytes);

}  // namespace osgbinconv
