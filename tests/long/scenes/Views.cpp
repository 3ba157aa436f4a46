// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Culls random low views of a real database twice: by OSG alone, and with bins and terrain occlusion. Checks that every
// drawable that has a pixel in OSG's picture is drawn with bins. tests/README.md says how to run it.

#include "Recorder.h"

#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>

using namespace osgAnalyticBin;
using namespace osgAnalyticBin::test;

namespace {

constexpr int kSkipped = 77;
constexpr int kFramesOfAFlight = 5;
constexpr double kHighest = 12000.0;  // metres, of all terrain
constexpr double kFrameTime = 1.0 / 60.0;
constexpr float kDepthSteps = 16.0F / 16777216.0F;  // depths that a depth buffer may confuse

constexpr const char* kUsage =
    "osganalyticbin_views DATABASE WEST SOUTH EAST NORTH [--views N] [--seed S]\n"
    "  WEST ...          degrees; eyes are in this part of the database\n"
    "  --views N         makes N views (default 1000), five on each of many short flights\n"
    "  --seed S          the seed of the first flight (default 1), of the second S + 1, ...\n"
    "Needs a display. Exit code: 0 when no view fails, 1 when one does, 2 for wrong arguments, 77 without a display\n"
    "or where the database is not there.\n";

struct Arguments {
    std::string database;
    double west = 0.0, south = 0.0, east = 0.0, north = 0.0;
    unsigned int views = 1000, seed = 1;
};

std::optional<Arguments> parse(int count, char** values) {
    osg::ArgumentParser parser(&count, values);
    Arguments result;
    (void)parser.read("--views", result.views);
    (void)parser.read("--seed", result.seed);
    if (parser.errors() || parser.argc() != 6) return std::nullopt;
    result.database = parser[1];
    int place = 2;
    for (double* const border : {&result.west, &result.south, &result.east, &result.north})
        *border = std::atof(parser[place++]);
    return result;
}

/// Reads all files of a database that are asked for near a place, and gives drawables names, the same ones each time.
class Loader : public osg::NodeVisitor {
public:
    Loader(const osg::Vec3d& middle, double reach)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _middle(middle), _reach(reach) {}

    void apply(osg::Drawable& drawable) override { drawable.setName("#" + std::to_string(++_drawables)); }
    void apply(osg::PagedLOD& node) override {
        const double distance = (node.getCenter() - _middle).length() - _reach;
        for (unsigned int i = node.getNumChildren(); i < node.getNumFileNames(); ++i) {
            if (distance < node.getMaxRange(i)) {
                const std::string file = osgDB::concatPaths(node.getDatabasePath(), node.getFileName(i));
                const osg::ref_ptr<osg::Node> child = osgDB::readRefNodeFile(file);
                if (!child) break;
                node.addChild(child);
            }
        }
        traverse(node);
    }

    [[nodiscard]] std::size_t drawables() const { return _drawables; }

private:
    const osg::Vec3d _middle;
    const double _reach;
    std::size_t _drawables = 0;
};

struct Totals {
    std::size_t views = 0, failures = 0, allowed = 0, slits = 0, slivers = 0, withHidden = 0;
    std::size_t byOsg = 0, byBins = 0, occluded = 0, visible = 0;
};

/// A place over the terrain, and where the camera looks and goes.
struct Eye {
    osg::Vec3d position, east, north, up;
    double heading = 0.0, pitch = 0.0, roll = 0.0, turn = 0.0;
    osg::Vec3d step{};

    [[nodiscard]] osg::Matrixd view() const {
        const osg::Vec3d level = north * std::cos(heading) + east * std::sin(heading);
        const osg::Vec3d look = level * std::cos(pitch) + up * std::sin(pitch);
        const osg::Vec3d head = osg::Quat(roll, look) * (up * std::cos(pitch) - level * std::sin(pitch));
        return osg::Matrixd::lookAt(position, position + look, head);
    }
    void goOn() {
        position += step;
        heading += turn;
    }
};

/// The database twice, with bins and without.
class Views {
public:
    Views(const Arguments& arguments, Painter& painter)
        : _arguments(arguments), _painter(painter), _stamp(new osg::FrameStamp) {
        _without = load();
        _with = load();
        CullOptions options;
        options.occlusion = OcclusionUse::On;
        (void)installBins(*_with, options);
        for (std::size_t i = 0; i < _drawables; ++i) update();
    }

    void run(Totals& totals) {
        for (std::uint64_t flight = _arguments.seed; totals.views < _arguments.views; ++flight) fly(flight, totals);
    }

private:
    [[nodiscard]] osg::Vec3d at(double latitude, double longitude, double altitude) const {
        osg::Vec3d point;
        _ellipsoid->convertLatLongHeightToXYZ(osg::DegreesToRadians(latitude), osg::DegreesToRadians(longitude),
                                              altitude, point.x(), point.y(), point.z());
        return point;
    }

    osg::ref_ptr<osg::Node> load() {
        const osg::Vec3d corner = at(_arguments.south, _arguments.west, 0.0);
        const osg::Vec3d middle =
            at(0.5 * (_arguments.south + _arguments.north), 0.5 * (_arguments.west + _arguments.east), 0.0);
        // the root file of osgbindem asks for bins, which one of the two is to do without
        osg::setNotifyLevel(osg::FATAL);
        const osg::ref_ptr<osg::Node> root = osgDB::readRefNodeFile(_arguments.database);
        osg::setNotifyLevel(osg::WARN);
        if (!root) throw std::runtime_error(_arguments.database + " cannot be read");
        Loader loader(middle, (corner - middle).length() + kHighest);
        root->accept(loader);
        _drawables = loader.drawables();
        root->getBound();
        return root;
    }

    void update() {
        ++_frame;
        _time += kFrameTime;
        _stamp->setFrameNumber(_frame);
        _stamp->setReferenceTime(_time);
        _stamp->setSimulationTime(_time);
        _update->setFrameStamp(_stamp);
        _update->setTraversalNumber(_frame);
        _with->accept(*_update);
    }

    // The first point where the segment meets the finest terrain that is loaded.
    [[nodiscard]] std::optional<osg::Vec3d> meet(const osg::Vec3d& from, const osg::Vec3d& to) const {
        const osg::ref_ptr<osgUtil::LineSegmentIntersector> line = new osgUtil::LineSegmentIntersector(from, to);
        osgUtil::IntersectionVisitor visitor(line);
        _without->accept(visitor);
        if (!line->containsIntersections()) return std::nullopt;
        return line->getFirstIntersection().getWorldIntersectPoint();
    }

    void fly(std::uint64_t flight, Totals& totals) {
        Random random(flight);
        const double latitude = random.uniform(_arguments.south, _arguments.north);
        const double longitude = random.uniform(_arguments.west, _arguments.east);
        const auto ground = meet(at(latitude, longitude, kHighest), at(latitude, longitude, -kHighest));
        if (!ground) return;
        const double height = random.logUniform(2.0, 2000.0);
        osg::Matrixd frame;
        _ellipsoid->computeLocalToWorldTransformFromXYZ(ground->x(), ground->y(), ground->z(), frame);
        const auto axis = [&](int i) { return osg::Vec3d(frame(i, 0), frame(i, 1), frame(i, 2)); };
        Eye eye{*ground + axis(2) * height, axis(0), axis(1), axis(2)};
        eye.heading = random.uniform(0.0, 2.0 * osg::PI);
        eye.pitch = osg::DegreesToRadians(random.uniform(-25.0, 10.0));
        eye.roll = random.chance(0.7) ? 0.0 : osg::DegreesToRadians(random.uniform(-30.0, 30.0));
        eye.turn = random.chance(0.5) ? 0.0 : osg::DegreesToRadians(random.uniform(-2.0, 2.0));
        if (random.chance(0.8)) {
            const double course = eye.heading + (random.chance(0.5) ? 0.0 : random.uniform(-3.0, 3.0));
            const double length = height * random.logUniform(1e-4, 0.3);
            eye.step =
                (eye.north * std::cos(course) + eye.east * std::sin(course) + eye.up * random.uniform(-0.3, 0.3)) *
                length;
        }
        const double nearPlane = random.logUniform(0.1, 2.0), farPlane = nearPlane * random.logUniform(3e5, 1e7);
        const osg::Matrixd projection = osg::Matrixd::perspective(random.uniform(15.0, 90.0), 1.0, nearPlane, farPlane);
        _time += 10.0;
        for (int i = 0; i < kFramesOfAFlight && totals.views < _arguments.views; ++i, eye.goOn()) {
            update();
            if (look(eye, projection, totals)) continue;
            std::printf("  flight %llu, frame %d, %.1f m above the ground at first, near plane %.2f m\n",
                        static_cast<unsigned long long>(flight), i, height, nearPlane);
            std::fflush(stdout);
        }
    }

    // doc/limits.md: an eye below the terrain, and a near plane that cuts it, look through the ground.
    [[nodiscard]] bool seesThroughGround(const Eye& eye, const osg::Matrixd& projection) const {
        if (meet(eye.position, eye.position + eye.up * (2.0 * kHighest))) return true;
        const osg::Matrixd toWorld = osg::Matrixd::inverse(eye.view() * projection);
        constexpr int kSteps = 8;
        for (int i = 0; i <= kSteps; ++i) {
            for (int j = 0; j <= kSteps; ++j) {
                const osg::Vec3d onNear = osg::Vec3d(2.0 * i / kSteps - 1.0, 2.0 * j / kSteps - 1.0, -1.0) * toWorld;
                if (meet(eye.position, onNear)) return true;
            }
        }
        return false;
    }

    Delivery deliver(osg::Node& root, const CullView& view, Recorder& recorder, Painter* painter) {
        recorder.setPainter(&_painter);
        const CullResult culled = cull(root, view, recorder, _frame, _time);
        Delivery delivery = recorder.takeDelivery();
        if (painter) delivery.painting = painter->paint(*culled.stage, *_stamp);
        return delivery;
    }

    // doc/limits.md: pixels through a slit between tiles. Higher in the picture, terrain without overhangs is farther
    // away: where the pixel above is nearer, there is a slit. `up`: the eye's vertical in the picture.
    [[nodiscard]] static bool isThroughSlit(const Painting& painting, std::size_t first, const osg::Vec3d& up) {
        const double longest = std::max(std::abs(up.x()), std::abs(up.y()));
        const long right = std::lround(up.x() / longest), above = std::lround(up.y() / longest);
        for (std::size_t pixel = first; pixel < painting.numbers.size(); ++pixel) {
            if (painting.numbers[pixel] != painting.numbers[first]) continue;
            const long column = static_cast<long>(pixel % Painting::kWidth) + right;
            const long row = static_cast<long>(pixel / Painting::kWidth) + above;
            if (std::min(column, row) < 0 || std::max(column, row) >= kPictureSize) return false;
            const auto over = static_cast<std::size_t>(row * Painting::kWidth + column);
            if (painting.depths[over] + kDepthSteps >= painting.depths[pixel]) return false;
        }
        return true;
    }

    // doc/limits.md: a pixel of a triangle that is seen edge-on, drawn nearer than all of its drawable is.
    [[nodiscard]] static bool isSliver(const Delivered& delivered, float depth) {
        const osg::Geometry* const geometry = delivered.drawable->asGeometry();
        const auto* const vertices =
            geometry ? dynamic_cast<const osg::Vec3Array*>(geometry->getVertexArray()) : nullptr;
        if (!vertices) return false;
        const osg::Matrixd toClip = delivered.modelView * delivered.givenProjection;
        return std::all_of(vertices->begin(), vertices->end(), [&](const osg::Vec3& vertex) {
            const osg::Vec4d clip = osg::Vec4d(osg::Vec3d(vertex), 1.0) * toClip;
            return clip.w() > 0.0 && static_cast<float>(0.5 * clip.z() / clip.w() + 0.5) > depth + kDepthSteps;
        });
    }

    // Returns: whether nothing is lost that is in a pixel.
    bool look(const Eye& eye, const osg::Matrixd& projection, Totals& totals) {
        CullView view;
        view.modelView = eye.view();
        view.projection = projection;
        view.states = _painter.states();
        const Delivery with = deliver(*_with, view, *_withBins, nullptr);
        const Delivery without = deliver(*_without, view, *_byOsg, &_painter);
        ++totals.views;
        totals.byOsg += without.drawables.size();
        totals.byBins += with.drawables.size();
        const BinStatistics* const statistics = BinStatistics::find(*_withBins);
        const std::size_t occluded = statistics ? statistics->getCounts().occluded : 0;
        totals.occluded += occluded;
        if (occluded > 0) ++totals.withHidden;
        struct Seen {
            std::size_t first = 0, count = 0;
        };
        std::map<std::uint32_t, Seen> pixels;
        const std::vector<std::uint32_t>& numbers = without.painting.numbers;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            Seen& seen = pixels[numbers[i]];
            if (seen.count++ == 0) seen.first = i;
        }
        std::vector<std::pair<std::string, Seen>> lost;
        for (const auto& [number, seen] : pixels) {
            const std::string* const key = _painter.keyOf(number);
            if (!key) continue;
            ++totals.visible;
            if (with.drawables.count(*key) == 0) lost.emplace_back(*key, seen);
        }
        if (lost.empty()) return true;
        const osg::Vec3d up = osg::Matrixd::transform3x3(eye.up, eye.view());
        const auto slits = std::partition(lost.begin(), lost.end(), [&](const auto& drawable) {
            return !isThroughSlit(without.painting, drawable.second.first, up);
        });
        for (auto it = slits; it != lost.end(); ++it) totals.slits += it->second.count;
        const auto slivers = std::remove_if(lost.begin(), slits, [&](const auto& drawable) {
            return drawable.second.count == 1 &&
                   isSliver(without.drawables.at(drawable.first), without.painting.depths[drawable.second.first]);
        });
        totals.slivers += static_cast<std::size_t>(slits - slivers);
        lost.erase(slivers, lost.end());
        if (lost.empty()) return true;
        if (seesThroughGround(eye, projection)) {
            ++totals.allowed;
            return true;
        }
        ++totals.failures;
        for (const auto& [key, seen] : lost) {
            const std::size_t column = seen.first % Painting::kWidth, row = seen.first / Painting::kWidth;
            std::printf("drawable %s has %zu pixels, first %zu %zu at depth %.9g, and is not drawn with bins\n",
                        key.c_str(), seen.count, column, row, static_cast<double>(without.painting.depths[seen.first]));
        }
        std::printf("  %zu tiles behind terrain\n", occluded);
        return false;
    }

    const Arguments& _arguments;
    Painter& _painter;
    const osg::ref_ptr<osg::EllipsoidModel> _ellipsoid = new osg::EllipsoidModel;
    const osg::ref_ptr<osg::FrameStamp> _stamp;
    const osg::ref_ptr<osgUtil::UpdateVisitor> _update = new osgUtil::UpdateVisitor;
    const osg::ref_ptr<Recorder> _byOsg = new Recorder, _withBins = new Recorder;
    osg::ref_ptr<osg::Node> _without, _with;
    std::size_t _drawables = 0;
    unsigned int _frame = 0;
    double _time = 0.0;
};

}  // namespace

int main(int argc, char** argv) {
    const auto arguments = parse(argc, argv);
    if (!arguments) {
        std::fputs(kUsage, stderr);
        return 2;
    }
    if (!osgDB::fileExists(arguments->database)) {
        std::fprintf(stderr, "%s is not there\n", arguments->database.c_str());
        return kSkipped;
    }
    // Where surfaces coincide, the same one wins with bins and without.
    osgUtil::RenderBin::setDefaultRenderBinSortMode(osgUtil::RenderBin::TRAVERSAL_ORDER);
    std::unique_ptr<Painter> painter;
    try {
        painter = std::make_unique<Painter>(Painter::Depths::OpenGL);
    } catch (const std::runtime_error& failure) {
        std::fprintf(stderr, "%s\n", failure.what());
        return kSkipped;
    }
    const auto start = std::chrono::steady_clock::now();
    Totals totals;
    try {
        Views(*arguments, *painter).run(totals);
    } catch (const std::runtime_error& failure) {
        std::fprintf(stderr, "%s\n", failure.what());
        return 1;
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::printf(
        "%zu views in %.0f s: %zu failures; %zu views through the ground, %zu pixels through slits between tiles, "
        "%zu of triangles seen edge-on; drawn by OSG %zu, with bins %zu, in a pixel %zu; %zu behind terrain, in "
        "%zu views\n",
        totals.views, seconds.count(), totals.failures, totals.allowed, totals.slits, totals.slivers, totals.byOsg,
        totals.byBins, totals.visible, totals.occluded, totals.withHidden);
    return totals.failures == 0 ? 0 : 1;
}
