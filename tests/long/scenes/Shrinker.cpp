// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Run.h"
#include "SceneText.h"

namespace osgAnalyticBin::test {

namespace {

/// Takes what still fails.
class Shrinker {
public:
    Shrinker(Description description, Failure failure, Painter* painter)
        : _best{std::move(description), std::move(failure)}, _painter(painter) {}

    Shrunk shrink() {
        cutFrames();
        for (int round = 0; round < kMostRounds; ++round) {
            _hasChanged = false;
            dropParts();
            dropFrames();
            if (_best.description.databases.size() > 1) attempt([](Description& d) { dropLastDatabase(d); });
            simplify(&Description::parts);
            simplify(&Description::databases);
            if (!_hasChanged) break;
        }
        return _best;
    }

private:
    static constexpr int kMostRounds = 4;
    using Change = std::function<void(Description&)>;

    bool attempt(const Change& change) {
        Description candidate = _best.description;
        change(candidate);
        RunTotals totals;
        const auto failure = run(candidate, totals, _painter);
        if (!failure || failure->signature != _best.failure.signature) return false;
        _best = {std::move(candidate), *failure};
        _hasChanged = true;
        return true;
    }

    // What comes after the failure.
    void cutFrames() {
        const auto frames = static_cast<std::size_t>(_best.failure.frame);
        if (frames == 0 || frames >= _best.description.views.size()) return;
        attempt([&](Description& d) { d.views.resize(frames); });
    }

    void dropParts() {
        for (std::size_t i = _best.description.parts.size(); i-- > 0;)
            attempt([&](Description& d) { d.parts.erase(d.parts.begin() + static_cast<std::ptrdiff_t>(i)); });
    }

    void dropFrames() {
        for (std::size_t i = 0; i + 1 < _best.description.views.size(); ++i)
            if (_best.description.views[i].isActive) attempt([&](Description& d) { d.views[i].isActive = false; });
    }

    // Databases or parts, field by field.
    template <class Thing>
    void simplify(std::vector<Thing> Description::*list) {
        for (std::size_t i = 0; i < (_best.description.*list).size(); ++i) {
            const auto ways = [&] { return simpler((_best.description.*list)[i]); };
            for (std::size_t way = 0; way < ways().size();) {
                const Thing candidate = ways()[way];
                if (!attempt([&](Description& d) { (d.*list)[i] = candidate; })) ++way;
            }
        }
    }

    static void dropLastDatabase(Description& d) {
        d.databases.pop_back();
        const int count = static_cast<int>(d.databases.size());
        std::vector<Part> kept;
        for (const Part& part : d.parts)
            if (part.tile.database < count) kept.push_back(part);
        d.parts = kept;
    }

    Shrunk _best;
    Painter* const _painter;
    bool _hasChanged = false;
};

}  // namespace

Shrunk shrink(const Description& description, const Failure& failure, Painter* painter) {
    return Shrinker(description, failure, painter).shrink();
}

}  // namespace osgAnalyticBin::test
