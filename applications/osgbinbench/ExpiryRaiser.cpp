// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ExpiryRaiser.h"

#include "NodeWalk.h"

#include <osg/PagedLOD>

#include <algorithm>

namespace osgAnalyticBin::bench {

namespace {

class ExpiryWalk : public NodeWalk {
public:
    explicit ExpiryWalk(double seconds) : _seconds(seconds) {}

private:
    void visit(osg::Node& node) override {
        auto* const paged = dynamic_cast<osg::PagedLOD*>(&node);
        for (unsigned int i = 0; paged && i < paged->getNumFileNames(); ++i)
            if (!paged->getFileName(i).empty())
                paged->setMinimumExpiryTime(i, std::max(_seconds, paged->getMinimumExpiryTime(i)));
    }

    double _seconds;
};

}  // namespace

ExpiryRaiser::Result ExpiryRaiser::readNode(const std::string& fileName, const osgDB::Options* options) {
    Result result = ReadInFront::readNode(fileName, options);
    ExpiryWalk walk(_seconds);
    if (result.getNode() && _seconds > 0.0) result.getNode()->accept(walk);
    return result;
}

}  // namespace osgAnalyticBin::bench
