// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <string>
#include <utility>

namespace osgAnalyticBin::flight {

enum class Applied { Yes, Unknown, Malformed };

[[nodiscard]] inline Applied applied(bool success) {
    return success ? Applied::Yes : Applied::Malformed;
}

/// Takes a number that is in the range. Returns: whether `value` is one.
[[nodiscard]] bool setNumber(double& target, const std::string& value, double least, double most);

/// As setNumber(), for a whole number.
[[nodiscard]] bool setWhole(int& target, const std::string& value, int least, int most);

/// Reads the parameters, "key=value", of a pseudo-loader: those in the brackets of a file's name, which are its own,
/// and those in an option string, where words of other plugins may stand too.
class ParameterReader {
public:
    using Apply = std::function<Applied(const std::string& key, const std::string& value)>;

    /// `apply` takes one parameter; `allowed` lists them in messages.
    ParameterReader(Apply apply, std::string allowed) : _apply(std::move(apply)), _allowed(std::move(allowed)) {}

    /// Parted by commas. Returns: false, with one line in `error`, for one that is unknown or malformed.
    bool readBracketed(const std::string& parameters, std::string& error) const;

    /// Parted by blanks or commas. Returns: false, with one line in `error`, for one that is malformed.
    bool readOptionString(const std::string& options, std::string& error) const;

private:
    [[nodiscard]] Applied applyItem(const std::string& item) const;
    [[nodiscard]] std::string complaint(const std::string& item, const char* what) const;

    Apply _apply;
    std::string _allowed;
};

}  // namespace osgAnalyticBin::flight
