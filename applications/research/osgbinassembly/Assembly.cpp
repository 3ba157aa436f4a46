// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Assembly.h"

#include "Angles.h"

#include <osgAnalyticBin/mappings/CylinderSegment.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <random>

namespace osgAnalyticBin::assembly {

namespace {

using support::kPi;
constexpr double kModuleSize = 24.0;  // metres
constexpr int kRoutes = 2;
constexpr int kStraights = 6;  // of a route, with a bend between any two
constexpr int kPanels = 4;     // along each side of a hull
constexpr double kPanelSize = 4.0;

using Generator = std::mt19937;

double between(Generator& random, double lower, double upper) {
    // Not std::uniform_real_distribution, whose results differ between libraries.
    return lower + (upper - lower) * (static_cast<double>(random()) / static_cast<double>(Generator::max()));
}

core::Frame placed(const core::Frame& frame, const core::Frame& outer) {
    const auto turned = [&](const glm::dvec3& v) { return v.x * outer.x + v.y * outer.y + v.z * outer.z; };
    return {outer.toOuter(frame.origin), turned(frame.x), turned(frame.y), turned(frame.z)};
}

// A module under construction; everything in it is given in the module's own frame.
class Module {
public:
    Module(const core::Frame& place, Generator& random) : _place(place), _random(random) {}

    [[nodiscard]] std::vector<Part> build() {
        for (int i = 0; i < kRoutes; ++i) addRoute();
        addHull();
        return std::move(_parts);
    }

private:
    // A route keeps to the module's axes and turns back to its middle.
    void addRoute() {
        const double radius = between(_random, 0.1, 0.6);
        glm::dvec3 position(between(_random, -6.0, 6.0), between(_random, -6.0, 6.0), between(_random, 1.0, 6.0));
        glm::dvec3 direction(1.0, 0.0, 0.0);
        for (int i = 0; i < kStraights; ++i) {
            const glm::dvec3 turn = nextDirection(position, direction);
            addStraight(position, direction, turn, radius);
            if (i + 1 < kStraights) addBend(position, direction, turn, radius);
        }
    }

    // At a right angle to the present one, towards the middle.
    glm::dvec3 nextDirection(const glm::dvec3& position, const glm::dvec3& direction) {
        const glm::dvec3 home = glm::dvec3(0.0, 0.0, 4.0) - position;
        glm::length_t axis = std::abs(direction.x) > 0.5 ? 0 : std::abs(direction.y) > 0.5 ? 1 : 2;
        axis = (axis + (between(_random, 0.0, 1.0) < 0.5 ? 1 : 2)) % 3;
        glm::dvec3 result(0.0);
        result[axis] = home[axis] < 0.0 ? -1.0 : 1.0;
        return result;
    }

    void addStraight(glm::dvec3& position, const glm::dvec3& direction, const glm::dvec3& side, double radius) {
        const double length = between(_random, 2.0, 8.0);
        const core::Frame frame = placed(core::frameAboutAxis(position, direction, side), _place);
        for (int quarter = 0; quarter < 4; ++quarter) {
            _parts.push_back(makePipeQuarter(frame, radius, 0.05 * radius, length, quarter));
        }
        position += length * direction;
    }

    void addBend(glm::dvec3& position, glm::dvec3& direction, const glm::dvec3& turn, double radius) {
        const double bendRadius = 3.0 * radius;
        core::Frame frame;
        frame.origin = position + bendRadius * turn;
        frame.x = -turn;
        frame.y = direction;
        frame.z = glm::cross(frame.x, frame.y);
        for (int half = 0; half < 2; ++half) {
            for (int quarter = 0; quarter < 4; ++quarter) {
                _parts.push_back(
                    makeBendQuarter(placed(frame, _place), bendRadius, radius, 0.05 * radius, half, quarter));
            }
        }
        position = frame.origin + bendRadius * direction;
        direction = turn;
    }

    // A shallow shell over the pipes, of bicubic panels that share their edges.
    void addHull() {
        const double height = between(_random, 8.0, 14.0);
        const double rise = between(_random, 0.01, 0.04);
        const double twist = between(_random, -0.02, 0.02);
        for (int i = 0; i < kPanels; ++i) {
            for (int j = 0; j < kPanels; ++j) {
                ControlNet inner{3, 3, {}};
                ControlNet outer{3, 3, {}};
                for (int k = 0; k < 16; ++k) {
                    const double x = (i + k / 4 / 3.0 - 0.5 * kPanels) * kPanelSize;
                    const double y = (j + k % 4 / 3.0 - 0.5 * kPanels) * kPanelSize;
                    const glm::dvec3 point(x, y, height - rise * (x * x + y * y) + twist * x * y);
                    const glm::dvec3 up =
                        glm::normalize(glm::dvec3(2.0 * rise * x - twist * y, 2.0 * rise * y - twist * x, 1.0));
                    inner.points.push_back(_place.toOuter(point));
                    outer.points.push_back(_place.toOuter(point + 0.05 * up));
                }
                _parts.push_back(makePanel(BezierSolid(inner, outer)));
            }
        }
    }

    core::Frame _place;
    Generator& _random;
    std::vector<Part> _parts;
};

core::Frame modulePlace(int column, int row, int side, Generator& random) {
    const double yaw = between(random, 0.0, 2.0 * kPi);
    const glm::dvec3 origin((column - 0.5 * (side - 1)) * kModuleSize, (row - 0.5 * (side - 1)) * kModuleSize, 0.0);
    return core::frameAboutAxis(origin, {0.0, 0.0, 1.0}, {std::cos(yaw), std::sin(yaw), 0.0});
}

}  // namespace

Assembly buildAssembly(std::size_t parts, std::uint32_t seed) {
    constexpr int kPartsOfModule = kRoutes * (kStraights * 4 + (kStraights - 1) * 8) + kPanels * kPanels;
    const auto modules = static_cast<int>((parts + kPartsOfModule - 1) / kPartsOfModule);
    const auto side = static_cast<int>(std::ceil(std::sqrt(modules)));
    Generator random(seed);
    Assembly assembly;
    assembly.scene = new osg::Group;
    assembly.halfExtent = 0.5 * side * kModuleSize;
    for (int i = 0; i < modules; ++i) {
        const osg::ref_ptr<osg::Group> group = new osg::Group;
        for (Part& part : Module(modulePlace(i % side, i / side, side, random), random).build()) {
            group->addChild(part.geode.get());
            assembly.parts.push_back(std::move(part));
        }
        assembly.scene->addChild(group.get());
    }
    return assembly;
}

}  // namespace osgAnalyticBin::assembly
