// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace osgAnalyticBin {

/// What a pseudo-loader is asked for, without its extension: "earth.osgb" and "method=exact,edges=off".
struct NameParameters {
    std::string name;        ///< what stands before the brackets
    std::string parameters;  ///< empty when there are no brackets
};

/// Divides "earth.osgb.(method=exact,edges=off)". The name may be missing: "(levels=12)".
[[nodiscard]] inline NameParameters nameParametersFrom(const std::string& text) {
    if (text.empty() || text.back() != ')') return {text, {}};
    if (const std::size_t open = text.rfind(".("); open != std::string::npos)
        return {text.substr(0, open), text.substr(open + 2, text.size() - open - 3)};
    if (text.front() == '(') return {{}, text.substr(1, text.size() - 2)};
    return {text, {}};
}

}  // namespace osgAnalyticBin
