// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FileSum.h"

#include "Checksum.h"

namespace osgbindem {

using osgAnalyticBin::support::checksumOf;

void FileSum::add(const TileId& tile, std::string_view content) noexcept {
    ++files;
    bytes += content.size();
    const int place[] = {tile.level, tile.x, tile.y};
    checksum += checksumOf(content, checksumOf({reinterpret_cast<const char*>(place), sizeof place}));
}

}  // namespace osgbindem
