// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// A bin from a formula, on a node.

#include <osgAnalyticBin/mappings/AutodiffMapping.h>
#include <osgAnalyticBin/mappings/QuadraticBinCullCallback.h>

#include <osg/Group>

#include <cmath>
#include <cstdlib>

struct Pipe {
    template <class T>
    osgAnalyticBin::core::Vec3<T> operator()(T angle, T radius, T height) const {
        using std::cos;
        using std::sin;
        return {radius * cos(angle), radius * sin(angle), height};
    }
};

int main() {
    using namespace osgAnalyticBin;
    const core::QuadraticBin bin(core::AutodiffMapping{Pipe()}, {{0.0, 1.0, 0.0}, {0.1, 0.1, 1.0}});
    osg::ref_ptr<osg::Group> node = new osg::Group;
    node->setCullCallback(new QuadraticBinCullCallback(bin));
    const bool right = bin.classify({{1.0, 0.0, 0.0}, 0.0}) == core::Side::Inside;
    return right && node->getCullCallback() ? EXIT_SUCCESS : EXIT_FAILURE;
}
