// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <string>
#include <vector>

namespace osgAnalyticBin::flight {

/// A parameter "key=value" of a pseudo-loader: what its plugin says of it, and what reads it.
struct Parameter {
    const char* text;     ///< with the values that are allowed, as "frames=1..1000"
    const char* meaning;  ///< for osgconv --format
    /// Takes the value. Returns: whether it is allowed.
    std::function<bool(const std::string& value)> take;
};

/// Takes a number that is in the range, or a whole one.
[[nodiscard]] std::function<bool(const std::string&)> numberInto(double& target, double least, double most);
[[nodiscard]] std::function<bool(const std::string&)> wholeInto(int& target, int least, int most);

/// Reads the parameters in the brackets of a file's name, which are its own, parted by commas.
/// Throws: Failure for one that is unknown or malformed.
void readBracketed(const std::vector<Parameter>& known, const std::string& text);

}  // namespace osgAnalyticBin::flight
