// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin {

/// Reads numbers separated by blanks, independent of the locale.
/// Returns: nullopt when the text holds anything but `count` finite numbers.
[[nodiscard]] std::optional<std::vector<double>> numbersFromText(const std::string& text, std::size_t count);

/// The shortest decimal that reads back as the same double, independent of the locale.
[[nodiscard]] std::string numberToText(double value);

/// Numbers separated by single blanks.
[[nodiscard]] std::string numbersToText(const std::vector<double>& values);

}  // namespace osgAnalyticBin
