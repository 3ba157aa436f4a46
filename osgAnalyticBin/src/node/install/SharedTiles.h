// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>
#include <osg/observer_ptr>

#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <string>

namespace osgAnalyticBin {

/// Nodes that a user's read callback keeps, and so may hand out more than once, to several threads, or while they are
/// being drawn: bins are installed on each only once.
/// Threads: any number at once; one treats while the others wait.
class SharedTiles {
public:
    enum class Outcome {
        Usable,    ///< treated now or before, for the same place; or drawn already by a scene without bins
        Elsewhere  ///< treated before for another place: its bins would be wrong here
    };

    [[nodiscard]] static SharedTiles& instance();

    /// Runs `treat` unless the node was treated before. `place`: where on which globe the node stands. A later
    /// `generation` of the globe's options treats anew what is not in its scene just now; what is there follows with
    /// it.
    [[nodiscard]] Outcome treatOnce(osg::Node& node, const std::string& place, unsigned int generation,
                                    const std::function<void()>& treat);

private:
    struct Treated {
        osg::observer_ptr<osg::Node> node;
        std::string place;
        unsigned int generation = 0;
    };

    void forgetDeleted();

    std::mutex _mutex;
    std::map<const osg::Node*, Treated> _treated;
    std::size_t _enough = 64;  // entries at which those of deleted nodes are looked for
};

}  // namespace osgAnalyticBin
