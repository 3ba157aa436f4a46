// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Prefetch.h"

#include <osg/Group>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace osgAnalyticBin {

/// Where the memory lies that a walk read when it last came to a tile, besides the tile itself: the way to the family
/// of the finer level, or the mesh. These nodes and numbers refer to each other; fetched together for several siblings,
/// they are in the processor's caches when they are needed. Threads: everything at any time.
class Footprint {
    static constexpr std::size_t kRuns = 13;

public:
    Footprint() = default;
    /// A copy is empty.
    Footprint(const Footprint&) {}
    Footprint& operator=(const Footprint&) { return *this; }

    void fetch() const {
        for (const auto& noted : _runs) {
            const std::uintptr_t run = noted.load(std::memory_order_relaxed);
            if (run == 0) break;
            prefetchLines(run & ~(kCacheLine - 1), run & (kCacheLine - 1));
        }
    }

    /// Notes what is read of one tile. What is noted already is not written again.
    class Notes {
    public:
        explicit Notes(const Footprint& footprint) : _runs(footprint._runs) {}
        ~Notes() {
            if (_next < kRuns) note(0);
        }
        Notes(const Notes&) = delete;
        Notes& operator=(const Notes&) = delete;

        /// Of large runs the beginning counts.
        void add(const void* begin, std::size_t bytes) {
            constexpr std::uintptr_t kMostLines = 24;
            const auto first = reinterpret_cast<std::uintptr_t>(begin) / kCacheLine;
            const std::uintptr_t lines = (reinterpret_cast<std::uintptr_t>(begin) + bytes - 1) / kCacheLine - first + 1;
            if (_next < kRuns && bytes > 0) note(first * kCacheLine + std::min(lines, kMostLines));
        }
        /// What tells a group's children apart from others.
        void addChildren(const osg::Group& group) {
            const osg::NodeList& children = OpenGroup::childrenOf(group);
            add(children.data(), children.size() * sizeof children[0]);
        }

    private:
        struct OpenGroup : public osg::Group {
            static const osg::NodeList& childrenOf(const osg::Group& group) { return group.*(&OpenGroup::_children); }
        };

        void note(std::uintptr_t run) {
            std::atomic<std::uintptr_t>& noted = _runs[_next++];
            if (noted.load(std::memory_order_relaxed) != run) noted.store(run, std::memory_order_relaxed);
        }

        std::array<std::atomic<std::uintptr_t>, kRuns>& _runs;
        std::size_t _next = 0;
    };

private:
    // each is the address of a cache line, with the number of lines to read in its low bits; the first 0 ends the list
    mutable std::array<std::atomic<std::uintptr_t>, kRuns> _runs{};
};

}  // namespace osgAnalyticBin
