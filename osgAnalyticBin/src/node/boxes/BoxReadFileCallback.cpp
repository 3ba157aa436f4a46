// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BoxReadFileCallback.h"

#include "../page/CarefulRead.h"
#include "BoxInstaller.h"

namespace osgAnalyticBin {

osgDB::ReaderWriter::ReadResult BoxReadFileCallback::readNode(const std::string& fileName,
                                                              const osgDB::Options* options) {
    using ReadResult = osgDB::ReaderWriter::ReadResult;
    const BusyPager busy(_set->making());
    return readCarefully(fileName, _failures, [&] {
        ReadResult read = readPlain(fileName, options, _previous.get());
        const auto found = _expected.find(fileName);
        if (read.validNode() && found != _expected.end()) install(*read.getNode(), found->second);
        return read;
    });
}

void BoxReadFileCallback::install(osg::Node& node, const Expected& expected) const {
    if (_set->isRemoved()) return;
    BoxInstaller installer(*_set);
    // nodes that others refer to as well keep OSG's spheres
    const bool isOwn = node.referenceCount() == 1;
    const auto content = isOwn ? installer.install(node, expected.file, expected.parent.get()) : installer.survey(node);
    _set->grow(*expected.parent, content.box, content.isMisfit);
}

}  // namespace osgAnalyticBin
