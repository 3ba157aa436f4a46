// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <vector>

namespace osgAnalyticBin::bench {

/// Replaces what the processor's data caches hold, as drawing a frame between two cull traversals does.
class CacheFlusher {
public:
    /// Takes a buffer of so many MiB: more than the last-level cache holds.
    explicit CacheFlusher(int mebibytes);

    /// Reads and writes every cache line of the buffer.
    void flush();

    [[nodiscard]] const std::vector<unsigned char>& buffer() const { return _buffer; }

    /// Twice the last-level cache of the first processor, 64 at least.
    [[nodiscard]] static int defaultMebibytes();

    /// No processor that runs this has shorter lines.
    static constexpr std::size_t kCacheLine = 64;

private:
    std::vector<unsigned char> _buffer;
};

}  // namespace osgAnalyticBin::bench
