// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "WholeFile.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace osgAnalyticBin {

bool writeWholeFile(const std::string& path, const std::function<bool(std::ostream&)>& write, std::string& error) {
    const std::string temporary = path + ".tmp";
    errno = 0;
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    const bool isWritten = out && write(out) && out.flush();
    out.close();
    if (isWritten && out) {
        std::error_code problem;
        std::filesystem::rename(temporary, path, problem);  // replaces a file that is there, also on Windows
        if (!problem) return true;
        errno = problem.default_error_condition().value();
    }
    error = "cannot write \"" + path + "\": " + std::strerror(errno) + "; make room or choose another folder";
    std::remove(temporary.c_str());
    return false;
}

}  // namespace osgAnalyticBin
