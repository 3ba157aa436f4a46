// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileLayout.h"

#include <cstdint>
#include <string_view>

namespace osgbindem {

/// What the files below a tile add up to, in whatever order they were written or read back.
struct FileSum {
    std::uint64_t files = 0;
    std::uint64_t bytes = 0;
    std::uint64_t checksum = 0;

    /// The file with the children of a tile.
    void add(const TileId& tile, std::string_view content) noexcept;

    [[nodiscard]] bool operator==(const FileSum& other) const noexcept {
        return files == other.files && bytes == other.bytes && checksum == other.checksum;
    }
};

}  // namespace osgbindem
