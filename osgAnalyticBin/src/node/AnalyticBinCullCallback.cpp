// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BinCulling.h"
#include "GlmBridge.h"
#include "Occluders.h"
#include "Spheres.h"
#include "Text.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/core/ComparisonBins.h>
#include <osgAnalyticBin/core/GeodeticMapping.h>
#include <osgAnalyticBin/core/QuadraticBin.h>

#include <osg/CullStack>
#include <osg/Notify>

#include <variant>

namespace osgAnalyticBin {

namespace {

using PreparedBin = std::variant<core::QuadraticBin, core::PaperBin, core::CornersBin>;

PreparedBin preparedBin(const AnalyticBin& bin, const core::Ellipsoid& ellipsoid, const CullOptions& options) {
    const core::GeodeticMapping mapping(ellipsoid);
    const core::ParameterBox box = core::parameterBox(bin.bin());
    switch (options.method) {
        case Method::Paper:
            return core::PaperBin(mapping, box, options.growth);
        case Method::Corners:
            return core::CornersBin(mapping, box);
        case Method::Quadratic:
        case Method::Sphere:
        case Method::None:
            break;
    }
    return core::QuadraticBin(mapping, box, bin.margin());
}

// The planes of a frustum, moved to ECEF as they are asked for.
class EcefPlanes {
public:
    EcefPlanes(const osg::Polytope& frustum, const osg::Matrixd* ecefToLocal)
        : _planes(frustum.getPlaneList()), _ecefToLocal(ecefToLocal) {}

    [[nodiscard]] std::size_t size() const { return _planes.size(); }

    [[nodiscard]] core::Plane operator[](std::size_t i) const {
        if (!_ecefToLocal) return toCore(_planes[i]);
        osg::Plane plane = _planes[i];
        plane.transformProvidingInverse(*_ecefToLocal);
        return toCore(plane);
    }

private:
    const osg::Polytope::PlaneList& _planes;
    const osg::Matrixd* _ecefToLocal;
};

}  // namespace

AnalyticBinCullCallback::AnalyticBinCullCallback() : _ellipsoid(new osg::EllipsoidModel) {}

AnalyticBinCullCallback::AnalyticBinCullCallback(const AnalyticBin& bin, const osg::EllipsoidModel& ellipsoid,
                                                 const CullOptions& options)
    : _options(options),
      _bin(bin),
      _ellipsoid(new osg::EllipsoidModel(ellipsoid.getRadiusEquator(), ellipsoid.getRadiusPolar())) {
    prepare();
}

AnalyticBinCullCallback::AnalyticBinCullCallback(const AnalyticBinCullCallback& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop),
      osg::Callback(other, copyop),
      osg::NodeCallback(other, copyop),
      _prepared(other._prepared),
      _hasLocalFrame(other._hasLocalFrame),
      _options(other._options),
      _ecefToLocal(other._ecefToLocal),
      _localToEcef(other._localToEcef),
      _bin(other._bin),
      _ellipsoid(other._ellipsoid) {}

AnalyticBinCullCallback::~AnalyticBinCullCallback() = default;

void AnalyticBinCullCallback::prepare() {
    _prepared.reset();
    if (!_bin.valid() || _options.method == Method::None || _options.method == Method::Sphere) return;
    osg::BoundingSphere sphere = _bin.boundingSphere(*_ellipsoid);
    if (_hasLocalFrame) sphere = movedSphere(sphere, _ecefToLocal);
    _prepared = Prepared{preparedBin(_bin, toCore(*_ellipsoid), _options), sphere};
}

void AnalyticBinCullCallback::setBin(const AnalyticBin& bin) {
    _bin = bin;
    prepare();
}

void AnalyticBinCullCallback::setCullOptions(const CullOptions& options) {
    _options = options;
    prepare();
}

void AnalyticBinCullCallback::setRadii(double equatorial, double polar) {
    _ellipsoid = new osg::EllipsoidModel(equatorial, polar);
    prepare();
}

void AnalyticBinCullCallback::setLocalToEcef(const osg::Matrixd& matrix) {
    _localToEcef = matrix;
    _hasLocalFrame = !matrix.isIdentity();
    if (_hasLocalFrame && !_ecefToLocal.invert(matrix)) {
        OSG_WARN << "AnalyticBinCullCallback: the matrix to ECEF has no inverse; the tile is never culled."
                 << std::endl;
        _bin.init();
    }
    prepare();
}

void AnalyticBinCullCallback::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    osg::CullStack* cullStack = nv->asCullStack();
    if (!cullStack) {
        traverse(node, nv);
        return;
    }
    if (isCulled(*cullStack, *nv)) return;
    const OccluderScope occluders(*cullStack);
    traverse(node, nv);
}

bool AnalyticBinCullCallback::isCulled(osg::CullStack& cullStack, osg::NodeVisitor& nv) const {
    if (_options.method == Method::None) {
        cullStack.getCurrentCullingSet().getFrustum().getCurrentMask() = 0;
        return false;
    }
    if (!_prepared) return false;
    return isCulledByBin(
        cullStack, nv, _prepared->sphere, [&](const osg::Polytope& frustum, core::PlaneMask& undecided) {
            const EcefPlanes planes(frustum, _hasLocalFrame ? &_ecefToLocal : nullptr);
            return std::visit([&](const auto& bin) { return core::classify(bin, planes, planes.size(), undecided); },
                              _prepared->bin);
        });
}

void AnalyticBinCullCallback::setBinText(const std::string& text) {
    setBin(AnalyticBin::fromText(text));
}

std::string AnalyticBinCullCallback::getBinText() const {
    return _bin.toText();
}

void AnalyticBinCullCallback::setOptionsText(const std::string& text) {
    std::string error;
    if (const auto options = cullOptionsFromText(text, error)) {
        setCullOptions(*options);
    } else {
        OSG_WARN << "AnalyticBinCullCallback: " << error << "; using the default." << std::endl;
    }
}

std::string AnalyticBinCullCallback::getOptionsText() const {
    return toText(_options);
}

void AnalyticBinCullCallback::setRadiiText(const std::string& text) {
    const auto radii = numbersFromText(text, 2);
    if (radii && (*radii)[0] > 0.0 && (*radii)[1] > 0.0) {
        setRadii((*radii)[0], (*radii)[1]);
        return;
    }
    OSG_WARN << "AnalyticBinCullCallback: the radii \"" << text.substr(0, 80)
             << "\" are not two positive numbers; the tile is never culled." << std::endl;
    setBin(AnalyticBin());
}

std::string AnalyticBinCullCallback::getRadiiText() const {
    return numbersToText({_ellipsoid->getRadiusEquator(), _ellipsoid->getRadiusPolar()});
}

void AnalyticBinCullCallback::setLocalToEcefText(const std::string& text) {
    if (text.empty()) return;
    const auto values = numbersFromText(text, 16);
    if (values) {
        setLocalToEcef(osg::Matrixd(values->data()));
        return;
    }
    OSG_WARN << "AnalyticBinCullCallback: the matrix to ECEF is not sixteen numbers; the tile is never culled."
             << std::endl;
    setBin(AnalyticBin());
}

std::string AnalyticBinCullCallback::getLocalToEcefText() const {
    if (!_hasLocalFrame) return {};
    return numbersToText(std::vector<double>(_localToEcef.ptr(), _localToEcef.ptr() + 16));
}

}  // namespace osgAnalyticBin
