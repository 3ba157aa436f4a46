// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <map>
#include <string>

namespace osgAnalyticBin::test {

/// A folder that is empty at first and deleted at the end.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::string& path() const { return _path; }
    [[nodiscard]] std::string operator/(const std::string& name) const { return _path + "/" + name; }

    /// Makes a folder in it. Returns: its path.
    [[nodiscard]] std::string makeFolder(const std::string& name) const;

    /// Writes a text file into it. Returns: its path.
    [[nodiscard]] std::string write(const std::string& name, const std::string& text) const;

private:
    std::string _path;
};

/// The whole file; empty when it cannot be read.
[[nodiscard]] std::string textOfFile(const std::string& file);

/// Files by name, seen from their folder, with what is in them.
using Files = std::map<std::string, std::string>;
/// All files below a folder.
[[nodiscard]] Files filesBelow(const std::string& folder);

}  // namespace osgAnalyticBin::test
