// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/InstallRequest.h>

namespace osgAnalyticBin {

InstallRequest::InstallRequest(const InstallRequest& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop),
      osg::Callback(other, copyop),
      osg::NodeCallback(other, copyop),
      _options(other._options) {}

void InstallRequest::setOptionsText(const std::string& text) {
    _options = storedCullOptions(text);
}

std::string InstallRequest::getOptionsText() const {
    return toText(_options);
}

}  // namespace osgAnalyticBin
