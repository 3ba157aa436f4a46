// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <support/TemporaryFolder.h>

#if defined(_WIN32)
#include <io.h>
#endif

namespace osgAnalyticBin::test {

namespace {

// Makes a folder of a name that is new. `name`: ends in XXXXXX, which is replaced.
bool makeNewFolder(std::string& name) {
#if defined(_WIN32)
    std::error_code ignored;
    return ::_mktemp_s(name.data(), name.size() + 1) == 0 && std::filesystem::create_directory(name, ignored);
#else
    return ::mkdtemp(name.data()) != nullptr;
#endif
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "osganalyticbin-test-XXXXXX").string();
    if (!makeNewFolder(name)) throw std::runtime_error("cannot make " + name);
    _path = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(_path, ignored);
}

std::string TemporaryFolder::makeFolder(const std::string& name) const {
    std::filesystem::create_directories(*this / name);
    return *this / name;
}

std::string TemporaryFolder::write(const std::string& name, const std::string& text) const {
    std::ofstream(*this / name) << text;
    return *this / name;
}

std::string textOfFile(const std::string& file) {
    std::ifstream input(file);
    std::ostringstream text;
    text << input.rdbuf();
    return text.str();
}

Files filesBelow(const std::string& folder) {
    Files files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        files[std::filesystem::relative(entry.path(), folder).string()] = textOfFile(entry.path().string());
    }
    return files;
}

}  // namespace osgAnalyticBin::test
