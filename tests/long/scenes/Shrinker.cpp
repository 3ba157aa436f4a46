// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Shrinker.h"

#include <algorithm>
#include <functional>
#include <utility>

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
            simplifyParts();
            simplifyDatabases();
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
        for (std::size_t i = 0; i + 1 < _best.description.views.size(); ++i) {
            if (_best.description.views[i].isActive) attempt([&](Description& d) { d.views[i].isActive = false; });
        }
    }

    template <class Value>
    void reset(Value DatabaseSpec::*member, std::size_t i, const Value& plain) {
        if (_best.description.databases[i].*member == plain) return;
        attempt([&](Description& d) { d.databases[i].*member = plain; });
    }

    template <class Value>
    static void resetOption(Value CullOptions::*member, CullOptions& options) {
        options.*member = CullOptions().*member;
    }

    // One option after the other, then all.
    void simplifyOptions(const std::function<CullOptions&(Description&)>& of) {
        const std::vector<std::function<void(CullOptions&)>> changes{
            [](CullOptions& o) { o = CullOptions(); },
            [](CullOptions& o) { resetOption(&CullOptions::method, o); },
            [](CullOptions& o) { resetOption(&CullOptions::horizonUse, o); },
            [](CullOptions& o) { resetOption(&CullOptions::inheritViewpoint, o); },
            [](CullOptions& o) { resetOption(&CullOptions::edges, o); },
            [](CullOptions& o) { resetOption(&CullOptions::occlusion, o); },
            [](CullOptions& o) { resetOption(&CullOptions::expiry, o); },
            [](CullOptions& o) { resetOption(&CullOptions::skirts, o); },
            [](CullOptions& o) { resetOption(&CullOptions::heights, o); }};
        for (const auto& change : changes) {
            Description probe = _best.description;
            const std::string before = toText(of(probe));
            change(of(probe));
            if (toText(of(probe)) != before) attempt([&](Description& d) { change(of(d)); });
        }
    }

    void simplifyParts() {
        for (std::size_t i = 0; i < _best.description.parts.size(); ++i) {
            simplifyOptions([i](Description& d) -> CullOptions& { return d.parts[i].options; });
            if (_best.description.parts[i].until > 0) attempt([&](Description& d) { d.parts[i].until = 0; });
        }
    }

    void simplifyDatabases() {
        if (_best.description.databases.size() > 1) attempt([](Description& d) { dropLastDatabase(d); });
        for (std::size_t i = 0; i < _best.description.databases.size(); ++i) {
            for (int levels = 0; levels < _best.description.databases[i].levels; ++levels)
                reset(&DatabaseSpec::levels, i, levels);
            reset(&DatabaseSpec::isLoaded, i, false);
            reset(&DatabaseSpec::requestsBins, i, false);
            reset(&DatabaseSpec::leavesArePaged, i, false);
            reset(&DatabaseSpec::storesBins, i, false);
            reset(&DatabaseSpec::hasSkirts, i, true);
            reset(&DatabaseSpec::fileShape, i, FileShape::Tiles);
            reset(&DatabaseSpec::mesh, i, MeshKind::Local);
            reset(&DatabaseSpec::relief, i, std::min(1000.0, _best.description.databases[i].relief));
            reset(&DatabaseSpec::waves, i, 5.0);
            simplifyOptions([i](Description& d) -> CullOptions& { return d.databases[i].options; });
        }
    }

    static void dropLastDatabase(Description& d) {
        d.databases.pop_back();
        const int count = static_cast<int>(d.databases.size());
        std::vector<Part> kept;
        for (const Part& part : d.parts) {
            if (part.tile.database < count) kept.push_back(part);
        }
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
