// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/BinStatistics.h>

#include <osg/NodeVisitor>
#include <osg/UserDataContainer>

#include <typeinfo>
#include <utility>

namespace osgAnalyticBin {

namespace {

// One writer: a plain load and store is enough, and costs no locked instruction.
template <class Counter>
void increment(Counter& counter, std::uint32_t by = 1) {
    counter.store(counter.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
}

}  // namespace

BinStatistics::BinStatistics(const BinStatistics& other, const osg::CopyOp& copyop) : osg::Object(other, copyop) {}

BinStatistics& BinStatistics::of(osg::NodeVisitor& visitor) {
    if (const BinStatistics* known = find(visitor)) return const_cast<BinStatistics&>(*known);
    osg::ref_ptr<BinStatistics> made = new BinStatistics;
    made->_owner = &visitor;
    // clones share it, and may cull in other threads
    const osg::UserDataContainer* const shared = visitor.getUserDataContainer();
    if (shared && shared->referenceCount() > 1)
        visitor.setUserDataContainer(osg::clone(shared, osg::CopyOp::SHALLOW_COPY));
    visitor.getOrCreateUserDataContainer()->addUserObject(made.get());
    return *made;
}

const BinStatistics* BinStatistics::find(const osg::NodeVisitor& visitor) {
    const osg::UserDataContainer* container = visitor.getUserDataContainer();
    if (!container) return nullptr;
    for (unsigned int i = 0; i < container->getNumUserObjects(); ++i) {
        // A cloned visitor shares the container of its original: the owner tells whose counters these are.
        const osg::Object* object = container->getUserObject(i);
        if (!object || typeid(*object) != typeid(BinStatistics)) continue;
        const auto* statistics = static_cast<const BinStatistics*>(object);
        if (statistics->_owner == &visitor) return statistics;
    }
    return nullptr;
}

void BinStatistics::beginFrame(unsigned int frame) noexcept {
    if (_frame.load(std::memory_order_relaxed) == frame) return;
    reset();
    _frame.store(frame, std::memory_order_relaxed);
}

void BinStatistics::add(const BinCounts& counts) noexcept {
    beginFrame(counts.frame);
    increment(_outside, counts.outside);
    increment(_inside, counts.inside);
    increment(_straddling, counts.straddling);
    increment(_hidden, counts.hidden);
    increment(_beyondEdge, counts.beyondEdge);
    increment(_occluded, counts.occluded);
}

void BinStatistics::count(core::Side side, unsigned int frame) noexcept {
    beginFrame(frame);
    switch (side) {
        case core::Side::Outside:
            increment(_outside);
            break;
        case core::Side::Inside:
            increment(_inside);
            break;
        case core::Side::Straddling:
            increment(_straddling);
            break;
    }
}

void BinStatistics::countHidden() noexcept {
    increment(_hidden);
}

void BinStatistics::countBeyondEdge() noexcept {
    increment(_beyondEdge);
}

void BinStatistics::countOccluded() noexcept {
    increment(_occluded);
}

void BinStatistics::setCovered(std::shared_ptr<const CoveredPicture> covered, unsigned int frame) noexcept {
    beginFrame(frame);
    _covered = std::move(covered);
}

void BinStatistics::setNotCovered(const char* condition, unsigned int frame) noexcept {
    beginFrame(frame);
    _notCovered = condition;
}

void BinStatistics::reset() noexcept {
    _occluded.store(0, std::memory_order_relaxed);
    _hidden.store(0, std::memory_order_relaxed);
    _beyondEdge.store(0, std::memory_order_relaxed);
    _outside.store(0, std::memory_order_relaxed);
    _inside.store(0, std::memory_order_relaxed);
    _straddling.store(0, std::memory_order_relaxed);
    _covered = nullptr;
    _notCovered = nullptr;
}

BinCounts BinStatistics::getCounts() const noexcept {
    BinCounts counts;
    counts.outside = _outside.load(std::memory_order_relaxed);
    counts.inside = _inside.load(std::memory_order_relaxed);
    counts.straddling = _straddling.load(std::memory_order_relaxed);
    counts.hidden = _hidden.load(std::memory_order_relaxed);
    counts.beyondEdge = _beyondEdge.load(std::memory_order_relaxed);
    counts.occluded = _occluded.load(std::memory_order_relaxed);
    counts.tested = counts.outside + counts.inside + counts.straddling;
    counts.frame = _frame.load(std::memory_order_relaxed);
    return counts;
}

}  // namespace osgAnalyticBin
