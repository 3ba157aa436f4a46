// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/InstallBinsCallback.h>

#include <osg/Node>
#include <osg/Notify>

namespace osgAnalyticBin {

InstallBinsCallback::InstallBinsCallback(const InstallBinsCallback& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop),
      osg::Callback(other, copyop),
      osg::NodeCallback(other, copyop),
      _options(other._options) {}

void InstallBinsCallback::setOptionsText(const std::string& text) {
    std::string error;
    if (const auto options = cullOptionsFromText(text, error)) {
        _options = *options;
    } else {
        OSG_WARN << "InstallBinsCallback: " << error << "; using the default." << std::endl;
    }
}

std::string InstallBinsCallback::getOptionsText() const {
    return toText(_options);
}

void InstallBinsCallback::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    if (!_done) {
        installBins(*node, _options);
        _done = true;
    }
    traverse(node, nv);
}

}  // namespace osgAnalyticBin
