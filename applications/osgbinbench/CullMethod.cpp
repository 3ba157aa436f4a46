// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullMethod.h"

#include "Failure.h"

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

namespace osgAnalyticBin::bench {

using support::UsageError;

namespace {

// Methods of others, for comparison: a build with applications/research adds them.
const std::set<std::string> kPeerBases{"box", "orientedbox", "corners", "paper"};
#ifdef OSGANALYTICBIN_RESEARCH
constexpr bool kArePeersBuilt = true;
#else
constexpr bool kArePeersBuilt = false;
#endif

constexpr const char* kAll =
    "none sphere cluster bins box box+horizon orientedbox orientedbox+horizon orientedbox+horizon+edges corners "
    "corners+horizon paper paper+horizon quadratic quadratic+horizon quadratic+horizon+edges exact exact+horizon "
    "exact+horizon+edges exact+horizon+edges+occlusion oracle";

bool isPeer(const std::string& name) {
    return kPeerBases.count(name.substr(0, name.find('+'))) != 0;
}

CullMethod stockMethod(const std::string& name) {
    CullMethod method;
    method.cullsNothing = name == kReferenceMethod;
    method.before = method.cullsNothing ? "method=none" : "method=sphere";
    method.usesBins = false;
    // "cluster" with what a builder of databases gives it
    method.clusters = name == "cluster" ? Clusters::Fill : Clusters::Remove;
    return method;
}

CullMethod binMethod(const std::string& name) {
    std::smatch part;
    (void)std::regex_match(name, part, std::regex("([a-z]+)(\\+horizon)?(\\+edges)?(\\+occlusion)?"));
    const std::string base = part.str(1);
    const bool usesHorizon = part[2].matched, usesEdges = part[3].matched, usesOcclusion = part[4].matched;
    // terrain hides terrain for an eye that has a horizon, and not in the methods for comparison
    const bool isBin = base == "quadratic" || base == "exact";
    if (!(isBin ? usesHorizon || !usesOcclusion : isPeer(base) && !usesOcclusion))
        throw UsageError(
            "--methods: unknown method \"" + name +
            "\"; use none, sphere, cluster, bins, oracle, all, or box, orientedbox, corners, paper, quadratic or "
            "exact, these with +horizon, +edges or +horizon+edges; quadratic and exact with +horizon, also +occlusion");
    if (!isBin && !kArePeersBuilt)
        throw UsageError("--methods: \"" + name + "\" is for comparison; build with OSGANALYTICBIN_RESEARCH=ON");
    CullMethod method;
    if (!isBin) {
        method.rule = base;
        method.ruleUsesHorizon = usesHorizon;
        method.ruleTestsEdges = usesEdges;
    }
    method.before = (isBin ? "method=" + base + "," : "") + "index=on" + (usesHorizon ? ",horizon=declared" : "");
    method.after = std::string(usesHorizon ? "" : ",horizon=off") + (usesEdges ? ",edges=on" : ",edges=off") +
                   (usesOcclusion ? ",occlusion=on" : ",occlusion=off");
    return method;
}

}  // namespace

std::string CullMethod::sceneName(const std::string& database, const std::string& binOptions) const {
    const std::string options = usesBins && !binOptions.empty() ? "," + binOptions : std::string();
    return database + ".(" + before + options + after + ").analyticbin";
}

CullMethod cullMethodFromName(const std::string& name) {
    CullMethod method;
    if (name == kReferenceMethod || name == "sphere" || name == "cluster")
        method = stockMethod(name);
    else if (name == kDefaultMethod)
        method.before = "index=on";  // one that becomes complete meanwhile would change the figures
    else
        method = binMethod(name == kOracleMethod ? kReplayedMethod : name);
    method.name = name;
    method.replaysVerdicts = name == kOracleMethod;
    return method;
}

std::vector<CullMethod> cullMethodsFromNames(const std::vector<std::string>& names) {
    std::vector<CullMethod> methods{cullMethodFromName(kReferenceMethod)};
    const auto add = [&](const std::string& name) {
        const bool known = std::any_of(methods.begin(), methods.end(), [&](const auto& m) { return m.name == name; });
        if (!known) methods.push_back(cullMethodFromName(name));
    };
    for (const std::string& name : names) {
        if (name == kOracleMethod) add(kReplayedMethod);
        if (name != kAllMethods) add(name);
        std::istringstream all(name == kAllMethods ? kAll : "");
        for (std::string one; all >> one;)
            if (kArePeersBuilt || !isPeer(one)) add(one);
    }
    return methods;
}

}  // namespace osgAnalyticBin::bench
