// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

namespace osgAnalyticBin {

/// Tells OpenSceneGraph to look for plugins and serializers beside the kit's library too: that is where this project's
/// own stand, in a build folder and below any prefix. To be called before the first file is read.
void addModuleFolder();

}  // namespace osgAnalyticBin
