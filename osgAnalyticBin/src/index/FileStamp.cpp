// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/index/DatabaseFiles.h>

#if defined(_WIN32)
#include <windows.h>
#else
#include <sys/stat.h>
#endif

namespace osgAnalyticBin::indexing {

#if defined(_WIN32)

FileStamp stampOfPath(const std::string& path) {
    WIN32_FILE_ATTRIBUTE_DATA status{};
    if (!::GetFileAttributesExA(path.c_str(), GetFileExInfoStandard, &status)) return {};
    const auto joined = [](DWORD high, DWORD low) { return (static_cast<std::uint64_t>(high) << 32) | low; };
    constexpr std::int64_t kTicks = 10000000;        // a second, in units of 100 ns
    constexpr std::int64_t kEpochs = 11644473600LL;  // seconds from 1601 to 1970
    const auto time =
        static_cast<std::int64_t>(joined(status.ftLastWriteTime.dwHighDateTime, status.ftLastWriteTime.dwLowDateTime));
    return {joined(status.nFileSizeHigh, status.nFileSizeLow), time / kTicks - kEpochs, time % kTicks * 100};
}

#else

FileStamp stampOfPath(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return {};
    return {static_cast<std::uint64_t>(status.st_size), static_cast<std::int64_t>(status.st_mtim.tv_sec),
            static_cast<std::int64_t>(status.st_mtim.tv_nsec)};
}

#endif

}  // namespace osgAnalyticBin::indexing
