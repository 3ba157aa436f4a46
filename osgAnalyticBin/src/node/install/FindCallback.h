// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Callback>

namespace osgAnalyticBin {

/// Searches a chain of nested callbacks. Returns: the first one of the class; nullptr when there is none.
template <class Callback>
[[nodiscard]] Callback* findCallback(osg::Callback* first) {
    for (osg::Callback* callback = first; callback; callback = callback->getNestedCallback()) {
        if (auto* found = dynamic_cast<Callback*>(callback)) return found;
    }
    return nullptr;
}

}  // namespace osgAnalyticBin
