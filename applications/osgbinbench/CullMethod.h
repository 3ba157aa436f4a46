// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

namespace osgAnalyticBin::bench {

/// A way to cull a database, by the name that the command line and the tables use.
struct CullMethod {
    std::string name;
    /// What the pseudo-loader analyticbin is asked for.
    std::string loaderMethod;
    /// Whether the database's own ClusterCullingCallbacks are taken away.
    bool removesClusters = false;
    /// Whether the camera culls nothing at all.
    bool cullsNothing = false;

    [[nodiscard]] bool usesBins() const { return loaderMethod != "sphere" && loaderMethod != "none"; }

    /// The name under which OSG reads the database with this method. `binOptions` go to the bins alone.
    [[nodiscard]] std::string sceneName(const std::string& database, const std::string& binOptions) const;
};

/// The method that all others are judged by: nothing is culled.
inline constexpr const char* kReferenceMethod = "none";

/// "none", "sphere", "cluster" and the names of the kit's bins, with the culling they stand for.
/// Throws: Failure for an unknown name.
[[nodiscard]] CullMethod cullMethodFromName(const std::string& name);

/// The methods in the order given, each once, the reference in front whether it was named or not.
/// Throws: Failure for an unknown name.
[[nodiscard]] std::vector<CullMethod> cullMethodsFromNames(const std::vector<std::string>& names);

}  // namespace osgAnalyticBin::bench
