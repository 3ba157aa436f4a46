// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RequestOrder.h"

#include <osg/FrameStamp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace osgAnalyticBin {

RequestOrder::Scope::Scope(RequestOrder& order, osg::NodeVisitor& visitor)
    : _order(&order), _visitor(visitor), _pager(visitor.getDatabaseRequestHandler()) {
    if (_pager) visitor.setDatabaseRequestHandler(&order);
}

RequestOrder::Scope::~Scope() {
    if (!_pager) return;
    _visitor.setDatabaseRequestHandler(_pager);
    const osg::FrameStamp* const stamp = _visitor.getFrameStamp();
    _order->passOn(*_pager, stamp ? stamp->getReferenceTime() : 0.0);
}

// Undoes how osg::PagedLOD computes its priority.
double RequestOrder::Request::lag() const {
    const bool isByDistance = priority >= 0.0F && priority <= 1.0F;
    return isByDistance ? 1.0 - static_cast<double>(priority) : 1.0;
}

void RequestOrder::requestNodeFile(const std::string& file, osg::NodePath& path, float priority,
                                   const osg::FrameStamp* stamp, osg::ref_ptr<osg::Referenced>& request,
                                   const osg::Referenced* options) {
    _requests.push_back({file, path, priority, stamp, &request, options});
}

void RequestOrder::passOn(DatabaseRequestHandler& pager, double time) {
    const auto before = std::exchange(_since, {});
    const auto sinceOf = [&](const Request& request) {
        const auto found = before.find(request.request->get());
        return found == before.end() ? time : found->second;
    };
    _least = 1.0;
    for (const Request& request : _requests) {
        if (time - sinceOf(request) <= kPatience) _least = std::min(_least, request.lag());
    }
    std::sort(_requests.begin(), _requests.end(),
              [](const Request& some, const Request& other) { return some.lag() < other.lag(); });
    std::size_t passed = 0;
    for (Request& request : _requests) {
        const bool isByDistance = request.lag() < 1.0;
        const bool mayWait = isByDistance && request.lag() > kBand * _least;
        if (mayWait && passed >= kAtLeast) continue;
        ++passed;
        const double since = sinceOf(request);
        pager.requestNodeFile(request.file, request.path, request.priority, request.stamp, *request.request,
                              request.options);
        if (*request.request) _since.emplace(request.request->get(), since);
    }
    _requests.clear();
}

}  // namespace osgAnalyticBin
