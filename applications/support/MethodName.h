// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <string_view>

namespace osgAnalyticBin::support {

/// The name of a culling method, as it is spelt now: "orientedbox+horizon+edges" for "orientedBox+horizon+reverse".
[[nodiscard]] inline std::string currentMethodName(std::string name) {
    const auto replace = [&](std::string_view old, std::string_view now) {
        const std::size_t at = name.find(old);
        if (at != std::string::npos) name.replace(at, old.size(), now);
    };
    replace("orientedBox", "orientedbox");
    replace("+reverse", "+edges");
    return name;
}

/// One line that says so where a name is spelt as it was; empty where it is not.
[[nodiscard]] inline std::string noticeOfOldName(const std::string& name) {
    const std::string now = currentMethodName(name);
    return now == name ? std::string()
                       : "the method " + name + " is called " + now + " now; the old name is still read\n";
}

}  // namespace osgAnalyticBin::support
