// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/NodeVisitor>
#include <osg/ref_ptr>

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

namespace osgAnalyticBin {

/// Stands between the tiles of a database and the DatabasePager while a cull visitor traverses the database, and holds
/// requests back while other tiles need theirs more. So near tiles are loaded first, and what they hide is not
/// requested at all. Without it, tiles are loaded level by level, and far tiles are complete before the near ones hide
/// them.
///
/// The *lag* of a tile is its distance divided by the distance at which its finer tiles are due: nearly 1 where they
/// have just become due, 0.5 where the next finer level is due, too. A request whose lag is more than kBand times the
/// least lag is not passed on in this view. Requests that the pager has had for kPatience seconds hold nothing back,
/// and requests whose priority is not from 0 to 1 (ranges of pixels, priorities of the application) are not held back.
/// Guarantee: kAtLeast requests of a view, or all, are passed on; tests: RequestOrder.*.
/// Cost: a copy of the node path for each request. Threads: one object for each visitor and database.
class RequestOrder final : public osg::NodeVisitor::DatabaseRequestHandler {
public:
    static constexpr double kBand = 2.0;
    static constexpr std::size_t kAtLeast = 4;
    static constexpr double kPatience = 0.25;  // seconds

    /// For the length of a traversal of the database.
    class Scope {
    public:
        Scope(RequestOrder& order, osg::NodeVisitor& visitor);
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        const osg::ref_ptr<RequestOrder> _order;
        osg::NodeVisitor& _visitor;
        const osg::ref_ptr<DatabaseRequestHandler> _pager;
    };

    void requestNodeFile(const std::string& file, osg::NodePath& path, float priority, const osg::FrameStamp* stamp,
                         osg::ref_ptr<osg::Referenced>& request, const osg::Referenced* options) override;

    /// Whether a tile was a level or more behind in the last view.
    [[nodiscard]] bool isBehind() const { return _least * kBand < 1.0; }

private:
    struct Request {
        std::string file;
        osg::NodePath path;
        float priority;
        const osg::FrameStamp* stamp;
        osg::ref_ptr<osg::Referenced>* request;  // a member of the node that asks
        const osg::Referenced* options;

        // 1 where it cannot be told
        [[nodiscard]] double lag() const;
    };

    void passOn(DatabaseRequestHandler& pager, double time);

    std::vector<Request> _requests;  // of this view
    double _least = 1.0;             // lag, in the last view
    // When those of the last view were first passed on, in seconds, by the pager's object.
    std::unordered_map<const osg::Referenced*, double> _since;
};

}  // namespace osgAnalyticBin
