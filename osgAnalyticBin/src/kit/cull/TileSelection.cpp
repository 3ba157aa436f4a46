// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileSelection.h"

#include <algorithm>
#include <functional>

namespace osgAnalyticBin {

TileSelection::Conditions TileSelection::Conditions::of(const osg::NodeVisitor& visitor, osg::CullStack& cullStack) {
    return {visitor.getTraversalMask(), visitor.getNodeMaskOverride(),
            cullStack.getCurrentCullingSet().getCullingMask(), cullStack.getLODScale()};
}

bool TileSelection::Conditions::operator==(const Conditions& other) const {
    return traversalMask == other.traversalMask && maskOverride == other.maskOverride && culling == other.culling &&
           lodScale == other.lodScale;
}

void TileSelection::begin(const Conditions& conditions) {
    clear();
    _conditions = conditions;
}

void TileSelection::clear() {
    _segments.clear();
    _places.clear();
    _kept.clear();
    _shown.clear();
    _families.clear();
    _held.clear();
    _heldFamilies = _heldPlaces = _heldKept = 0;
    _isHeld = false;
    _occluded.clear();
    _next = 0;
}

TileSelection::Number TileSelection::beginSegment(const TileFamily& family, core::PlaneMask undecided) {
    const auto kept = static_cast<Number>(_kept.size()), places = static_cast<Number>(_places.size());
    _segments.push_back({&family, undecided, kept, kept, places, places, {}, false});
    return static_cast<Number>(_segments.size() - 1);
}

void TileSelection::endSegment(Number segment) {
    _segments[segment].endOfKept = static_cast<Number>(_kept.size());
    _segments[segment].endOfPlaces = static_cast<Number>(_places.size());
}

TileSelection::Number TileSelection::enter(osg::Node& node, Number above, Number segment, osg::PagedLOD* paged,
                                           unsigned int level) {
    const auto number = static_cast<Number>(_places.size());
    const Number stateAbove = above == kNone ? kNone : _places[above].withState;
    _places.push_back(
        {&node, node.getStateSet(), above, node.getStateSet() ? number : stateAbove, segment, paged, level});
    return number;
}

TileSelection::Number TileSelection::keep(const Kept& kept) {
    _kept.push_back(kept);
    return static_cast<Number>(_kept.size() - 1);
}

bool TileSelection::hasSegment(const TileFamily& family) const {
    return std::any_of(_segments.begin(), _segments.end(),
                       [&](const Segment& segment) { return segment.family == &family; });
}

void TileSelection::addOccluded(const ShownTile& tile) {
    _occluded.push_back(tile.tile);
    _isSorted = false;
    if (tile.kept == kNone) return;
    Kept& kept = _kept[tile.kept];
    kept.isOccluded = true;
    // OSG would not come to its level; a tile without levels is in a group
    if (kept.way == Way::Mesh && kept.place != kNone) _places[kept.place].paged = nullptr;
    if (tile.segment != kNone) _segments[tile.segment].hides = true;
}

bool TileSelection::isOccluded(const AnalyticBinCullCallback& tile) {
    if (!_isSorted) std::sort(_occluded.begin(), _occluded.end(), std::less<>());
    _isSorted = true;
    return std::binary_search(_occluded.begin(), _occluded.end(), &tile, std::less<>());
}

TileSelection::Number TileSelection::find(const TileFamily& family, core::PlaneMask undecided) {
    // there are also segments below nodes that OSG does not enter
    constexpr std::size_t kFarthest = 32;
    const std::size_t end = std::min(_segments.size(), _next + kFarthest);
    for (std::size_t i = _next; i < end; ++i) {
        if (_segments[i].family != &family) continue;
        _next = i + 1;
        return (undecided & ~_segments[i].undecided) == 0 ? static_cast<Number>(i) : kNone;
    }
    return kNone;
}

void TileSelection::hold() {
    _isHeld = true;
    for (; _heldFamilies < _families.size(); ++_heldFamilies) _held.emplace_back(_families[_heldFamilies]);
    // families hold their tiles, and these their meshes
    for (; _heldPlaces < _places.size(); ++_heldPlaces) {
        const Place& place = _places[_heldPlaces];
        if (!place.paged) _held.emplace_back(place.node);
        if (place.state) _held.emplace_back(place.state);
    }
    for (; _heldKept < _kept.size(); ++_heldKept) {
        if (_kept[_heldKept].way == Way::Plain) _held.emplace_back(_kept[_heldKept].node);
    }
}

}  // namespace osgAnalyticBin
