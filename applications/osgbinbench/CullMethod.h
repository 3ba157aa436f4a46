// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

namespace osgAnalyticBin::bench {

/// What becomes of the ClusterCullingCallbacks of a database.
enum class Clusters {
    Keep,
    Remove,
    Fill  ///< kept; where a file has none its tiles get such as VirtualPlanetBuilder makes
};

/// A way to cull a database, by the name that the command line and the tables use:
/// BASE[+horizon][+edges][+occlusion]. A plain base culls by the frustum's planes alone.
struct CullMethod {
    std::string name;
    /// Another's rule that culls in place of the bins: RivalOptions (research/rivals). Empty: none.
    std::string rule;
    bool ruleUsesHorizon = false, ruleTestsEdges = false;
    /// What the pseudo-loader is told before and after the user's options; the last item of a key counts.
    std::string before, after;
    bool usesBins = true;  ///< whether the user's options count
    /// What becomes of the database's own ClusterCullingCallbacks; bins see to it by themselves.
    Clusters clusters = Clusters::Keep;
    bool cullsNothing = false;     ///< whether the camera culls nothing at all
    bool replaysVerdicts = false;  ///< whether what the bins decide at a pose is repeated without tests

    /// The name under which OSG reads the database with this method. `binOptions` go to the bins alone; an altitude of
    /// the horizon in them counts with methods that use the horizon.
    [[nodiscard]] std::string sceneName(const std::string& database, const std::string& binOptions) const;
};

/// The method that all others are judged by: nothing is culled.
inline constexpr const char* kReferenceMethod = "none";

/// Bins with the kit's default options, as installBins() and the pseudo-loader analyticbin put them on a database.
inline constexpr const char* kDefaultMethod = "bins";

/// What culling would cost if tests were free: the verdicts of the method below, repeated. No program can cull so.
inline constexpr const char* kOracleMethod = "oracle";
inline constexpr const char* kReplayedMethod = "exact+horizon+edges";

/// Stands for all methods that are worth comparing and built.
inline constexpr const char* kAllMethods = "all";

/// "none", "sphere", "cluster", "bins", "oracle", and box, orientedbox, corners, paper, quadratic and exact with their
/// suffixes. Throws: Failure for a name that is unknown, not built, or makes no sense.
[[nodiscard]] CullMethod cullMethodFromName(const std::string& name);

/// The methods in the order given, each once. The reference comes first, whether it was named or not, and the method
/// that the oracle repeats comes before it. "all" stands for many. Throws: Failure as above.
[[nodiscard]] std::vector<CullMethod> cullMethodsFromNames(const std::vector<std::string>& names);

}  // namespace osgAnalyticBin::bench
