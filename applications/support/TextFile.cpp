// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TextFile.h"

#include "Failure.h"
#include "WholeFile.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace osgAnalyticBin::support {

void writeFile(const std::string& file, const std::string& text) {
    writeFile(file, [&text](std::ostream& out) { return (out << text).good(); });
}

void writeFile(const std::string& file, const std::function<bool(std::ostream&)>& write) {
    std::string error;
    if (!writeWholeFile(file, write, error)) throw Failure(error);
}

std::string contentOf(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void requireFolderOf(const char* option, const std::string& file) {
    if (file.empty()) return;
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    if (!std::filesystem::is_directory(folder))
        throw Failure(std::string(option) + ": there is no folder " + folder.string() + "; make it first");
}

void makeFolder(const std::string& folder) {
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (problem) throw Failure("cannot create \"" + folder + "\": " + problem.message() + "; choose another folder");
}

std::string withDecimals(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

}  // namespace osgAnalyticBin::support
