// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullMethod.h"

#include "Failure.h"

#include <algorithm>
#include <array>

namespace osgAnalyticBin::bench {

using support::UsageError;

namespace {

constexpr std::array<const char*, 2> kBinBases{"quadratic", "exact"};
constexpr std::array<const char*, 4> kPeerBases{"box", "orientedbox", "corners", "paper"};
#ifdef OSGANALYTICBIN_RESEARCH
constexpr bool kArePeersBuilt = true;
#else
constexpr bool kArePeersBuilt = false;
#endif

constexpr std::array<const char*, 21> kAll{"none",
                                           "sphere",
                                           "cluster",
                                           kDefaultMethod,
                                           "box",
                                           "box+horizon",
                                           "orientedbox",
                                           "orientedbox+horizon",
                                           "orientedbox+horizon+edges",
                                           "corners",
                                           "corners+horizon",
                                           "paper",
                                           "paper+horizon",
                                           "quadratic",
                                           "quadratic+horizon",
                                           "quadratic+horizon+edges",
                                           "exact",
                                           "exact+horizon",
                                           kReplayedMethod,
                                           "exact+horizon+edges+occlusion",
                                           kOracleMethod};

// Takes a suffix off the end of a name. Returns: whether it was there.
bool takeSuffix(std::string& name, const std::string& suffix) {
    if (name.size() < suffix.size() || name.compare(name.size() - suffix.size(), suffix.size(), suffix) != 0)
        return false;
    name.resize(name.size() - suffix.size());
    return true;
}

template <std::size_t Count>
bool isOneOf(const std::array<const char*, Count>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool isPeer(const std::string& name) {
    return isOneOf(kPeerBases, name.substr(0, name.find('+')));
}

}  // namespace

std::string CullMethod::sceneName(const std::string& database, const std::string& binOptions) const {
    // an index that becomes complete meanwhile would change the figures
    if (isDefault) return database + ".(index=on" + (binOptions.empty() ? "" : "," + binOptions) + ").analyticbin";
    std::string parameters = "method=" + loaderMethod;
    if (usesBins()) {
        parameters += ",index=on";
        // the last item of a key counts
        if (usesHorizon) parameters += ",horizon=declared";
        if (!binOptions.empty()) parameters += "," + binOptions;
        if (!usesHorizon) parameters += ",horizon=off";
        parameters += usesEdges ? ",edges=on" : ",edges=off";
        parameters += usesOcclusion ? ",occlusion=on" : ",occlusion=off";
    }
    return database + ".(" + parameters + (usesRivals() ? ").binrival" : ").analyticbin");
}

bool CullMethod::usesRivals() const {
    return isOneOf(kPeerBases, loaderMethod);
}

CullMethod cullMethodFromName(const std::string& name) {
    if (name == kOracleMethod) {
        CullMethod oracle = cullMethodFromName(kReplayedMethod);
        oracle.name = name;
        oracle.replaysVerdicts = true;
        return oracle;
    }
    if (isPeer(name) && !kArePeersBuilt)
        throw UsageError("--methods: \"" + name + "\" is for comparison; build with OSGANALYTICBIN_RESEARCH=ON");
    CullMethod method;
    method.name = name;
    method.cullsNothing = name == kReferenceMethod;
    // stock OSG, "cluster" with what a builder of databases gives it
    if (method.cullsNothing || name == "sphere" || name == "cluster") {
        method.loaderMethod = method.cullsNothing ? "none" : "sphere";
        method.clusters = name == "cluster" ? Clusters::Fill : Clusters::Remove;
        return method;
    }
    method.isDefault = name == kDefaultMethod;
    if (method.isDefault) {
        method.loaderMethod = name;
        method.usesHorizon = method.usesEdges = method.usesOcclusion = true;
        return method;
    }
    std::string base = name;
    method.usesOcclusion = takeSuffix(base, "+occlusion");
    method.usesEdges = takeSuffix(base, "+edges");
    method.usesHorizon = takeSuffix(base, "+horizon");
    if (isOneOf(kBinBases, base) || isOneOf(kPeerBases, base)) method.loaderMethod = base;
    // terrain hides terrain for an eye that has a horizon, and not in the methods for comparison
    const bool makesSense = !method.usesOcclusion || (method.usesHorizon && (base == "exact" || base == "quadratic"));
    if (!method.loaderMethod.empty() && makesSense) return method;
    throw UsageError(
        "--methods: unknown method \"" + name +
        "\"; use none, sphere, cluster, bins, oracle, all, or box, orientedbox, corners, paper, "
        "quadratic or exact, these with +horizon, +edges or +horizon+edges; quadratic and exact with "
        "+horizon, also +occlusion");
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
        for (const char* const one : kAll)
            if (name == kAllMethods && (kArePeersBuilt || !isPeer(one))) add(one);
    }
    return methods;
}

}  // namespace osgAnalyticBin::bench
