// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace osgAnalyticBin {

/// The folder of the kit's library, of the program where the kit is static, with a slash behind; empty where the system
/// does not say it.
[[nodiscard]] std::string moduleFolder();

/// Tells OpenSceneGraph to look for plugins and serializers beside the kit's library too: that is where this project's
/// own stand, in a build folder and below any prefix. To be called before the first file is read.
void addModuleFolder();

}  // namespace osgAnalyticBin
