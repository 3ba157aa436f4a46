// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../tile/TerrainHider.h"
#include "CullTraversal.h"
#include "GroundBelow.h"
#include "HidingView.h"

#include <osg/NodeVisitor>
#include <osg/Referenced>
#include <osg/ref_ptr>

#include <utility>
#include <vector>

namespace osgAnalyticBin {

class InstalledDatabase;

/// What a cull visitor keeps from view to view for searches among the tiles that are shown.
class SearchMemory final : public osg::Referenced {
public:
    /// The visitor's memory, made at the first call.
    [[nodiscard]] static SearchMemory& of(osg::NodeVisitor& visitor) {
        osg::ref_ptr<osg::Referenced>& memory = CullTraversal::of(visitor).searchMemory();
        if (!memory) memory = new SearchMemory;
        return static_cast<SearchMemory&>(*memory);
    }

    /// Results about a database.
    struct LastView {
        double depth = 0.0;                ///< metres, of the lowest surface shown; the next search starts there
        unsigned int holes = 0;            ///< views since a search last did not come to nothing
        unsigned int rest = 0;             ///< views without occlusion that follow a view in which it hid too little
        unsigned int resting = 0;          ///< how many of them are left
        osg::ref_ptr<TerrainHider> hider;  ///< null: none was needed yet
    };
    [[nodiscard]] LastView& lastView(const InstalledDatabase& database) {
        for (auto& [known, view] : _lastViews) {
            if (known == &database) return view;
        }
        constexpr std::size_t kMostDatabases = 64;
        if (_lastViews.size() >= kMostDatabases) _lastViews.clear();
        return _lastViews.emplace_back(&database, LastView()).second;
    }

    GroundBelow ground;  ///< last found below the eye
    HidingView hiding;   ///< for nodes that are no tiles

protected:
    ~SearchMemory() override = default;

private:
    std::vector<std::pair<const InstalledDatabase*, LastView>> _lastViews;
};

}  // namespace osgAnalyticBin
