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

std::string moduleFolder() {
    return "";  // the kit stands beside the program, where OSG looks
}

#else

std::string moduleFolder() {
    Dl_info info{};
    if (dladdr(reinterpret_cast<const void*>(&methodName), &info) == 0 || !info.dli_fname) return "";
    const std::string library = info.dli_fname;
    return library.substr(0, library.rfind('/') + 1);
}

#endif

void addModuleFolder() {
    const std::string folder = moduleFolder();
    if (folder.size() > 1)
        osgDB::Registry::instance()->getLibraryFilePathList().push_back(folder.substr(0, folder.size() - 1));
}

}  // namespace osgAnalyticBin
