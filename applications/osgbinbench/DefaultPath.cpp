// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Bench.h"
#include "MethodScene.h"
#include "Nodes.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <osg/Math>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <utility>

namespace osgAnalyticBin::bench {

namespace {

using core::Geodetic;
using core::GeodeticBin;
using flight::CameraPose;

constexpr double kVerticalFov = 60.0;  // degrees

std::vector<GeodeticBin> loadedBins(osg::Node& scene) {
    std::vector<GeodeticBin> bins;
    support::forAllNodes(scene, [&](osg::Node& node) {
        const auto* const tile = support::findCallback<AnalyticBinCullCallback>(node.getCullCallback());
        if (tile && tile->shownBin().valid()) bins.push_back(tile->shownBin().bin());
    });
    return bins;
}

bool isLower(const GeodeticBin& a, const GeodeticBin& b) {
    return a.altitude().upper < b.altitude().upper;
}

/// Looks for places to fly at, with the files that are in view there loaded, and adds poses of one kind after the
/// other.
class PathMaker {
public:
    PathMaker(const Settings& settings, FileWatch& watch) : _scene(cullMethodFromName("exact"), settings, watch) {
        _scene.load();
        const std::vector<GeodeticBin> bins = loadedBins(_scene.root());
        if (bins.empty())
            throw support::Failure(settings.database + ": has no tiles to fly over; give a path with --path");
        for (const GeodeticBin& bin : bins) _whole = _whole.united(bin);
        _highest = *std::max_element(bins.begin(), bins.end(), isLower);
        descend();
    }
    ~PathMaker() { _scene.pause(); }

    [[nodiscard]] std::vector<CameraPose> make() {
        addOverviews();
        addObliques();
        const double tile = depthOf(_highest);
        addLowOnes(tile);
        addTurn(tile);
        return std::move(_path);
    }

private:
    [[nodiscard]] core::Ellipsoid ellipsoid() const { return _scene.globe().radii(); }

    // Of the globe, or what stands for it in a map.
    [[nodiscard]] double radius() const { return ellipsoid().equatorialRadius(); }

    // From its south to its north, in metres or units of the map.
    [[nodiscard]] double depthOf(const GeodeticBin& bin) const { return bin.latitude().width() * radius(); }

    // In the middle of the finest tile with the highest terrain.
    [[nodiscard]] Geodetic top() const {
        Geodetic top = _highest.center();
        top.altitude = _highest.altitude().upper;
        return top;
    }

    // How far the database reaches: a globe no farther than its radius.
    [[nodiscard]] double reach() const {
        const double parallel = _whole.longitude().width() * std::cos(_whole.center().latitude);
        return radius() * std::min(1.0, std::max(_whole.latitude().width(), parallel) / 2.0);
    }

    // So many metres, or units of the map, away.
    [[nodiscard]] Geodetic moved(const Geodetic& from, double heading, double distance) const {
        const double mostLatitude = 89.9 * osg::PI / 180.0;
        const double north = distance * std::cos(heading) / radius();
        const double latitude = std::clamp(from.latitude + north, -mostLatitude, mostLatitude);
        const double parallel = radius() * std::cos(from.latitude);
        const double longitude = from.longitude + distance * std::sin(heading) / parallel;
        return {latitude, ellipsoid().isPlane() ? longitude : std::remainder(longitude, 2.0 * osg::PI), from.altitude};
    }

    // Over the ground there, once its finest tiles are loaded.
    [[nodiscard]] Geodetic aboveGround(Geodetic at, double height) {
        at.altitude = _highest.altitude().upper;
        lookDown(at, 2.0 * depthOf(_highest));
        at.altitude = groundAt(at).value_or(at.altitude) + height;
        return at;
    }

    void lookDown(const Geodetic& at, double height) {
        Geodetic eye = at;
        eye.altitude += height;
        _scene.settle({"survey", eye, at, osg::DegreesToRadians(kVerticalFov)});
    }

    // From tile to finer tile, until there are none.
    void descend() {
        constexpr double kFiner = 0.75;
        for (bool isFiner = true; isFiner;) {
            const Geodetic at = top();
            lookDown(at, std::min(1.2 * depthOf(_highest), 3.0 * radius()));
            std::vector<GeodeticBin> bins = loadedBins(_scene.root());
            const auto isCoarser = [&](const GeodeticBin& bin) {
                return bin.latitude().width() > kFiner * _highest.latitude().width() ||
                       !_highest.contains(Geodetic{bin.center().latitude, bin.center().longitude, at.altitude});
            };
            bins.erase(std::remove_if(bins.begin(), bins.end(), isCoarser), bins.end());
            isFiner = !bins.empty();
            if (isFiner) _highest = *std::max_element(bins.begin(), bins.end(), isLower);
        }
    }

    [[nodiscard]] std::optional<double> groundAt(const Geodetic& at) {
        const double depth = _whole.altitude().width() + depthOf(_highest);
        Geodetic high = at, low = at;
        high.altitude += depth;
        low.altitude -= depth;
        const flight::Globe& globe = _scene.globe();
        const auto hit = flight::firstHit(_scene.root(), globe.toWorld(high), globe.toWorld(low));
        return hit ? std::optional(globe.geodetic(*hit).altitude) : std::nullopt;
    }

    void add(const char* kind, int number, const Geodetic& eye, const Geodetic& look) {
        CameraPose& pose = _path.emplace_back();
        pose.name = std::string(kind) + "_" + std::to_string(number);
        pose.eye = eye;
        pose.look = look;
        pose.verticalFov = osg::DegreesToRadians(kVerticalFov);
        pose.time = static_cast<double>(_path.size());
    }

    void addOverviews() {
        Geodetic look = _whole.center();
        look.altitude = _whole.altitude().upper;
        const double quarter = _whole.longitude().width() / 4.0;
        look.longitude -= quarter;
        for (int i = 1; i <= 3; ++i, look.longitude += quarter) {
            Geodetic eye = look;
            eye.altitude += 1.3 * reach();
            add("overview", i, eye, look);
        }
    }

    void addObliques() {
        const double distance = 0.15 * reach();
        for (int i = 0; i < 4; ++i) {
            Geodetic eye = moved(top(), i * osg::PI_2, distance);
            eye.altitude += 0.6 * distance;
            add("oblique", i + 1, eye, top());
        }
    }

    void addLowOnes(double tile) {
        for (int i = 0; i < 4; ++i) {
            const Geodetic eye = aboveGround(moved(top(), i * osg::PI_2, tile), 0.015 * tile);
            Geodetic look = top();
            look.altitude = eye.altitude;
            add("low", i + 1, eye, look);
        }
    }

    void addTurn(double tile) {
        constexpr int kViews = 6;
        const Geodetic eye = aboveGround(moved(top(), 0.0, 0.75 * tile), 0.05 * tile);
        for (int i = 0; i < kViews; ++i) {
            Geodetic look = moved(eye, 2.0 * osg::PI * i / kViews, tile);
            look.altitude -= 0.15 * tile;
            add("turning", i + 1, eye, look);
        }
    }

    MethodScene _scene;
    GeodeticBin _whole, _highest;
    std::vector<CameraPose> _path;
};

}  // namespace

std::vector<CameraPose> defaultPath(const Settings& settings, FileWatch& watch) {
    std::cerr << "osgbinbench: looking for the highest terrain, to fly around it" << std::endl;
    return PathMaker(settings, watch).make();
}

}  // namespace osgAnalyticBin::bench
