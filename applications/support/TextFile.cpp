// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TextFile.h"

#include "Failure.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace osgAnalyticBin::support {

bool replaceFile(const std::string& file, const std::string& text) {
    const std::string unfinished = file + ".tmp";
    std::ofstream output(unfinished, std::ios::binary);
    output << text;
    output.close();
    std::error_code problem;
    if (output) std::filesystem::rename(unfinished, file, problem);
    if (output && !problem) return true;
    std::filesystem::remove(unfinished, problem);
    return false;
}

void writeFile(const std::string& file, const std::string& text) {
    if (!replaceFile(file, text))
        throw Failure(file + ": cannot be written; check that its folder is there and not full");
}

void requireFolderOf(const char* option, const std::string& file) {
    if (file.empty()) return;
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    if (!std::filesystem::is_directory(folder))
        throw Failure(std::string(option) + ": there is no folder " + folder.string() + "; make it first");
}

void makeFolder(const char* option, const std::string& folder) {
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (problem) throw Failure(std::string(option) + ": folder " + folder + " cannot be made");
}

std::string withDecimals(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

}  // namespace osgAnalyticBin::support
