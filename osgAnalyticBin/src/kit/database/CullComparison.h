// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>
#include <osg/NodeVisitor>

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>

namespace osgUtil {
class CullVisitor;
}

namespace osgAnalyticBin {

/// Shows in any application what bins do: with the environment variable OSGANALYTICBIN_COMPARE, bins and stock OSG take
/// turns in culling a database, and a notice after each turn says how long a view's traversal of
/// the database took and how many of its tiles were drawn. A camera with osg::Stats gets the same, frame by frame.
/// Threads: any number of cull traversals.
class CullComparison {
public:
    /// Null unless the variable is set to seconds above 0.
    [[nodiscard]] static std::unique_ptr<CullComparison> fromEnvironment();

    /// `seconds`: of each turn.
    explicit CullComparison(double seconds) : _seconds(seconds) {}

    /// Times one traversal of the database, from its construction to its end.
    class View {
    public:
        /// `comparison`: null, and nothing is done, as for other visitors than osgUtil::CullVisitor.
        View(CullComparison* comparison, const osg::Node& root, osg::NodeVisitor& visitor);
        ~View();
        View(const View&) = delete;
        View& operator=(const View&) = delete;

        /// Whether this is a view of stock OSG's turn: nothing of the kit is to cull in it.
        [[nodiscard]] bool isStock() const { return _comparison && _turn % 2 == 1; }

    private:
        CullComparison* _comparison;
        const osg::Node& _root;
        osgUtil::CullVisitor* const _visitor;
        std::uint64_t _turn = 0;
        std::chrono::steady_clock::time_point _begin;
    };

private:
    /// Of the last turn of bins, or of OSG.
    struct Sums {
        std::size_t views = 0;
        std::size_t tiles = 0;
        double ms = 0.0;
    };

    void add(std::uint64_t turn, std::size_t tiles, double ms);
    void print() const;

    const double _seconds;
    std::mutex _mutex;  // guards the members below
    std::uint64_t _turn = 0;
    std::array<Sums, 2> _sums;
};

}  // namespace osgAnalyticBin
