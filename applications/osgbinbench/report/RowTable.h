// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace osgAnalyticBin::report {

/// A row of a table is an object: its keys name the columns.
using Json = nlohmann::ordered_json;

/// A cell for people: with so many decimals unless it is a text or a whole number.
[[nodiscard]] std::string cellText(const Json& value, int decimals);

/// Comma-separated values: a line with the columns of all rows, in the order in which they first come, then a line for
/// each row. Numbers read back exactly; a cell that a row does not have is empty; texts with a comma are quoted.
[[nodiscard]] std::string csvOf(const std::vector<Json>& rows);

/// The value over the reference; "-" where that is not above zero.
[[nodiscard]] std::string ratioText(double value, double reference);

/// Every number of an object over that of the same key of another one, as a text.
[[nodiscard]] Json ratiosOf(const Json& row, const Json& reference);

}  // namespace osgAnalyticBin::report
