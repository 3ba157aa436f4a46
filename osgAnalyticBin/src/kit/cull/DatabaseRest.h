// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

namespace osgAnalyticBin {

/// What a view gains by bins over OSG's spheres, in tiles.
struct Gain {
    unsigned int kept = 0;    ///< in view
    unsigned int saved = 0;   ///< left out, though their spheres are in view
    unsigned int mended = 0;  ///< kept, though their spheres are out of view: OSG would leave them out
    unsigned int direct = 0;  ///< drawn without OSG's traversal of their meshes
    unsigned int visits = 0;  ///< of nodes that were searched one by one, as tiles below transforms are

    void count(bool isKept) { ++(isKept ? kept : saved); }
    /// Whether that is worth more than testing bins takes. Direct drawing has to pay for what is the same in each view.
    /// Some visits take as long as it takes to draw a tile.
    [[nodiscard]] bool pays() const {
        constexpr unsigned int kShare = 16, kMany = 16, kFewVisits = 64, kVisits = 8;
        const bool isSearchWorthIt = visits <= kFewVisits + kVisits * saved;
        return mended > 0 || (isSearchWorthIt && ((saved > 0 && kShare * saved >= kept) || direct >= kMany));
    }
};

/// When a database rests, for one visitor: where view after view gains nothing, OSG culls as if there were no bins, but
/// for a view now and then. After the camera has come to where bins gain, some views pass until they are used again.
class DatabaseRest {
public:
    enum class Turn { Bins, BinsCounted, Osg };

    /// Call once in each view. `arrivals`: how often tiles have come; a rest ends with them, because the gain so far
    /// was that of coarser ones.
    [[nodiscard]] Turn next(unsigned int arrivals) {
        if (arrivals != _arrivals) {
            if (_gainless >= kPatience) _left = 0;
            _gainless = 0;
        }
        _arrivals = arrivals;
        if (_left == 0) return Turn::BinsCounted;
        --_left;
        return _gainless < kPatience ? Turn::Bins : Turn::Osg;
    }
    /// Call after each view in which the gain was counted.
    void note(const Gain& gain) {
        _gainless = gain.pays() ? 0 : _gainless + 1;
        _left = _gainless == 0 || _gainless >= kPatience ? kViews : 0;
    }

private:
    static constexpr unsigned int kViews = 32, kPatience = 8;

    unsigned int _gainless = 0;  // counted views in a row
    unsigned int _left = 0;      // views until the gain is counted
    unsigned int _arrivals = 0;
};

}  // namespace osgAnalyticBin
