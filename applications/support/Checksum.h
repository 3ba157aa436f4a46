// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace osgAnalyticBin::support {

/// Tells damaged bytes from whole ones; no protection against forgers. Some gigabytes a second.
[[nodiscard]] std::uint64_t checksumOf(std::string_view bytes, std::uint64_t seed = 0) noexcept;

/// The bytes with their checksum behind them, as memory has it.
[[nodiscard]] std::string withChecksum(std::string bytes);

/// Returns: the bytes before the checksum; nullopt when they are damaged.
[[nodiscard]] std::optional<std::string_view> wholeBytes(std::string_view bytes) noexcept;

}  // namespace osgAnalyticBin::support
