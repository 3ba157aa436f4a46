// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ColumnUnion.h"

namespace osgAnalyticBin {

ColumnUnion::~ColumnUnion() = default;

void ColumnUnion::expandBy(const osg::BoundingSphered& column) {
    for (ColumnUnion* at = this; at; at = at->_above.get()) at->_sphere.expandBy(column);
}

void ColumnUnion::addDoubts(int number) {
    const std::lock_guard<std::mutex> lock(_connecting);
    countDoubts(number);
}

void ColumnUnion::countDoubts(int number) {
    for (ColumnUnion* at = this; at; at = at->_above.get()) at->_doubts.fetch_add(number, std::memory_order_relaxed);
}

void ColumnUnion::setAbove(ColumnUnion* above) {
    const std::lock_guard<std::mutex> lock(_connecting);
    const int doubts = _doubts.load(std::memory_order_relaxed);
    if (_above) _above->countDoubts(-doubts);
    _above = above;
    if (!above) return;
    above->countDoubts(doubts);
    above->expandBy(_sphere);
}

}  // namespace osgAnalyticBin
