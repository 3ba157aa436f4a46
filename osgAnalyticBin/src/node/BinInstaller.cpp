// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BinReadFileCallback.h"
#include "PagingExpiry.h"
#include "TerrainBounds.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/BinInstaller.h>
#include <osgAnalyticBin/InstallBinsCallback.h>

#include <osg/Drawable>
#include <osg/MatrixTransform>
#include <osg/Notify>
#include <osg/PagedLOD>
#include <osg/PositionAttitudeTransform>
#include <osgDB/Registry>

#include <cstring>

namespace osgAnalyticBin {

namespace {

// What no terrain on earth leaves, the Challenger Deep and Everest included: for tiles whose descendants' heights are
// not known.
constexpr core::Interval kTerrainAltitudes{-11500.0, 9000.0};

// A terrain tile that is traversed before it has its Terrain never finds it afterwards.
bool mustNotBeTraversed(const osg::Node& node) {
    return std::strcmp(node.libraryName(), "osgTerrain") == 0 && std::strcmp(node.className(), "TerrainTile") == 0;
}

// Transforms that stay as they are once loaded; others have no fixed place on the globe.
bool isFixed(osg::Transform& node) {
    const bool known = node.asMatrixTransform() || node.asPositionAttitudeTransform();
    return known && node.getReferenceFrame() == osg::Transform::RELATIVE_RF && !node.getUpdateCallback() &&
           node.getDataVariance() != osg::Object::DYNAMIC;
}

AnalyticBinCullCallback* installedCallback(osg::Node& node) {
    for (osg::Callback* callback = node.getCullCallback(); callback; callback = callback->getNestedCallback()) {
        if (auto* ours = dynamic_cast<AnalyticBinCullCallback*>(callback)) return ours;
    }
    return nullptr;
}

// Returns: whether there was anything to take away.
bool uninstall(osg::Node& node) {
    bool found = false;
    while (const osg::ref_ptr<AnalyticBinCullCallback> ours = installedCallback(node)) {
        node.removeCullCallback(ours.get());
        node.setCullingActive(true);
        found = true;
    }
    return found;
}

// A database's own request to install bins is settled by the installer; what it declares counts where the installer was
// told nothing else. Returns: the options for the node and what is below it.
CullOptions settled(osg::Node& node, const CullOptions& options) {
    CullOptions effective = options;
    for (osg::Callback* callback = node.getUpdateCallback(); callback; callback = callback->getNestedCallback()) {
        auto* request = dynamic_cast<InstallBinsCallback*>(callback);
        if (!request) continue;
        const CullOptions declared = request->cullOptions();
        if (effective.horizonUse == HorizonUse::Declared && declared.horizonUse == HorizonUse::Given) {
            effective.horizonUse = HorizonUse::Given;
            effective.horizon = declared.horizon;
        }
        request->setDone();
    }
    return effective;
}

osgDB::ReadFileCallback* previousCallback(const osgDB::Options& options) {
    osgDB::ReadFileCallback* callback = options.getReadFileCallback();
    auto* ours = dynamic_cast<BinReadFileCallback*>(callback);
    return ours ? ours->previous() : callback;
}

// Sets a member for the length of a scope.
template <class T>
class Scoped {
public:
    Scoped(T& member, const T& value) : _member(member), _outer(member) { _member = value; }
    ~Scoped() { _member = _outer; }
    Scoped(const Scoped&) = delete;
    Scoped& operator=(const Scoped&) = delete;

private:
    T& _member;
    const T _outer;
};

}  // namespace

BinInstaller::BinInstaller(const CullOptions& options) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _options(options) {
    setNodeMaskOverride(~0u);
}

BinInstaller::~BinInstaller() = default;

void BinInstaller::setFrame(const osg::EllipsoidModel* ellipsoid, const osg::Matrixd& localToEcef) {
    _ellipsoid = ellipsoid;
    _localToEcef = localToEcef;
}

void BinInstaller::apply(osg::Node& node) {
    const Scoped options(_options, settled(node, _options));
    if (hasStoredBin(node)) {
        treatTile(node, storedBin(node));
    } else {
        treatOther(node);
    }
}

void BinInstaller::apply(osg::CoordinateSystemNode& node) {
    const osg::ref_ptr<const osg::EllipsoidModel> own =
        node.getEllipsoidModel() ? node.getEllipsoidModel() : new osg::EllipsoidModel;
    const Scoped ellipsoid(_ellipsoid, own);
    const Scoped frame(_localToEcef, osg::Matrixd());
    const Scoped options(_pagingOptions, PagingOptions());
    apply(static_cast<osg::Node&>(node));
}

void BinInstaller::apply(osg::Transform& node) {
    // Without a CoordinateSystemNode above, a tile's own frame is ECEF, whatever moves the globe.
    osg::Matrixd frame = _ellipsoid ? _localToEcef : osg::Matrixd();
    if (!_ellipsoid && !hasStoredBin(node)) return apply(static_cast<osg::Node&>(node));
    if (!isFixed(node)) return;
    node.computeLocalToWorldMatrix(frame, this);
    const Scoped scope(_localToEcef, frame);
    const Scoped options(_pagingOptions, PagingOptions());
    apply(static_cast<osg::Node&>(node));
}

void BinInstaller::apply(osg::PagedLOD& node) {
    const Scoped options(_options, settled(node, _options));
    followPaging(node);
    if (const auto* before = installedCallback(node)) restoreExpiry(node, before->cullOptions().expiry);
    const AnalyticBin bin = hasStoredBin(node) ? storedBin(node) : boundsOfOwnGeometry(node);
    if (bin.valid() || hasStoredBin(node)) {
        treatTile(node, bin);
    } else {
        treatOther(node);
    }
    if (installedCallback(node)) raiseExpiry(node, _options.expiry);
}

void BinInstaller::apply(osg::Drawable& drawable) {
    if (_options.method == Method::None) drawable.setCullingActive(false);
}

void BinInstaller::treatTile(osg::Node& node, const AnalyticBin& bin) {
    const bool wasInstalled = uninstall(node);
    if (_options.method == Method::Sphere || _options.method == Method::None) {
        const Scoped inside(_insideTile, _insideTile || wasInstalled);
        return treatOther(node);
    }
    const osg::ref_ptr<const osg::EllipsoidModel> ellipsoid = _ellipsoid ? _ellipsoid : new osg::EllipsoidModel;
    osg::ref_ptr<AnalyticBinCullCallback> callback = new AnalyticBinCullCallback(bin, *ellipsoid, _options);
    if (!_localToEcef.isIdentity()) callback->setLocalToEcef(_localToEcef);
    // In front: what is nested runs when the tile is kept.
    callback->setNestedCallback(node.getCullCallback());
    node.setCullCallback(callback.get());
    node.setCullingActive(false);
    ++_installed;

    const Scoped inside(_insideTile, true);
    traverseChildren(node);
}

void BinInstaller::treatOther(osg::Node& node) {
    switch (_options.method) {
        case Method::None:
            node.setCullingActive(false);
            break;
        case Method::Sphere:
            if (_insideTile) node.setCullingActive(true);
            break;
        default:
            if (_insideTile) node.setCullingActive(false);
    }
    traverseChildren(node);
}

void BinInstaller::traverseChildren(osg::Node& node) {
    if (!mustNotBeTraversed(node)) traverse(node);
}

AnalyticBin BinInstaller::boundsOfOwnGeometry(osg::PagedLOD& node) const {
    if (!_ellipsoid) return {};
    AnalyticBin bin;
    for (unsigned int i = 0; i < node.getNumChildren(); ++i) {
        const bool isPaged = i < node.getNumFileNames() && !node.getFileName(i).empty();
        if (!isPaged) bin.expandBy(terrainBounds(*node.getChild(i), *_ellipsoid, _localToEcef));
    }
    if (bin.valid()) bin.expandBy(AnalyticBin(bin.bin().withAltitude(kTerrainAltitudes)));
    return bin;
}

void BinInstaller::followPaging(osg::PagedLOD& node) {
    const osg::ref_ptr<osgDB::Options> own = dynamic_cast<osgDB::Options*>(node.getDatabaseOptions());
    osg::ref_ptr<osgDB::Options>& treated = _pagingOptions[own];
    if (!treated) {
        const osgDB::Options* base = own ? own.get() : osgDB::Registry::instance()->getOptions();
        treated = base ? base->cloneOptions() : new osgDB::Options;
        treated->setReadFileCallback(
            new BinReadFileCallback(_options, _ellipsoid.get(), _localToEcef, previousCallback(*treated)));
    }
    node.setDatabaseOptions(treated.get());
}

std::size_t installBins(osg::Node& node, const CullOptions& options) {
    BinInstaller installer(options);
    node.accept(installer);
    OSG_INFO << "osgAnalyticBin: " << installer.installed() << " tiles with " << toText(options) << std::endl;
    return installer.installed();
}

}  // namespace osgAnalyticBin
