// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// A bin from a formula, on a node.

#include <osgAnalyticBin/mappings/AutodiffMapping.h>
#include <osgAnalyticBin/mappings/CylinderSegment.h>
#include <osgAnalyticBin/mappings/QuadraticBinCullCallback.h>

#include <osg/Group>

#include <cstdlib>

int main() {
    using namespace osgAnalyticBin;
    const core::AutodiffMapping pipe{core::CylinderSegment(core::Frame())};
    const core::QuadraticBin bin(pipe, {{0.0, 1.0, 0.0}, {0.1, 0.1, 1.0}});
    osg::ref_ptr<osg::Group> node = new osg::Group;
    node->setCullCallback(new QuadraticBinCullCallback(bin));
    const bool right = bin.classify({{1.0, 0.0, 0.0}, 0.0}) == core::Side::Inside;
    return right && node->getCullCallback() ? EXIT_SUCCESS : EXIT_FAILURE;
}
