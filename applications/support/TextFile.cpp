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

std::string withDecimals(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

}  // namespace osgAnalyticBin::support
