// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../../core/PerThread.h"
#include "../GlmBridge.h"
#include "../Inverse.h"
#include "../Spheres.h"
#include "../tile/InstalledDatabase.h"
#include "../tile/InstalledTile.h"
#include "CullScopes.h"
#include "CullTraversal.h"
#include "DrawnState.h"
#include "ForeignCallbacks.h"
#include "Viewpoint.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/TileFrame.h>
#include <osgAnalyticBin/core/edge/HullSeparation.h>

#include <osg/CullStack>
#include <osg/Notify>

#include <algorithm>
#include <array>
#include <memory>
#include <variant>

namespace osgAnalyticBin {

namespace {

// The planes of a frustum, moved to ECEF.
core::PlaneSet ecefPlanes(const osg::Polytope& frustum, const osg::Matrixd& ecefToLocal) {
    core::PlaneSet planes;
    for (osg::Plane plane : frustum.getPlaneList()) {
        if (planes.size() == core::kMaxPlanes) break;
        plane.transformProvidingInverse(ecefToLocal);
        planes.push_back(toCore(plane));
    }
    return planes;
}

// Whether the database that is traversed is shown in the shape that a bin was fitted to. If it is not, requests a fit
// to the present shape. Returns: false without a database.
bool isShownIn(const TerrainShape& fitted, const CullTraversal& traversal) {
    const DatabaseView* const view = traversal.databaseView();
    if (!view) return false;
    const bool isShown = view->shape == fitted;
    if (!isShown) view->database->requestRefit();
    return isShown;
}

}  // namespace

AnalyticBinCullCallback::AnalyticBinCullCallback()
    : _setup(shared({{}, osg::WGS_84_RADIUS_EQUATOR, osg::WGS_84_RADIUS_POLAR, {}})) {}

AnalyticBinCullCallback::AnalyticBinCullCallback(const AnalyticBin& bin, const osg::EllipsoidModel& ellipsoid,
                                                 const CullOptions& options)
    : _setup(shared({options, ellipsoid.getRadiusEquator(), ellipsoid.getRadiusPolar(), {}})), _bin(bin) {
    changeBin();
}

AnalyticBinCullCallback::AnalyticBinCullCallback(const AnalyticBinCullCallback& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop),
      osg::Callback(other, copyop),
      osg::NodeCallback(other, copyop),
      _wasInstalled(other._wasInstalled),
      _installed(other._installed ? new InstalledTile(*other._installed) : nullptr),
      _isTested(other._isTested),
      _setup(other._setup),
      _frame(other._frame ? std::make_unique<const LocalFrame>(*other._frame) : nullptr),
      _bin(other._bin),
      _surface(other._surface),
      _altitude(other._altitude),
      _surfaceAltitude(other._surfaceAltitude),
      _skirt(other._skirt) {}

bool AnalyticBinCullCallback::Setup::operator==(const Setup& other) const {
    return equatorialRadius == other.equatorialRadius && polarRadius == other.polarRadius && shape == other.shape &&
           options == other.options;
}

std::shared_ptr<const AnalyticBinCullCallback::Setup> AnalyticBinCullCallback::shared(const Setup& setup) {
    // the pager's threads install bins too
    static thread_local PerThread<std::array<std::weak_ptr<const Setup>, 4>> kept;
    static thread_local std::size_t next = 0;
    auto& lately = *kept;
    for (const auto& one : lately) {
        if (auto known = one.lock(); known && *known == setup) return known;
    }
    auto made = std::make_shared<const Setup>(setup);
    lately[next++ % lately.size()] = made;
    return made;
}

AnalyticBinCullCallback::~AnalyticBinCullCallback() {
    discardPrepared();
}

core::QuadraticOrExact AnalyticBinCullCallback::preparedBin(const AnalyticBin& shown,
                                                            const core::Ellipsoid& ellipsoid) const {
    if (_setup->options.method == Method::Exact && core::ExactGeodeticBin::holds(ellipsoid, shown.bin()))
        return core::ExactGeodeticBin(ellipsoid, shown.bin(), shown.margin());
    return core::quadraticOrExact(ellipsoid, shown.bin(), shown.margin());
}

core::Interval AnalyticBinCullCallback::altitudeOf(const AnalyticBin& shown) {
    if (!shown.valid()) return kUnknown;
    const core::Interval& altitude = shown.bin().altitude();
    return {altitude.lower - shown.margin(), altitude.upper + shown.margin()};
}

// Called when the shown bin, the globe, the frame or the options have changed.
void AnalyticBinCullCallback::changeBin() {
    const AnalyticBin shown = shownBin();
    _altitude = altitudeOf(shown);
    const bool hasMethod = _setup->options.method != Method::None && _setup->options.method != Method::Sphere;
    _isTested =
        hasMethod && shown.valid() && (areValidRadii(_setup->equatorialRadius, _setup->polarRadius) || isInMap());
    discardPrepared();
    fillSlot();
}

void AnalyticBinCullCallback::discardPrepared() {
    delete _prepared.exchange(nullptr);
}

// Several cull traversals may come here first; one's work is kept.
const AnalyticBinCullCallback::Prepared& AnalyticBinCullCallback::prepared() const {
    const Prepared* known = _prepared.load(std::memory_order_acquire);
    if (known) return *known;
    auto made = std::make_unique<const Prepared>(makePrepared());
    return _prepared.compare_exchange_strong(known, made.get(), std::memory_order_acq_rel) ? *made.release() : *known;
}

AnalyticBinCullCallback::Prepared AnalyticBinCullCallback::makePrepared() const {
    const AnalyticBin shown = shownBin();
    const core::Ellipsoid ellipsoid = this->ellipsoid();
    const osg::ref_ptr<osg::EllipsoidModel> model =
        new osg::EllipsoidModel(_setup->equatorialRadius, _setup->polarRadius);
    osg::BoundingSphere sphere = shown.boundingSphere(*model);
    if (_frame) sphere = movedSphere(sphere, _frame->fromEcef);
    Prepared prepared{preparedBin(shown, ellipsoid), {}, {}, sphere, sphere, {}};
    const bool isExact = std::holds_alternative<core::ExactGeodeticBin>(prepared.bin);
    if (_setup->options.edges && !isExact && core::ExactGeodeticBin::holds(ellipsoid, shown.bin())) {
        prepared.separable.emplace(ellipsoid, shown.bin(), shown.margin());
    }
    if (_setup->options.horizonUse == HorizonUse::Off || isInMap()) return prepared;
    prepared.horizon.emplace(ellipsoid, shown.bin(), shown.margin());
    if (shown.bin().altitude().upper >= 0.0) return prepared;
    AnalyticBin column = shown;
    column.setBin(shown.bin().withAltitude({shown.bin().altitude().lower, 0.0}));
    prepared.columnHorizon.emplace(ellipsoid, column.bin(), column.margin());
    if (!_frame) prepared.columnSphere = column.boundingSphere(*model);
    return prepared;
}

template <class Change>
void AnalyticBinCullCallback::changeSetup(const Change& change) {
    Setup setup = *_setup;
    change(setup);
    _setup = shared(setup);
}

// All members of a family have the same frame, globe and terrain shape, and are tested against edges or not: a tile
// that changes one of these leaves.
void AnalyticBinCullCallback::leaveFamily() {
    if (_installed) _installed->leaveFamily();
}

// The slot copies the numbers, so that they need not be kept here.
void AnalyticBinCullCallback::fillSlot() const {
    if (!_installed || !_installed->hasFamily()) return;
    if (!_isTested) return _installed->emptySlot();
    const Prepared prepared = makePrepared();
    TileBlock::Bins bins{std::get_if<core::QuadraticBin>(&prepared.bin),
                         std::get_if<core::ExactGeodeticBin>(&prepared.bin)};
    if (prepared.horizon) bins.horizon = &*prepared.horizon;
    bins.column = prepared.columnHorizon ? &*prepared.columnHorizon : bins.horizon;
    _installed->fillSlot({prepared.sphere, prepared.columnSphere, _altitude, _surfaceAltitude,
                          prepared.columnHorizon.has_value(), _installed->has(InstalledTile::Declared)},
                         bins);
}

void AnalyticBinCullCallback::setBin(const AnalyticBin& bin) {
    _bin = bin;
    changeBin();
}

AnalyticBin AnalyticBinCullCallback::shownBin() const {
    return (_setup->shape ? _bin.exaggerated(_setup->shape->verticalScale) : _bin).withSkirts(_skirt);
}

void AnalyticBinCullCallback::setTerrainShape(const std::optional<TerrainShape>& shape) {
    leaveFamily();
    changeSetup([&](Setup& setup) { setup.shape = shape; });
    setSurface(_surface);
    changeBin();
}

void AnalyticBinCullCallback::setSkirt(double metres) {
    _skirt = metres;
    changeBin();
}

void AnalyticBinCullCallback::setSurface(const AnalyticBin& surface) {
    _surface = surface;
    const AnalyticBin shown = _setup->shape ? surface.exaggerated(_setup->shape->verticalScale) : surface;
    _surfaceAltitude = altitudeOf(shown);
    fillSlot();
}

bool AnalyticBinCullCallback::isColumnHiddenFrom(const core::HorizonEye& eye) const {
    if (!_isTested) return false;
    const Prepared& tile = prepared();
    return tile.horizon && eye.hides(tile.columnHorizon ? *tile.columnHorizon : *tile.horizon);
}

const osg::BoundingSphere* AnalyticBinCullCallback::ecefColumnSphere() const {
    return _isTested && !_frame ? &prepared().columnSphere : nullptr;
}

void AnalyticBinCullCallback::setCullOptions(const CullOptions& options) {
    if (options.edges != _setup->options.edges) leaveFamily();
    changeSetup([&](Setup& setup) { setup.options = options; });
    changeBin();
}

void AnalyticBinCullCallback::setRadii(double equatorial, double polar) {
    leaveFamily();
    changeSetup([&](Setup& setup) {
        setup.equatorialRadius = equatorial;
        setup.polarRadius = polar;
    });
    changeBin();
}

void AnalyticBinCullCallback::setLocalToEcef(const osg::Matrixd& matrix) {
    leaveFamily();
    const auto inverse = affineInverse(matrix);
    _frame.reset();
    if (!matrix.isIdentity()) _frame.reset(new LocalFrame{matrix, inverse.value_or(osg::Matrixd())});
    if (!inverse) {
        OSG_WARN << "AnalyticBinCullCallback: the matrix to ECEF has no inverse; the tile is never culled."
                 << std::endl;
        _bin.init();
    }
    changeBin();
}

const osg::Matrixd& AnalyticBinCullCallback::getLocalToEcef() const {
    static const osg::Matrixd identity;
    return _frame ? _frame->toEcef : identity;
}

void AnalyticBinCullCallback::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    osg::CullStack* const cullStack = nv->asCullStack();
    if (cullStack && isSurelyInside(*cullStack)) return static_cast<void>(traverse(node, nv));
    const CullTraversal* const traversal = cullStack ? &CullTraversal::of(*nv) : nullptr;
    if (traversal && traversal->isLeftToOsg()) return static_cast<void>(traverse(node, nv));
    if (traversal && traversal->isKept(*node)) {
        // its family has tested it
        cullStack->getCurrentCullingSet().setCullingMask(traversal->maskBelowKept());
        traverse(node, nv);
        return;
    }
    cullOrTraverse(
        *nv, [&](osg::CullStack& stack) { return isCulled(*node, stack, *nv); }, [&] { traverse(node, nv); });
}

// Whether no test is left: the tile's sphere, or what is above, is inside all planes, and nothing is hidden here.
bool AnalyticBinCullCallback::isSurelyInside(osg::CullStack& cullStack) const {
    return cullStack.getCurrentCullingSet().getFrustum().getCurrentMask() == 0 && isInMap() &&
           _setup->options.occlusion == OcclusionUse::Off;
}

const core::HorizonEye* AnalyticBinCullCallback::horizonEye(osg::NodeVisitor& visitor) {
    const DatabaseView* const view = CullTraversal::of(visitor).databaseView();
    return view ? view->eye : nullptr;
}

InstalledTile* AnalyticBinCullCallback::getInstalledTile() const {
    return _installed.get();
}

void AnalyticBinCullCallback::setInstalledTile(InstalledTile* tile) {
    _installed = tile;
    if (tile) tile->setCallback(this);
}

bool AnalyticBinCullCallback::isCulled(const osg::Node& node, osg::CullStack& cullStack, osg::NodeVisitor& nv) const {
    if (_setup->options.method == Method::None) {
        cullStack.getCurrentCullingSet().getFrustum().getCurrentMask() = 0;
        return false;
    }
    // without its database, content added below the tile and changes of the terrain's shape go unnoticed
    const bool isAbandoned = _installed ? !_installed->mayCull(&node) : _wasInstalled;
    if (!_isTested || isAbandoned) return false;
    CullTraversal& traversal = CullTraversal::of(nv);
    if (_setup->shape && !isShownIn(*_setup->shape, traversal)) return false;
    BinReason reason = nullptr;
    const auto classify = [&](const core::PlaneSet& planes, core::PlaneMask& undecided) {
        const core::Side side = core::classify(prepared().bin, planes, undecided);
        if (side == core::Side::Outside) return side;
        // what else is known of the view takes time to find
        if (prepared().horizon || (isInMap() && _setup->options.occlusion != OcclusionUse::Off))
            reason = hiddenBy(node, nv, cullStack, traversal);
        const bool isBeyond =
            !reason && side == core::Side::Straddling && _setup->options.edges && isBeyondAnEdge(planes, undecided);
        if (isBeyond) reason = &BinCounts::beyondEdge;
        return reason ? core::Side::Outside : side;
    };
    core::Side side = core::Side::Straddling;
    const auto test = [&](const osg::Polytope& frustum, core::PlaneMask& undecided) {
        return side = _frame ? classify(ecefPlanes(frustum, _frame->fromEcef), undecided)
                             : classify(traversal.planes(cullStack), undecided);
    };
    const bool culled =
        isOutside(cullStack, test) || isSmallTile(cullStack.getCurrentCullingSet(), prepared().sphere, node);
    const DatabaseView* const database = traversal.databaseView();
    if (database && database->gain) database->gain->count(!culled);
    if (nv.getVisitorType() == osg::NodeVisitor::CULL_VISITOR)
        traversal.statistics().count(culled ? core::Side::Outside : side, nv.getTraversalNumber(), reason);
    return culled;
}

// Whether it obeys depth, with all that is below it, and by the states down to it, from the database if there is one.
bool AnalyticBinCullCallback::mayBeHidden(const osg::Node& node, osg::NodeVisitor& nv, const DatabaseView* view) const {
    const StateRules rules = view ? view->rules : StateRules::of(nv, _setup->options.plainShaders);
    const bool obeys = !_installed || !_installed->has(InstalledTile::IgnoresDepth);
    return obeys && drawnStateOf(node, rules).obeysDepth && !hasForeignCallback<AnalyticBinCullCallback>(node) &&
           drawnStateAbove(nv, rules, view ? view->states : nullptr).obeysDepth;
}

// By what the tile is hidden; null: by nothing. The states are asked last: that takes longest.
BinReason AnalyticBinCullCallback::hiddenBy(const osg::Node& node, osg::NodeVisitor& nv, osg::CullStack& cullStack,
                                            CullTraversal& traversal) const {
    const DatabaseView* const view = viewOn(cullStack, traversal);
    const bool isOccluded = view && view->hidden->isOccluded(*this);
    const auto isBeyondHorizon = [&] {
        if (!prepared().horizon) return false;
        if (view) return view->eye && view->eye->hides(*prepared().horizon);
        const auto eye = eyeWithoutDatabase(cullStack, nv, traversal);
        return eye && eye->hides(*prepared().horizon);
    };
    if (!(isOccluded || isBeyondHorizon()) || !mayBeHidden(node, nv, view)) return nullptr;
    return isOccluded ? &BinCounts::occluded : &BinCounts::hidden;
}

// A tile may have several parents, and transforms above it may have changed: the planes follow, the globe does not.
bool AnalyticBinCullCallback::standsAsInstalled(osg::CullStack& cullStack, const DatabaseView& database) const {
    const osg::RefMatrix* const modelView = cullStack.getModelViewMatrix();
    if (modelView == database.modelView && !_frame) return true;
    const double reach = database.modelView->getTrans().length() + getLocalToEcef().getTrans().length();
    return areNearlyEqual(*modelView, getLocalToEcef() * *database.modelView, reach);
}

// What the database provides, if it provides it for this camera and for the place of the tile.
const DatabaseView* AnalyticBinCullCallback::viewOn(osg::CullStack& cullStack, CullTraversal& traversal) const {
    const DatabaseView* const database = traversal.databaseView();
    // a camera between the database's root and the tile has another eye
    const bool isSame = database && database->ellipsoid == ellipsoid() &&
                        database->projection == cullStack.getProjectionMatrix() &&
                        standsAsInstalled(cullStack, *database);
    return isSame ? database : nullptr;
}

std::optional<core::HorizonEye> AnalyticBinCullCallback::eyeWithoutDatabase(osg::CullStack& cullStack,
                                                                            osg::NodeVisitor& nv,
                                                                            const CullTraversal& traversal) const {
    if (_installed || traversal.databaseView()) return std::nullopt;
    if (_setup->options.horizonUse != HorizonUse::Given || _frame || isInMap()) return std::nullopt;
    const auto viewpoint = Viewpoint::of(cullStack, nv, _setup->options.inheritViewpoint);
    return viewpoint ? viewpoint->above(ellipsoid(), std::max(0.0, -_setup->options.horizon)) : std::nullopt;
}

bool AnalyticBinCullCallback::isBeyondAnEdge(const core::PlaneSet& planes, core::PlaneMask undecided) const {
    const Prepared& tile = prepared();
    const auto* quadratic = isInMap() ? std::get_if<core::QuadraticBin>(&tile.bin) : nullptr;
    if (quadratic) return core::isSeparated(*quadratic, planes, planes.size(), undecided);
    const auto* exact = std::get_if<core::ExactGeodeticBin>(&tile.bin);
    if (!exact && tile.separable) exact = &*tile.separable;
    return exact && core::isSeparated(*exact, planes, planes.size(), undecided);
}

}  // namespace osgAnalyticBin
