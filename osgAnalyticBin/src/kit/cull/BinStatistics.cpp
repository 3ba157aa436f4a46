// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/BinStatistics.h>

#include <osg/NodeVisitor>
#include <osg/UserDataContainer>

#include <typeinfo>
#include <utility>

namespace osgAnalyticBin {

namespace {

constexpr std::array kCounted{&BinCounts::outside, &BinCounts::inside,     &BinCounts::straddling,
                              &BinCounts::hidden,  &BinCounts::beyondEdge, &BinCounts::occluded};

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

// One writer: a plain load and store is enough, and costs no locked instruction.
void BinStatistics::add(const BinCounts& counts) noexcept {
    beginFrame(counts.frame);
    for (std::size_t i = 0; i < kCounted.size(); ++i)
        _counters[i].store(_counters[i].load(std::memory_order_relaxed) + counts.*kCounted[i],
                           std::memory_order_relaxed);
}

void BinStatistics::count(core::Side side, unsigned int frame, BinReason reason) noexcept {
    BinCounts counts;
    ++(side == core::Side::Outside ? counts.outside : side == core::Side::Inside ? counts.inside : counts.straddling);
    if (reason) ++(counts.*reason);
    counts.frame = frame;
    add(counts);
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
    for (auto& counter : _counters) counter.store(0, std::memory_order_relaxed);
    _covered = nullptr;
    _notCovered = nullptr;
}

BinCounts BinStatistics::getCounts() const noexcept {
    BinCounts counts;
    for (std::size_t i = 0; i < kCounted.size(); ++i)
        counts.*kCounted[i] = _counters[i].load(std::memory_order_relaxed);
    counts.tested = counts.outside + counts.inside + counts.straddling;
    counts.frame = _frame.load(std::memory_order_relaxed);
    return counts;
}

}  // namespace osgAnalyticBin
