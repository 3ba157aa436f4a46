// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BinCulling.h"
#include "Database.h"
#include "GlmBridge.h"
#include "InstalledTile.h"
#include "Inverse.h"
#include "Occluders.h"
#include "Spheres.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/TileFinder.h>
#include <osgAnalyticBin/core/ComparisonBins.h>
#include <osgAnalyticBin/core/GeodeticMapping.h>
#include <osgAnalyticBin/core/GeodeticQuadraticBin.h>
#include <osgAnalyticBin/core/HullSeparation.h>
#include <osgAnalyticBin/core/QuadraticBin.h>

#include <osg/CullStack>
#include <osg/Notify>

#include <algorithm>
#include <limits>
#include <variant>

namespace osgAnalyticBin {

namespace {

constexpr double kUnknown = -std::numeric_limits<double>::infinity();

bool isBox(Method method) {
    return method == Method::Box || method == Method::OrientedBox;
}

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

}  // namespace

AnalyticBinCullCallback::AnalyticBinCullCallback()
    : _surfaceLow(kUnknown),
      _surfaceHigh(-kUnknown),
      _binLow(kUnknown),
      _binHigh(-kUnknown),
      _ellipsoid(new osg::EllipsoidModel) {}

AnalyticBinCullCallback::AnalyticBinCullCallback(const AnalyticBin& bin, const osg::EllipsoidModel& ellipsoid,
                                                 const CullOptions& options)
    : _options(options),
      _bin(bin),
      _surfaceLow(kUnknown),
      _surfaceHigh(-kUnknown),
      _binLow(kUnknown),
      _binHigh(-kUnknown),
      _ellipsoid(new osg::EllipsoidModel(ellipsoid.getRadiusEquator(), ellipsoid.getRadiusPolar())) {
    prepare();
}

AnalyticBinCullCallback::AnalyticBinCullCallback(const AnalyticBinCullCallback& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop),
      osg::Callback(other, copyop),
      osg::NodeCallback(other, copyop),
      _wasInstalled(other._wasInstalled),
      _installed(other._installed ? new InstalledTile(*other._installed) : nullptr),
      _prepared(other._prepared),
      _hasLocalFrame(other._hasLocalFrame),
      _testsEdges(other._testsEdges),
      _hidesByPoint(other._hidesByPoint),
      _options(other._options),
      _ecefToLocal(other._ecefToLocal),
      _localToEcef(other._localToEcef),
      _bin(other._bin),
      _surface(other._surface),
      _surfaceLow(other._surfaceLow),
      _surfaceHigh(other._surfaceHigh),
      _binLow(other._binLow),
      _binHigh(other._binHigh),
      _shape(other._shape),
      _skirt(other._skirt),
      _ellipsoid(other._ellipsoid) {}

AnalyticBinCullCallback::~AnalyticBinCullCallback() = default;

AnalyticBin AnalyticBinCullCallback::shownBin() const {
    AnalyticBin bin = _shape ? _bin.exaggerated(_shape->verticalScale) : _bin;
    const core::Interval& altitude = bin.bin().altitude();
    if (bin.valid()) bin.setBin(bin.bin().withAltitude({altitude.lower - _skirt, altitude.upper}));
    return bin;
}

AnalyticBinCullCallback::PreparedBin AnalyticBinCullCallback::preparedBin(const AnalyticBin& shown,
                                                                          const core::Ellipsoid& ellipsoid) const {
    const core::ParameterBox box = core::parameterBox(shown.bin());
    switch (_options.method) {
        case Method::Paper:
            return core::PaperBin(core::GeodeticMapping(ellipsoid), box, _options.growth);
        case Method::Corners:
            return core::CornersBin(core::GeodeticMapping(ellipsoid), box);
        case Method::Box:
            return core::BoxBin(ellipsoid, shown.bin(), shown.margin());
        case Method::OrientedBox:
            return core::OrientedBoxBin(ellipsoid, shown.bin(), shown.margin());
        case Method::Exact:
            if (core::ExactGeodeticBin::holds(ellipsoid, shown.bin())) {
                return core::ExactGeodeticBin(ellipsoid, shown.bin(), shown.margin());
            }
            break;
        case Method::Quadratic:
        case Method::Sphere:
        case Method::None:
            break;
    }
    return core::GeodeticQuadraticBin(ellipsoid, shown.bin(), shown.margin());
}

void AnalyticBinCullCallback::prepare() {
    prepareBin();
    fillSlot();
}

void AnalyticBinCullCallback::prepareBin() {
    _prepared.reset();
    const AnalyticBin shown = shownBin();
    _binLow = shown.valid() ? shown.bin().altitude().lower - shown.margin() : kUnknown;
    _binHigh = shown.valid() ? shown.bin().altitude().upper + shown.margin() : -kUnknown;
    if (!shown.valid() || !hasValidRadii(*_ellipsoid)) return;
    if (_options.method == Method::None || _options.method == Method::Sphere) return;
    osg::BoundingSphere sphere = shown.boundingSphere(*_ellipsoid);
    if (_hasLocalFrame) sphere = movedSphere(sphere, _ecefToLocal);
    const core::Ellipsoid ellipsoid = toCore(*_ellipsoid);
    _prepared = Prepared{preparedBin(shown, ellipsoid),
                         std::nullopt,
                         std::nullopt,
                         ellipsoid,
                         sphere,
                         sphere,
                         std::nullopt,
                         std::nullopt};
    _testsEdges = _options.effectiveReverse();
    _hidesByPoint = isBox(_options.method);
    const bool isOwnEdge = isBox(_options.method) || std::holds_alternative<core::ExactGeodeticBin>(_prepared->bin);
    if (_testsEdges && !isOwnEdge && core::ExactGeodeticBin::holds(ellipsoid, shown.bin())) {
        _prepared->separable.emplace(ellipsoid, shown.bin(), shown.margin());
    }
    if (_options.effectiveHorizonUse() == HorizonUse::Off) return;
    _prepared->horizon.emplace(ellipsoid, shown.bin(), shown.margin());
    if (_hidesByPoint) _prepared->horizonPoint.emplace(*_prepared->horizon);
    if (shown.bin().altitude().upper >= 0.0) return;
    AnalyticBin column = shown;
    column.setBin(shown.bin().withAltitude({shown.bin().altitude().lower, 0.0}));
    _prepared->columnHorizon.emplace(ellipsoid, column.bin(), column.margin());
    if (!_hasLocalFrame) _prepared->columnSphere = column.boundingSphere(*_ellipsoid);
}

// All members of a family have the same frame, globe and terrain shape: a tile that changes one of them leaves.
void AnalyticBinCullCallback::leaveFamily() {
    if (_installed) _installed->leaveFamily();
}

void AnalyticBinCullCallback::fillSlot() const {
    if (!_installed) return;
    if (!_prepared) return _installed->emptySlot();
    TileBlock::Bins bins{std::get_if<core::GeodeticQuadraticBin>(&_prepared->bin),
                         std::get_if<core::ExactGeodeticBin>(&_prepared->bin)};
    const bool isForComparison = !bins.quadratic && !bins.exact;
    if (_prepared->horizon) bins.column = _prepared->columnHorizon ? &*_prepared->columnHorizon : &*_prepared->horizon;
    if (_prepared->horizon && !isForComparison) bins.horizon = &*_prepared->horizon;
    const bool hasOwnColumn = isForComparison || _prepared->columnHorizon.has_value();
    _installed->fillSlot(
        {_prepared->sphere, _prepared->columnSphere, _binHigh, _binLow, _surfaceHigh, _surfaceLow, hasOwnColumn}, bins);
}

void AnalyticBinCullCallback::setBin(const AnalyticBin& bin) {
    _bin = bin;
    prepare();
}

void AnalyticBinCullCallback::setTerrainShape(const std::optional<TerrainShape>& shape) {
    leaveFamily();
    _shape = shape;
    setSurface(_surface);
    prepare();
}

void AnalyticBinCullCallback::setSkirt(double metres) {
    _skirt = metres;
    prepare();
}

void AnalyticBinCullCallback::setSurface(const AnalyticBin& surface) {
    _surface = surface;
    const AnalyticBin shown = _shape ? surface.exaggerated(_shape->verticalScale) : surface;
    _surfaceLow = shown.valid() ? shown.bin().altitude().lower - shown.margin() : kUnknown;
    _surfaceHigh = shown.valid() ? shown.bin().altitude().upper + shown.margin() : -kUnknown;
    fillSlot();
}

bool AnalyticBinCullCallback::isColumnHiddenFrom(const core::HorizonEye& eye) const {
    if (!_prepared || !_prepared->horizon) return false;
    return eye.hides(_prepared->columnHorizon ? *_prepared->columnHorizon : *_prepared->horizon);
}

void AnalyticBinCullCallback::setCullOptions(const CullOptions& options) {
    _options = options;
    prepare();
}

void AnalyticBinCullCallback::setRadii(double equatorial, double polar) {
    leaveFamily();
    _ellipsoid = new osg::EllipsoidModel(equatorial, polar);
    prepare();
}

void AnalyticBinCullCallback::setLocalToEcef(const osg::Matrixd& matrix) {
    leaveFamily();
    _localToEcef = matrix;
    _hasLocalFrame = !matrix.isIdentity();
    const auto inverse = affineInverse(matrix);
    if (inverse) _ecefToLocal = *inverse;
    if (!inverse) {
        OSG_WARN << "AnalyticBinCullCallback: the matrix to ECEF has no inverse; the tile is never culled."
                 << std::endl;
        _bin.init();
    }
    prepare();
}

void AnalyticBinCullCallback::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    if (nv->asCullStack() && CullTraversal::of(*nv).isKept(*node)) {
        // its family has tested it
        traverse(node, nv);
        return;
    }
    cullOrTraverse(
        *nv, [&](osg::CullStack& cullStack) { return isCulled(*node, cullStack, *nv); }, [&] { traverse(node, nv); });
}

InstalledTile* AnalyticBinCullCallback::installedTile() const {
    return _installed.get();
}

void AnalyticBinCullCallback::setInstalledTile(InstalledTile* tile) {
    _installed = tile;
}

bool AnalyticBinCullCallback::isCulled(const osg::Node& node, osg::CullStack& cullStack, osg::NodeVisitor& nv) const {
    if (_options.method == Method::None) {
        cullStack.getCurrentCullingSet().getFrustum().getCurrentMask() = 0;
        return false;
    }
    // without its database nobody notices what is added below the tile, or how the terrain is shown
    const bool isAbandoned = _installed ? !_installed->mayCull(&node) : _wasInstalled;
    if (!_prepared || isAbandoned) return false;
    CullTraversal& traversal = CullTraversal::of(nv);
    const DatabaseView* database = traversal.databaseView();
    if (_shape && !database) return false;
    if (_shape && !(database->shape == *_shape)) {
        database->database->requestRefit();
        return false;
    }
    const auto test = [&](const core::PlaneSet& planes, core::PlaneMask& undecided) {
        const core::Side side = sideOf(planes, undecided);
        // finding the eye takes time
        const core::HorizonEye* const eye = side == core::Side::Outside ? nullptr : eyeOn(cullStack, nv, traversal);
        return verdict(side, planes, undecided, eye, traversal);
    };
    return isCulledByBin(cullStack, nv, traversal, _prepared->sphere,
                         [&](const osg::Polytope& frustum, core::PlaneMask& undecided) {
                             return _hasLocalFrame ? test(ecefPlanes(frustum, _ecefToLocal), undecided)
                                                   : test(traversal.planes(cullStack), undecided);
                         });
}

// A tile may have several parents, and transforms above it may have changed: the planes follow, the globe does not.
bool AnalyticBinCullCallback::standsAsInstalled(osg::CullStack& cullStack, const DatabaseView& database) const {
    const osg::RefMatrix* const modelView = cullStack.getModelViewMatrix();
    if (modelView == database.modelView && !_hasLocalFrame) return true;
    const double reach = database.modelView->getTrans().length() + _localToEcef.getTrans().length();
    return areNearlyEqual(*modelView, _localToEcef * *database.modelView, reach);
}

const core::HorizonEye* AnalyticBinCullCallback::eyeOn(osg::CullStack& cullStack, osg::NodeVisitor& nv,
                                                       CullTraversal& traversal) const {
    if (!_prepared->horizon) return nullptr;
    if (const DatabaseView* database = traversal.databaseView()) {
        // a camera between the database's root and the tile sees with other eyes
        const bool isSame = database->ellipsoid == _prepared->ellipsoid &&
                            database->projection == cullStack.getProjectionMatrix() && database->eye &&
                            standsAsInstalled(cullStack, *database);
        return isSame ? database->eye : nullptr;
    }
    if (_installed) return nullptr;
    // In a frame of its own the eye would have to be prepared anew for every tile.
    if (_options.horizonUse != HorizonUse::Given || _hasLocalFrame) return nullptr;
    const Occluder occluder{_prepared->ellipsoid, std::max(0.0, -_options.horizon), _options.inheritViewpoint};
    return traversal.horizonEye(cullStack, nv, occluder);
}

core::Side AnalyticBinCullCallback::sideOf(const core::PlaneSet& planes, core::PlaneMask& undecided) const {
    return std::visit([&](const auto& bin) { return core::classify(bin, planes, undecided); }, _prepared->bin);
}

Verdict AnalyticBinCullCallback::verdict(core::Side side, const core::PlaneSet& planes, core::PlaneMask undecided,
                                         const core::HorizonEye* eye, CullTraversal& traversal) const {
    if (side == core::Side::Outside) return {side, Verdict::Plane};
    if (eye && isHiddenFrom(*eye)) return {core::Side::Outside, Verdict::Horizon};
    if (side == core::Side::Straddling && _testsEdges && isBeyondAnEdge(traversal, planes, undecided)) {
        return {core::Side::Outside, Verdict::Edge};
    }
    return {side, Verdict::Plane};
}

bool AnalyticBinCullCallback::isHiddenFrom(const core::HorizonEye& eye) const {
    return _hidesByPoint ? eye.hides(*_prepared->horizonPoint) : eye.hides(*_prepared->horizon);
}

bool AnalyticBinCullCallback::isBeyondAnEdge(CullTraversal& traversal, const core::PlaneSet& planes,
                                             core::PlaneMask undecided) const {
    if (const auto* box = std::get_if<core::BoxBin>(&_prepared->bin)) {
        return core::isSeparated(*box, traversal.hull(planes));
    }
    if (const auto* box = std::get_if<core::OrientedBoxBin>(&_prepared->bin)) {
        return core::isSeparated(*box, traversal.hull(planes));
    }
    const auto* exact = std::get_if<core::ExactGeodeticBin>(&_prepared->bin);
    if (!exact && _prepared->separable) exact = &*_prepared->separable;
    return exact && core::isSeparated(*exact, planes, planes.size(), undecided);
}

}  // namespace osgAnalyticBin
