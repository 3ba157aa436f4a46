// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// What is stored with a tile as text: its bin, and the properties of a cull callback, line by line. Whatever they are,
// a bin holds what its text says, and the callback culls nothing by an invalid one.

#include "Fuzz.h"

#include <osg/Notify>

#include <kit/CullFixture.h>
#include <sstream>

using namespace osgAnalyticBin;

namespace {

bool isReached(AnalyticBinCullCallback& callback) {
    std::set<std::string> reached;
    callback.setNestedCallback(new test::VisitRecorder("tile", reached));
    const osg::ref_ptr<osg::Group> tile = new osg::Group;
    tile->setCullCallback(&callback);
    tile->setCullingActive(false);
    (void)test::cull(*tile, test::CullView::lookAt({2e7, 0, 0}, {}, {0, 0, 1}, 30.0));
    return !reached.empty();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    osg::setNotifyLevel(osg::ALWAYS);
    std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
    std::array<std::string, 4> text;
    for (std::string& line : text) std::getline(lines, line);

    const AnalyticBin bin = AnalyticBin::fromText(text[0]);
    if (bin.valid()) {
        const AnalyticBin again = AnalyticBin::fromText(bin.toText());
        test::require(again.valid() && again.contains(bin));
    } else {
        test::require(bin.toText().empty());
    }
    const osg::ref_ptr<AnalyticBinCullCallback> callback = new AnalyticBinCullCallback;
    callback->setOptionsText(text[1]);
    callback->setBinText(text[0]);
    if (!text[2].empty()) callback->setRadiiText(text[2]);
    if (!text[3].empty()) callback->setLocalToEcefText(text[3]);
    const bool reached = isReached(*callback);
    if (!callback->getBin().valid()) test::require(reached);
    return 0;
}
