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
/// Threads: any number at once; one installs while the others wait.
class SharedTiles {
public:
    enum class Outcome {
        Usable,    ///< installed now or before, for the same place; or drawn already by a scene without bins
        Elsewhere  ///< installed before for another place: its bins would be wrong here
    };

    [[nodiscard]] static SharedTiles& instance();

    /// Runs `install` unless bins are installed on the node already. `place`: the node's globe and frame. With a later
    /// Database::generation() it runs again for nodes that are not in the scene; the scene's are updated with it.
    [[nodiscard]] Outcome installOnce(osg::Node& node, const std::string& place, unsigned int generation,
                                      const std::function<void()>& install);

private:
    struct Installed {
        osg::observer_ptr<osg::Node> node;
        std::string place;
        unsigned int generation = 0;
    };

    void forgetDeleted();

    std::mutex _mutex;
    std::map<const osg::Node*, Installed> _installed;
    std::size_t _enough = 64;  // entries at which those of deleted nodes are looked for
};

}  // namespace osgAnalyticBin
