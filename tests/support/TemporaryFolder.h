// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#if defined(_WIN32)
#include <io.h>
#endif

namespace osgAnalyticBin::test {

/// A folder that is empty at first and deleted at the end.
class TemporaryFolder {
public:
    TemporaryFolder() : _path((std::filesystem::temp_directory_path() / "osganalyticbin-test-XXXXXX").string()) {
#if defined(_WIN32)
        std::error_code ignored;
        const bool isMade =
            ::_mktemp_s(_path.data(), _path.size() + 1) == 0 && std::filesystem::create_directory(_path, ignored);
#else
        const bool isMade = ::mkdtemp(_path.data()) != nullptr;
#endif
        if (!isMade) throw std::runtime_error("cannot make " + _path);
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(_path, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::string& path() const {
        return _path;
    }
    [[nodiscard]] std::string operator/(const std::string& name) const {
        return _path + "/" + name;
    }

    /// Makes a folder in it. Returns: its path.
    [[nodiscard]] std::string makeFolder(const std::string& name) const {
        std::filesystem::create_directories(*this / name);
        return *this / name;
    }

    /// Writes a text file into it. Returns: its path.
    [[nodiscard]] std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(*this / name) << text;
        return *this / name;
    }

private:
    std::string _path;
};

/// The whole file; empty when it cannot be read.
[[nodiscard]] inline std::string textOfFile(const std::string& file) {
    std::ifstream input(file);
    std::ostringstream text;
    text << input.rdbuf();
    return text.str();
}

/// Files by name, seen from their folder, with what is in them.
using Files = std::map<std::string, std::string>;
/// All files below a folder.
[[nodiscard]] inline Files filesBelow(const std::string& folder) {
    Files files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        files[std::filesystem::relative(entry.path(), folder).string()] = textOfFile(entry.path().string());
    }
    return files;
}

}  // namespace osgAnalyticBin::test
