// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ModuleFolder.h"

#include <osgAnalyticBin/CullOptions.h>

#include <osgDB/Registry>

#include <string>
#if !defined(_WIN32)
#include <dlfcn.h>
#endif

namespace osgAnalyticBin {

#if defined(_WIN32)

void addModuleFolder() {
    // the kit stands beside the program, where OSG looks
}

#else

void addModuleFolder() {
    Dl_info info{};
    if (dladdr(reinterpret_cast<const void*>(&methodName), &info) == 0 || !info.dli_fname) return;
    const std::string library = info.dli_fname;
    const auto slash = library.rfind('/');
    if (slash == std::string::npos) return;
    osgDB::Registry::instance()->getLibraryFilePathList().push_back(library.substr(0, slash));
}

#endif

}  // namespace osgAnalyticBin
