// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullMethod.h"

#include "Failure.h"

#include <osgAnalyticBin/CullOptions.h>

#include <algorithm>

namespace osgAnalyticBin::bench {

std::string CullMethod::sceneName(const std::string& database, const std::string& binOptions) const {
    std::string parameters = "method=" + loaderMethod;
    if (usesBins() && !binOptions.empty()) parameters += "," + binOptions;
    return database + ".(" + parameters + ").analyticbin";
}

CullMethod cullMethodFromName(const std::string& name) {
    if (name == kReferenceMethod) return {name, "none", true, true};
    if (name == "sphere") return {name, "sphere", true, false};
    // Stock OSG, as the database was shipped.
    if (name == "cluster") return {name, "sphere", false, false};
    if (methodFromName(name)) return {name, name, false, false};
    throw Failure("--methods: unknown method \"" + name +
                  "\"; use none, sphere, cluster, quadratic, exact, paper or corners");
}

std::vector<CullMethod> cullMethodsFromNames(const std::vector<std::string>& names) {
    std::vector<CullMethod> methods{cullMethodFromName(kReferenceMethod)};
    for (const std::string& name : names) {
        const bool known = std::any_of(methods.begin(), methods.end(), [&](const auto& m) { return m.name == name; });
        if (!known) methods.push_back(cullMethodFromName(name));
    }
    return methods;
}

}  // namespace osgAnalyticBin::bench
