// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Run.h"

#include "Builder.h"
#include "Parts.h"

#include <osgAnalyticBin/InstallBinsCallback.h>

#include <osgDB/ObjectCache>

#include <exception>

namespace osgAnalyticBin::test {

namespace {

constexpr double kFrameTime = 1.0;

/// The files of the scene that runs, instead of those of a folder.
class FilesInMemory : public osgDB::ReadFileCallback {
public:
    osgDB::ReaderWriter::ReadResult readNode(const std::string& name, const osgDB::Options*) override {
        const osg::ref_ptr<osg::Node> node = builder ? builder->file(name) : nullptr;
        return node ? osgDB::ReaderWriter::ReadResult(node.get())
                    : osgDB::ReaderWriter::ReadResult(osgDB::ReaderWriter::ReadResult::FILE_NOT_FOUND);
    }
    const Builder* builder = nullptr;
};

FilesInMemory& filesInMemory() {
    static const osg::ref_ptr<FilesInMemory> files = new FilesInMemory;
    osgDB::Registry::instance()->setReadFileCallback(files);
    return *files;
}

/// OSG's cache of objects, which nothing is put into: a read callback reads all files.
class ObjectWatch : public osgDB::ObjectCache {
public:
    [[nodiscard]] std::size_t size() const { return _objectCache.size(); }
};

ObjectWatch& objectWatch() {
    static const osg::ref_ptr<ObjectWatch> watch = new ObjectWatch;
    osgDB::Registry::instance()->setObjectCache(watch);
    return *watch;
}

/// One of the two scenes, and the visitors that go with it.
class Scene {
public:
    explicit Scene(const Builder& builder) : root(builder.scene()) { _camera->addChild(root); }

    void update(osg::FrameStamp& stamp) {
        _update->setFrameStamp(&stamp);
        _update->setTraversalNumber(stamp.getFrameNumber());
        root->accept(*_update);
    }

    Delivery deliver(const ViewSpec& spec, osg::FrameStamp& stamp, Painter* painter) {
        CullView view = viewOf(spec);
        view.states = viewStates(painter);
        _recorder->setSmallFeatureCullingPixelSize(static_cast<float>(spec.smallFeaturePixels));
        undoMeddling();
        root->getBound();
        _recorder->setPainter(painter);
        _recorder->isViewPlain = isHarmless(*_ownStates);
        BinStatistics::of(*_recorder).setTileByTile(spec.isTileByTile);
        const CullResult culled = cull(*root, view, *_recorder, stamp.getFrameNumber(), stamp.getReferenceTime());
        Delivery delivery = _recorder->takeDelivery();
        delivery.projection = culled.projection;
        delivery.arePlanesComputed = spec.computeNearFar != osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR;
        if (painter) delivery.painting = painter->paint(*culled.stage, stamp);
        return delivery;
    }

    /// The part of `recorded` that OSG's own visitor gets; for that visitor the kit draws tiles directly. Returns:
    /// nullopt if it gets a drawable more often than the derived visitor that `recorded` is of, unless `mayGetMore`, if
    /// it gets one as often but in another way, if it gets the same drawables with other near and far planes, if levels
    /// that it draws are not stamped, or if a tile that it draws asks for fewer files.
    [[nodiscard]] std::optional<Delivery> deliverToOsg(const ViewSpec& spec, const osg::FrameStamp& stamp,
                                                       Delivery recorded, bool mayGetMore) {
        const osg::ref_ptr<osg::StateSet> states = viewStates(nullptr);
        const auto culledBy = [&](osgUtil::CullVisitor& visitor) {
            visitor.setSmallFeatureCullingPixelSize(static_cast<float>(spec.smallFeaturePixels));
            CullView view = viewOf(spec);
            view.states = states;
            undoMeddling();
            return cull(*root, view, visitor, stamp.getFrameNumber(), stamp.getReferenceTime());
        };
        forgetStamps();
        const osg::ref_ptr<Requests> asked = new Requests, expected = new Requests;
        _plain->setDatabaseRequestHandler(asked);
        _derived->setDatabaseRequestHandler(expected);
        const CullResult here = culledBy(*_plain);
        const std::vector<Leaf> plain = leavesIn(*here.stage);
        const bool isStamped = areStamped(plain, stamp);
        const CullResult there = culledBy(*_derived);
        const std::vector<Leaf> derived = leavesIn(*there.stage);
        const auto lacks = [&](const Request& request) {
            // the names of a tile and of its drawable end alike
            const std::size_t blank = std::min(request.first.find(' '), request.first.size());
            const std::string own = "#drawable" + request.first.substr(blank);
            const auto isOwn = [&](const Leaf& leaf) { return leaf.drawable->getName() == own; };
            return asked->files.count(request) == 0 && std::any_of(plain.begin(), plain.end(), isOwn);
        };
        if (!isStamped || std::any_of(expected->files.begin(), expected->files.end(), lacks)) return std::nullopt;
        if (withoutOthers(plain, derived) != withoutOthers(derived, plain)) return std::nullopt;
        if (!mayGetMore && hasMore(plain, derived)) return std::nullopt;
        if (plain == derived && here.projection != there.projection) return std::nullopt;
        const auto isAmong = [](const std::vector<Leaf>& leaves, const Delivered& delivered) {
            return std::any_of(leaves.begin(), leaves.end(), [&](const Leaf& leaf) {
                return leaf.drawable == delivered.drawable && leaf.matrix == delivered.modelView;
            });
        };
        // cameras with pictures of their own have their leaves elsewhere
        for (auto at = recorded.drawables.begin(); at != recorded.drawables.end();) {
            const bool isLost = isAmong(derived, at->second) && !isAmong(plain, at->second);
            at = isLost ? recorded.drawables.erase(at) : std::next(at);
        }
        return recorded;
    }

    [[nodiscard]] std::set<Request> takeRequests() { return _recorder->takeRequests(); }

    /// What the application sets for the view.
    void addViewState(const Part& part) { setState(part.variant, part.value, *_ownStates); }

    /// PagedLODs by themselves and the file that they page.
    [[nodiscard]] std::map<Request, std::set<osg::PagedLOD*>> waiting() {
        std::map<Request, std::set<osg::PagedLOD*>> found;
        walk(*root, [&](osg::Node& node) {
            auto* const paged = dynamic_cast<osg::PagedLOD*>(&node);
            const unsigned int count = paged ? paged->getNumChildren() : 0;
            const bool isAwaited = paged && count < paged->getNumFileNames() && !paged->getFileName(count).empty();
            if (isAwaited) found[{paged->getName(), paged->getFileName(count)}].insert(paged);
            return true;
        });
        return found;
    }

    osg::ref_ptr<osg::Group> root;

private:
    struct DerivedVisitor : osgUtil::CullVisitor {
        DerivedVisitor() { setDrawsAsCullVisitor(*this); }
    };

    void forgetStamps() {
        walk(*root, [](osg::Node& node) {
            auto* const paged = dynamic_cast<osg::PagedLOD*>(&node);
            for (unsigned int i = 0; paged && i < paged->getNumChildren(); ++i) {
                paged->setFrameNumberOfLastTraversal(0);
                paged->setTimeStamp(i, 0.0);
                paged->setFrameNumber(i, 0);
            }
            return true;
        });
    }

    // Whether levels above what is drawn say so, as osg::PagedLOD does it: others grow old, and files with them.
    static bool areStamped(const std::vector<Leaf>& leaves, const osg::FrameStamp& stamp) {
        const auto isStamped = [&](const Leaf& leaf) {
            const osg::Node* node = leaf.drawable;
            for (; node->getNumParents() == 1; node = node->getParent(0)) {
                const auto* const paged = dynamic_cast<const osg::PagedLOD*>(node->getParent(0));
                if (!paged) continue;
                const unsigned int level = paged->getChildIndex(node);
                if (paged->getFrameNumberOfLastTraversal() != stamp.getFrameNumber() ||
                    paged->getFrameNumber(level) != stamp.getFrameNumber() ||
                    paged->getTimeStamp(level) != stamp.getReferenceTime())
                    return false;
            }
            return true;
        };
        return std::all_of(leaves.begin(), leaves.end(), isStamped);
    }

    // How much more often one visitor gets a drawable than the other.
    static std::map<const osg::Drawable*, int> surplusOf(const std::vector<Leaf>& leaves,
                                                         const std::vector<Leaf>& other) {
        std::map<const osg::Drawable*, int> surplus;
        for (const Leaf& leaf : leaves) ++surplus[leaf.drawable];
        for (const Leaf& leaf : other) --surplus[leaf.drawable];
        return surplus;
    }

    static bool hasMore(const std::vector<Leaf>& leaves, const std::vector<Leaf>& other) {
        const auto surplus = surplusOf(leaves, other);
        return std::any_of(surplus.begin(), surplus.end(), [](const auto& each) { return each.second > 0; });
    }

    // Those of drawables that are delivered as often to the other visitor.
    static std::vector<Leaf> withoutOthers(const std::vector<Leaf>& leaves, const std::vector<Leaf>& other) {
        const auto surplus = surplusOf(leaves, other);
        std::vector<Leaf> common;
        std::copy_if(leaves.begin(), leaves.end(), std::back_inserter(common),
                     [&](const Leaf& leaf) { return surplus.at(leaf.drawable) == 0; });
        return common;
    }

    // A view has one state.
    [[nodiscard]] osg::ref_ptr<osg::StateSet> viewStates(Painter* painter) const {
        const osg::ref_ptr<osg::StateSet> states =
            painter ? new osg::StateSet(*painter->states(), osg::CopyOp::SHALLOW_COPY) : new osg::StateSet;
        states->merge(*_ownStates);
        return states;
    }

    [[nodiscard]] CullView viewOf(const ViewSpec& spec) const {
        CullView view;
        view.camera = _camera;
        view.modelView = spec.view;
        view.projection = spec.projection;
        view.cullingMode = spec.cullingMode;
        view.computeNearFar = spec.computeNearFar;
        return view;
    }

    const osg::ref_ptr<osg::Camera> _camera = new osg::Camera;
    const osg::ref_ptr<Recorder> _recorder = new Recorder;
    const osg::ref_ptr<osg::StateSet> _ownStates = new osg::StateSet;
    const osg::ref_ptr<osgUtil::CullVisitor> _plain = new osgUtil::CullVisitor, _derived = new DerivedVisitor;
    const osg::ref_ptr<osgUtil::UpdateVisitor> _update = new osgUtil::UpdateVisitor;
};

/// The run of one description.
class Runner {
public:
    Runner(const Description& description, RunTotals& totals, Painter* painter)
        : _description(description),
          _builder(description),
          _without(_builder),
          _with(_builder),
          _totals(totals),
          _painter(painter) {
        filesInMemory().builder = &_builder;
    }
    ~Runner() {
        filesInMemory().builder = nullptr;
        objectWatch().clear();
        (void)takeComplaint();
    }
    Runner(const Runner&) = delete;
    Runner& operator=(const Runner&) = delete;

    std::optional<Failure> run() {
        objectWatch().clear();
        for (const Part& part : _description.parts)
            if (part.frame == 0) beginView(part);
        installAll(nullptr);
        for (std::size_t i = 0; i < _description.views.size(); ++i)
            if (auto failure = runFrame(static_cast<int>(i) + 1, _description.views[i])) return failure;
        return std::nullopt;
    }

private:
    [[nodiscard]] osg::Node* globe(const Scene& scene, int number) const {
        return findNode(*scene.root, nodeName(Hook::Globe, {number, 0, 0, 0}));
    }

    void installAll(const CullOptions* options) {
        if (!_description.hasBins) return;
        for (std::size_t i = 0; i < _description.databases.size(); ++i) {
            const DatabaseSpec& spec = _description.databases[i];
            osg::Node* const node = globe(_with, static_cast<int>(i));
            if (!node) continue;
            if (!options && spec.requestsBins)
                node->addUpdateCallback(new InstallBinsCallback(spec.options));
            else
                (void)installBins(*node, options ? *options : spec.options);
        }
    }

    std::optional<Failure> runFrame(int frame, const ViewSpec& view) {
        _stamp->setFrameNumber(static_cast<unsigned int>(frame));
        _stamp->setReferenceTime(frame * kFrameTime);
        _stamp->setSimulationTime(frame * kFrameTime);
        if (auto failure = happenIn(frame, false)) return failure;
        _without.update(*_stamp);
        _with.update(*_stamp);
        if (auto failure = happenIn(frame, true)) return failure;
        if (!view.isActive) return std::nullopt;
        const Delivery with = _with.deliver(view, *_stamp, _painter);
        const Delivery without = _without.deliver(_painter ? withNearPlaneOf(with, view) : view, *_stamp, _painter);
        count(without, with);
        if (auto failure = _painter ? comparePictures(without, with, frame) : compare(without, with, view, frame))
            return failure;
        if (auto failure = checkDrawn(without, with, view, frame)) return failure;
        if (auto failure = _painter ? std::nullopt : compareVisitors(with, view, frame)) return failure;
        page();
        return checkApplication(frame);
    }

    // OSG computes other planes where more is drawn. With the same near plane pictures are the same.
    static ViewSpec withNearPlaneOf(const Delivery& delivery, ViewSpec view) {
        double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0, nearest = 0.0, farthest = 0.0;
        const bool isComputed = view.computeNearFar != osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR;
        if (!isComputed || !delivery.projection.getFrustum(left, right, bottom, top, nearest, farthest)) return view;
        constexpr double kFarther = 1e3;
        view.projection = osg::Matrixd::frustum(left, right, bottom, top, nearest, kFarther * farthest);
        view.computeNearFar = osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR;
        return view;
    }

    // What the application meets apart from pictures.
    std::optional<Failure> checkApplication(int frame) {
        if (const std::string text = takeComplaint(); !text.empty())
            return Failure{frame, "a node meets something that is not of OSG", text};
        if (objectWatch().size() > 0)
            return Failure{frame, "something is in the object cache", std::to_string(objectWatch().size())};
        for (const Part& part : _description.parts) {
            if (part.kind != PartKind::Pick || part.frame != frame) continue;
            const DatabaseSpec& database = _description.database(part.tile.database);
            const auto end = [&](double altitude) {
                return place(database, part.latitude, part.longitude, altitude) * database.toWorld(frame);
            };
            const Picked without = pick(*_without.root, end(part.high), end(part.low));
            const Picked with = pick(*_with.root, end(part.high), end(part.low));
            // spheres with bins hold scaled terrain, and are larger than OSG's
            const auto text = findPickDifference(without, with, !hasScaledTerrain(_description));
            if (text) return Failure{frame, "a pick differs", *text};
        }
        return std::nullopt;
    }

    [[nodiscard]] std::optional<Failure> compare(const Delivery& without, const Delivery& with, const ViewSpec& view,
                                                 int frame) const {
        WhatCounts counts;
        if (view.cullingMode & osg::CullSettings::SMALL_FEATURE_CULLING)
            counts.smallestPixels = 4.0 * view.smallFeaturePixels;
        constexpr int kPlanes = osg::CullSettings::NEAR_PLANE_CULLING | osg::CullSettings::FAR_PLANE_CULLING;
        counts.onlyBetweenGivenPlanes = (view.cullingMode & kPlanes) != 0;
        const auto found = findFalseCull(_description, without, with, allowedOccluders(_description), counts);
        return found ? std::optional(failed(*found, frame)) : std::nullopt;
    }

    // OSG's own visitor may get fewer drawables than a derived one, as long as nothing visible is missing. For a
    // derived visitor OSG tests again, below transforms, what spheres of groups have decided, and bins that cross more
    // than two planes are not tested against edges. It therefore keeps more tiles, among which there may be a hole, or
    // one that moves the near plane away.
    [[nodiscard]] std::optional<Failure> compareVisitors(const Delivery& derived, const ViewSpec& view, int frame) {
        // for a derived visitor OSG tests spheres of osgTerrain's tiles, which hold neither the scale nor the skirts
        const bool mayGetMore = hasTerrain(_description);
        const auto own = _with.deliverToOsg(view, *_stamp, derived, mayGetMore);
        if (!own)
            return Failure{frame, "OSG's own visitor gets more than a derived one, or gets it in another way", ""};
        auto failure = compare(derived, *own, view, frame);
        if (failure) failure->signature += " to OSG's own visitor";
        return failure;
    }

    [[nodiscard]] std::optional<Failure> comparePictures(const Delivery& without, const Delivery& with, int frame) {
        const auto found = findPictureDifference(_description, *_painter, without, with, allowedOccluders(_description),
                                                 _totals.pictures);
        if (!found) return std::nullopt;
        std::ostringstream text;
        text << found->pixels << " pixels differ, that at " << found->column << " " << found->row << " shows <"
             << found->without << "> without bins and <" << found->with << "> with them";
        return Failure{frame, "the pictures differ", text.str()};
    }

    // What is drawn with bins.
    static std::optional<Failure> checkDrawn(const Delivery& without, const Delivery& with, const ViewSpec& view,
                                             int frame) {
        const bool isCulled = view.cullingMode != osg::CullSettings::NO_CULLING;
        for (const auto& [key, delivered] : with.drawables) {
            if (delivered.isCountedCulled) return Failure{frame, "counted as culled, and drawn", key};
            // spheres may cull what bins keep, but only the application culls where nothing else does
            if (!isCulled && without.drawables.count(key) == 0)
                return Failure{frame, "drawn, though the application leaves it out", key};
        }
        return std::nullopt;
    }

    static Failure failed(const FalseCull& found, int frame) {
        std::ostringstream text;
        text.precision(10);
        const bool isModel = found.key.find("#model") != std::string::npos;
        text << found.key << ", a visible point is at " << found.pointInPicture.x() << " " << found.pointInPicture.y()
             << " in the picture, in eye space at " << found.pointInEyeSpace.x() << " " << found.pointInEyeSpace.y()
             << " " << found.pointInEyeSpace.z();
        return {frame, isModel ? "a model is lost" : "a tile is lost", text.str()};
    }

    void count(const Delivery& without, const Delivery& with) {
        _totals.delivered += without.drawables.size();
        _totals.drawn += with.drawables.size();
        for (const auto& [key, delivered] : without.drawables)
            if (with.drawables.count(key) == 0) ++_totals.lost;
    }

    void remove(const Part& part) {
        removePart(part, *_without.root);
        removePart(part, *_with.root);
    }

    // What is of the view, and not in the scene.
    void beginView(const Part& part) {
        if (part.kind != PartKind::State || part.hook != Hook::View) return;
        for (Scene* scene : {&_without, &_with}) scene->addViewState(part);
    }

    void applyToBoth(const Part& part) {
        beginView(part);
        applyPart(part, _description, *_without.root);
        applyPart(part, _description, *_with.root);
    }

    std::optional<Failure> happenIn(int frame, bool isLate) {
        for (const Part& part : _description.parts) {
            if (part.isLate != isLate) continue;
            if (part.until == frame) remove(part);
            if (part.frame != frame) continue;
            if (auto failure = happen(part)) return failure;
        }
        return std::nullopt;
    }

    std::optional<Failure> happen(const Part& part) {
        switch (part.kind) {
            case PartKind::SetOptions:
                if (_description.hasBins) (void)setCullOptions(*_with.root, part.options);
                break;
            case PartKind::Install:
                installAll(&part.options);
                break;
            case PartKind::Uninstall:
                return uninstall(part);
            case PartKind::Clone:
                _without.root = clonedScene(*_without.root, part.variant);
                _with.root = clonedScene(*_with.root, part.variant);
                _sharesCallbacks = true;
                break;
            case PartKind::UserCull:
            case PartKind::UserUpdate:
            case PartKind::LeavesOut:
            case PartKind::PushesState:
            case PartKind::Masks:
            case PartKind::Meddles:
            case PartKind::OneShot:
                // Copies of a globe may share its callbacks: what is nested in one of ours then runs on all of them.
                if (!_sharesCallbacks) applyToBoth(part);
                break;
            case PartKind::SaveAndLoad:
                _without.root = savedAndLoaded(*_without.root, part.variant % 2 == 1);
                _with.root = savedAndLoaded(*_with.root, part.variant % 2 == 1);
                _wasSaved = true;
                break;
            default:
                applyToBoth(part);
        }
        return std::nullopt;
    }

    std::optional<Failure> uninstall(const Part& part) {
        removeBins(*_with.root);
        removeRequests();
        ++_totals.undone;
        const auto difference = findDifference(*_without.root, *_with.root, _wasSaved);
        if (!difference) return std::nullopt;
        return Failure{part.frame, "not undone: " + difference->what, difference->text};
    }

    // The application's own wish for bins, on copies of globes too.
    void removeRequests() {
        const auto requestAmong = [](osg::Callback* callback) {
            while (callback && !dynamic_cast<InstallBinsCallback*>(callback)) callback = callback->getNestedCallback();
            return osg::ref_ptr<osg::Callback>(callback);
        };
        walk(*_with.root, [&](osg::Node& node) {
            if (!dynamic_cast<osg::CoordinateSystemNode*>(&node)) return true;
            if (const auto request = requestAmong(node.getUpdateCallback())) node.removeUpdateCallback(request);
            if (const auto request = requestAmong(node.getEventCallback())) node.removeEventCallback(request);
            return false;
        });
    }

    // Both scenes get what either of them has asked for.
    void page() {
        std::set<Request> requests = _without.takeRequests();
        for (const Request& request : _with.takeRequests()) requests.insert(request);
        auto without = _without.waiting();
        auto with = _with.waiting();
        for (const Request& request : requests) {
            for (osg::PagedLOD* paged : without[request]) load(*paged, request.second);
            for (osg::PagedLOD* paged : with[request]) load(*paged, request.second);
        }
    }

    static void load(osg::PagedLOD& paged, const std::string& name) {
        const osg::ref_ptr<osg::Node> content =
            osgDB::readRefNodeFile(name, dynamic_cast<osgDB::Options*>(paged.getDatabaseOptions()));
        if (!content) throw std::runtime_error("no content for " + name);
        paged.addChild(content);
    }

    const Description& _description;
    const Builder _builder;
    Scene _without, _with;
    RunTotals& _totals;
    Painter* const _painter;
    const osg::ref_ptr<osg::FrameStamp> _stamp = new osg::FrameStamp;
    bool _wasSaved = false;
    bool _sharesCallbacks = false;  // a part of the scene is a clone
};

}  // namespace

std::optional<Failure> run(const Description& description, RunTotals& totals, Painter* painter) {
    if (painter) painter->clear();
    try {
        return Runner(description, totals, painter).run();
    } catch (const std::exception& error) {
        return Failure{0, "exception", error.what()};
    }
}

}  // namespace osgAnalyticBin::test
