// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FamilyTile.h"

#include "../Classes.h"
#include "../Spheres.h"
#include "../tile/Carrier.h"
#include "CullScopes.h"

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osgTerrain/GeometryTechnique>
#include <osgTerrain/TerrainTile>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace osgAnalyticBin {

namespace {

// What OSG keeps for derived classes.
struct OpenTechnique : public osgTerrain::GeometryTechnique {
    using osgTerrain::GeometryTechnique::BufferData;
    // Returns: nullptr for other techniques, and where none is made yet.
    [[nodiscard]] static const BufferData* meshOf(const osgTerrain::TerrainTile& tile) {
        const osgTerrain::TerrainTechnique* const technique = tile.getTerrainTechnique();
        const bool isOsgs = technique && isExactly<osgTerrain::GeometryTechnique>(*technique);
        if (!isOsgs || technique->getTerrainTile() != &tile) return nullptr;
        return (static_cast<const osgTerrain::GeometryTechnique*>(technique)->*(&OpenTechnique::_currentBufferData))
            .get();
    }
};
struct OpenVisitor : public osgUtil::CullVisitor {
    [[nodiscard]] static osg::RefMatrix* matrix(osgUtil::CullVisitor& visitor, const osg::Matrix& value) {
        return (visitor.*(&OpenVisitor::createOrReuseMatrix))(value);
    }
    // as osg::CullStack::pushModelViewMatrix() does it
    static void setCorners(osgUtil::CullVisitor& visitor, const osg::Matrix& matrix) {
        const osg::Vec3 look(osg::Vec3d(-matrix(0, 2), -matrix(1, 2), -matrix(2, 2)));
        const unsigned int farthest = (look.x() >= 0 ? 1u : 0u) | (look.y() >= 0 ? 2u : 0u) | (look.z() >= 0 ? 4u : 0u);
        visitor.*(&OpenVisitor::_bbCornerFar) = farthest;
        visitor.*(&OpenVisitor::_bbCornerNear) = ~farthest & 7u;
    }
};

// The product as osg::Matrixd::preMult() computes it, term by term, but in vectors.
osg::Matrixd product(const osg::Matrixd& first, const osg::Matrixd& second) {
    const double* const a = first.ptr();
    const double* const b = second.ptr();
    std::array<double, 16> sums;
    for (std::size_t row = 0; row < sums.size(); row += 4) {
        for (std::size_t column = 0; column < 4; ++column)
            sums[row + column] = a[row] * b[column] + a[row + 1] * b[4 + column] + a[row + 2] * b[8 + column] +
                                 a[row + 3] * b[12 + column];
    }
    return osg::Matrixd(sums.data());
}

class StateScope {
public:
    StateScope(osgUtil::CullVisitor& visitor, const osg::StateSet* state) : _visitor(visitor), _state(state) {
        if (_state) _visitor.pushStateSet(_state);
    }
    ~StateScope() {
        if (_state) _visitor.popStateSet();
    }
    StateScope(const StateScope&) = delete;
    StateScope& operator=(const StateScope&) = delete;

private:
    osgUtil::CullVisitor& _visitor;
    const osg::StateSet* const _state;
};

// OSG says nothing when this changes.
bool isRelative(const osg::Transform& transform) {
    return transform.getReferenceFrame() == osg::Transform::RELATIVE_RF;
}

// Whether a traversal goes through the node as if it had no cull callback.
bool isPassive(const osg::Node& node, const osg::NodeVisitor& visitor, const osg::CullSettings& settings) {
    const osg::Callback* const callback = node.getCullCallback();
    return visitor.validNodeMask(node) && (!callback || isIdle(*callback, settings));
}
bool isPassive(const osg::Node& node, const osgUtil::CullVisitor& visitor) {
    return isPassive(node, visitor, visitor);
}

// The mesh of an osgTerrain tile, which is drawn whole. Returns: nullptr where the tile has none yet, or another than
// osgTerrain::GeometryTechnique makes.
const OpenTechnique::BufferData* madeMesh(osgTerrain::TerrainTile& tile, const osgUtil::CullVisitor& visitor) {
    const auto* const mesh = hasBeenTraversed(tile) ? OpenTechnique::meshOf(tile) : nullptr;
    if (!mesh || !mesh->_transform || !mesh->_geode || !mesh->_geometry) return nullptr;
    const osg::MatrixTransform& transform = *mesh->_transform;
    const osg::Geode& geode = *mesh->_geode;
    const osg::Geometry& geometry = *mesh->_geometry;
    const bool isWhole = transform.getNumChildren() == 1 && transform.getChild(0) == &geode &&
                         geode.getNumChildren() == 1 && geode.getChild(0) == &geometry;
    const bool isPlain = isRelative(transform) && isExactly<osg::Geometry>(geometry) && isPassive(transform, visitor) &&
                         isPassive(geode, visitor) && isPassive(geometry, visitor);
    return isWhole && isPlain ? mesh : nullptr;
}

// Whether all of a box is outside of the plane, by more than rounding. `toPlane`: from the box's frame.
bool isOutside(const osg::BoundingBox& box, const osg::Plane& plane, const osg::Matrix* toPlane) {
    constexpr double kRounding = 1e-12;
    osg::Vec3d normal(plane[0], plane[1], plane[2]);
    double farthest = 0.0, size = 0.0;
    const auto add = [&](double part) {
        farthest += part;
        size += std::abs(part);
    };
    add(plane[3] * (toPlane ? (*toPlane)(3, 3) : 1.0));
    if (toPlane) {
        for (int i = 0; i < 3; ++i) add(normal[i] * toPlane->getTrans()[i]);
        normal = osg::Matrix::transform3x3(*toPlane, normal);
        for (int i = 0; i < 3; ++i) normal[i] += plane[3] * (*toPlane)(i, 3);
    }
    for (int i = 0; i < 3; ++i) add(normal[i] * (normal[i] >= 0.0 ? box._max[i] : box._min[i]));
    return farthest < -kRounding * size;
}

// Whether it is outside of one of the undecided planes. `frame`: the box's; null: the visitor's.
bool isBesideFrustum(osgUtil::CullVisitor& visitor, const osg::BoundingBox& box, const osg::Matrix* frame,
                     core::PlaneMask undecided) {
    if (undecided == 0 || !box.valid()) return false;
    const osg::Polytope::PlaneList& planes = visitor.getCurrentCullingSet().getFrustum().getPlaneList();
    for (std::size_t i = 0; undecided != 0 && i < planes.size(); ++i, undecided >>= 1) {
        if ((undecided & 1) != 0 && isOutside(box, planes[i], frame)) return true;
    }
    return false;
}

}  // namespace

bool isDrawnByGeometry(const osgTerrain::TerrainTile& tile) {
    return OpenTechnique::meshOf(tile) != nullptr;
}

// Delivers drawables in the frame of the visitor, or of one transform in it.
class FamilyTile::Delivery {
public:
    Delivery(osgUtil::CullVisitor& visitor, const BoundedMesh& bounded, core::PlaneMask undecided)
        : _visitor(visitor), _bounded(bounded), _undecided(undecided) {}

    // `mayBeSmall`: whether OSG's test for small features is made on the node.
    void draw(const std::array<Part, kMostParts>& parts, std::size_t number, bool mayBeSmall) {
        osg::Node& node = *parts[number].node;
        if (parts[number].kind == Kind::Geometry) return draw(static_cast<osg::Geometry&>(node));
        if (mayBeSmall && isDroppedAsSmall(node)) return;
        const StateScope state(_visitor, node.getStateSet());
        const bool isTransform = parts[number].kind == Kind::Transform;
        if (isTransform) enterFrame(static_cast<osg::MatrixTransform&>(node));
        for (std::size_t i = number + 1; i < parts.size() && parts[i].node; ++i) {
            // an only child is as large as its parent
            if (parts[i].above == number) draw(parts, i, parts[number].children > 1);
        }
        if (isTransform) leaveFrame();
    }

    // Returns: false where the tile has no mesh yet, or another than osgTerrain::GeometryTechnique makes.
    [[nodiscard]] bool draw(osgTerrain::TerrainTile& tile, bool mayBeSmall) {
        const auto* const mesh = madeMesh(tile, _visitor);
        if (!mesh) return false;
        osg::MatrixTransform& transform = *mesh->_transform;
        osg::Geode& geode = *mesh->_geode;
        osg::Geometry& geometry = *mesh->_geometry;
        _bounded.computeBoundOf(transform);
        if ((mayBeSmall && isDroppedAsSmall(tile)) || isDroppedAsSmall(transform)) return true;
        const StateScope ofTile(_visitor, tile.getStateSet()), ofTransform(_visitor, transform.getStateSet()),
            ofGeode(_visitor, geode.getStateSet());
        enterFrame(transform);
        draw(geometry);
        return true;
    }

private:
    [[nodiscard]] bool isDroppedAsSmall(const osg::Node& node) const {
        osg::CullingSet& cullingSet = _visitor.getCurrentCullingSet();
        if (!(cullingSet.getCullingMask() & osg::CullingSet::SMALL_FEATURE_CULLING) || !node.isCullingActive())
            return false;
        return isSmall(cullingSet, _frame ? movedSphere(node.getBound(), *_frame) : node.getBound());
    }

    void enterFrame(osg::MatrixTransform& transform) {
        _frame = &transform.getMatrix();
        _matrix = OpenVisitor::matrix(_visitor, product(*_frame, *_visitor.getModelViewMatrix()));
    }
    void leaveFrame() {
        _frame = nullptr;
        _matrix = _visitor.getModelViewMatrix();
    }

    // As osgUtil::CullVisitor::apply(osg::Drawable&).
    void draw(osg::Geometry& geometry) {
        const osg::BoundingBox& box = geometry.getBoundingBox();
        if (geometry.isCullingActive() && isBesideFrustum(_visitor, box, _frame, _undecided)) return;
        if (box.valid() && !countsForNearFar(geometry)) return;
        const float depth = box.valid() ? depthOf(box.center()) : 0.0f;
        if (std::isnan(depth)) return;
        const StateScope state(_visitor, geometry.getStateSet());
        _visitor.addDrawableAndDepth(&geometry, _matrix, depth);
    }

    // Returns: false where OSG leaves the drawable out because it is behind the eye.
    [[nodiscard]] bool countsForNearFar(osg::Geometry& geometry) {
        if (_visitor.getComputeNearFarMode() == osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR) return true;
        if (_frame) OpenVisitor::setCorners(_visitor, *_matrix);
        const bool counts = _visitor.updateCalculatedNearFar(*_matrix, geometry, false);
        if (_frame) OpenVisitor::setCorners(_visitor, *_visitor.getModelViewMatrix());
        return counts;
    }

    // As CullVisitor::getDistanceFromEyePoint().
    [[nodiscard]] float depthOf(const osg::Vec3& at) const {
        const osg::Matrix& m = *_matrix;
        return static_cast<float>(-(at[0] * m(0, 2) + at[1] * m(1, 2) + at[2] * m(2, 2) + m(3, 2)));
    }

    osgUtil::CullVisitor& _visitor;
    const BoundedMesh& _bounded;
    const core::PlaneMask _undecided;
    osg::RefMatrix* _matrix = _visitor.getModelViewMatrix();
    const osg::Matrix* _frame = nullptr;  // to the visitor's
};

void FamilyTile::BoundedMesh::computeBoundOf(const osg::Node& mesh) const {
    if (_mesh.load(std::memory_order_acquire) == &mesh) return;
    static std::mutex mutex;
    const std::lock_guard<std::mutex> lock(mutex);
    mesh.getBound();
    _mesh.store(&mesh, std::memory_order_release);
}

FamilyTile::Kind FamilyTile::kindOf(const osg::Node& node) {
    if (isExactly<osg::Group>(node) || isExactly<osg::Geode>(node) || isExactly<Carrier>(node)) return Kind::Group;
    if (isExactly<osg::MatrixTransform>(node)) return Kind::Transform;
    if (isExactly<osg::Geometry>(node)) return Kind::Geometry;
    return isExactly<osgTerrain::TerrainTile>(node) ? Kind::Terrain : Kind::Unknown;
}

// The mesh of a tile. Returns: nullptr where the tile has several or none.
osg::Node* FamilyTile::meshOf(osg::Node& tile, osg::PagedLOD* paged) {
    if (!paged) return &tile;
    const bool isSingle = paged->getNumChildren() > 0 && paged->getNumFileNames() > 0 && paged->getFileName(0).empty();
    for (unsigned int i = 1; i < paged->getNumFileNames(); ++i) {
        if (paged->getFileName(i).empty()) return nullptr;
    }
    return isSingle ? paged->getChild(0) : nullptr;
}

FamilyTile::FamilyTile(osg::Node& tile, const AnalyticBinCullCallback& callback)
    : _callback(&callback),
      _anyCallback(&callback),
      _paged(dynamic_cast<osg::PagedLOD*>(&tile)),
      _isPossible(isExactly<osg::PagedLOD>(tile) || kindOf(tile) == Kind::Group || kindOf(tile) == Kind::Terrain) {
    osg::Node* const mesh = meshOf(tile, _paged);
    if (!mesh || !append(*mesh)) {
        _parts = {};
        _count = 0;
        return;
    }
    _isOwnMesh = mesh == &tile;
    _isDrawn = canBeDrawn();
    _areClassesKnown = std::all_of(_parts.begin(), _parts.begin() + _count, [](const Part& part) {
        return part.kind != Kind::Unknown && part.kind != Kind::Terrain;
    });
}

// Adds a node of the mesh. Returns: whether OSG draws all of it as long as it enters each of the parts, and there is
// room for all.
bool FamilyTile::append(osg::Node& node) {
    if (_count == kMostParts) return false;
    _parts[_count].node = &node;
    _parts[_count++].kind = kindOf(node);
    if (dynamic_cast<const osgTerrain::TerrainTile*>(&node)) return typeid(node) == typeid(osgTerrain::TerrainTile);
    // a group without children draws nothing
    osg::Group* const group = node.asGroup();
    bool areKnown = drawsAllChildren(node) && (!group || group->getNumChildren() > 0);
    for (unsigned int i = 0; areKnown && group && i < group->getNumChildren(); ++i) {
        areKnown = append(*group->getChild(i));
    }
    return areKnown;
}

bool FamilyTile::canBeDrawn() {
    int transforms = 0;
    for (std::size_t i = 0; part(i); ++i) {
        Part& part = _parts[i];
        for (std::size_t above = 0; above < i; ++above) {
            // one that hangs below two others is drawn in two places
            if (_parts[above].node == part.node) return false;
            const osg::Group* const group = _parts[above].node->asGroup();
            if (!group || !group->containsNode(part.node)) continue;
            part.above = static_cast<unsigned char>(above);
            part.place = static_cast<unsigned char>(group->getChildIndex(part.node));
        }
        transforms += part.kind == Kind::Transform ? 1 : 0;
        const bool isTerrainBelow = part.kind == Kind::Terrain && i > 0;
        if (part.kind == Kind::Unknown || isTerrainBelow || transforms > 1) return false;
        if (part.kind == Kind::Geometry) part.node->getBound();  // now, not in several cull threads at once
        if (part.kind == Kind::Group || part.kind == Kind::Transform)
            part.children = static_cast<unsigned char>(part.node->asGroup()->getNumChildren());
        const osg::Transform* const transform = part.node->asTransform();
        if (transform && !isRelative(*transform)) return false;
    }
    return true;
}

bool FamilyTile::isAlone(const osg::Node& tile, const osg::CullSettings& settings) const {
    if (!isFirst(tile)) return false;
    const osg::Callback* const nested = _anyCallback->getNestedCallback();
    return !nested || isIdle(*nested, settings);
}

bool FamilyTile::isDrawnWhole(const osg::NodeVisitor& visitor, const osg::CullSettings& settings,
                              const StateRules& rules) const {
    if (!_areClassesKnown || !isMeshAsKnown(visitor, settings)) return false;
    for (std::size_t i = 0; i < _count; ++i) {
        const osg::Node& node = *_parts[i].node;
        if (mayChange(node) || !drawnStateOf(node, rules).hides) return false;
        if (_parts[i].kind != Kind::Geometry) continue;
        const auto& drawable = static_cast<const osg::Drawable&>(node);
        if (drawable.getDrawCallback() || drawable.getComputeBoundingBoxCallback()) return false;
    }
    return true;
}

// The other modes of near and far planes keep the frustum in the mesh's frame.
bool FamilyTile::canDraw(osgUtil::CullVisitor& visitor) {
    const auto mode = visitor.getComputeNearFarMode();
    return (mode == osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR ||
            mode == osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES) &&
           visitor.getCurrentCullingSet().getStateFrustumList().empty() &&
           visitor.getProjectionCullingStack().back().getStateFrustumList().empty();
}

bool FamilyTile::draw(osgUtil::CullVisitor& visitor, core::PlaneMask undecided) const {
    if (!_isDrawn || !isMeshAsKnown(visitor, visitor)) return false;
    Delivery delivery(visitor, _bounded, undecided);
    if (_parts.front().kind == Kind::Terrain)
        return delivery.draw(static_cast<osgTerrain::TerrainTile&>(*_parts.front().node), !_isOwnMesh);
    delivery.draw(_parts, 0, !_isOwnMesh);
    return true;
}

std::optional<FamilyTile::Depths> FamilyTile::farthest(osgUtil::CullVisitor& visitor, core::PlaneMask undecided) const {
    if (!_isDrawn || !isMeshAsKnown(visitor, visitor)) return std::nullopt;
    const osg::Matrixd& modelView = *visitor.getModelViewMatrix();
    constexpr double kNowhere = -std::numeric_limits<double>::infinity();
    Depths farthest{kNowhere, kNowhere};
    const auto add = [&](const osg::Drawable& drawable, const osg::MatrixTransform* transform) {
        const osg::BoundingBox& box = drawable.getBoundingBox();
        if (!box.valid()) return;
        const osg::Matrixd* const frame = transform ? &transform->getMatrix() : nullptr;
        const double depth = farthestDepth(box, frame ? *frame * modelView : modelView);
        farthest.all = std::max(farthest.all, depth);
        if (!isBesideFrustum(visitor, box, frame, undecided)) farthest.drawn = std::max(farthest.drawn, depth);
    };
    if (_parts.front().kind == Kind::Terrain) {
        const auto* const mesh = madeMesh(static_cast<osgTerrain::TerrainTile&>(*_parts.front().node), visitor);
        if (!mesh) return std::nullopt;
        _bounded.computeBoundOf(*mesh->_transform);
        add(*mesh->_geometry, mesh->_transform.get());
        return farthest;
    }
    for (std::size_t i = 0; part(i); ++i) {
        if (_parts[i].kind != Kind::Geometry) continue;
        const osg::MatrixTransform* transform = nullptr;
        for (std::size_t at = i; at > 0 && !transform;) {
            at = _parts[at].above;
            if (_parts[at].kind == Kind::Transform) transform = static_cast<osg::MatrixTransform*>(part(at));
        }
        add(static_cast<const osg::Drawable&>(*part(i)), transform);
    }
    return farthest;
}

bool FamilyTile::isEnteredUntested(const osgUtil::CullVisitor& visitor) const {
    return _isOwnMesh || (_parts.front().kind == Kind::Terrain && isPassive(*_parts.front().node, visitor));
}

bool FamilyTile::isMeshAlone(const osg::Node& tile, const osgUtil::CullVisitor& visitor) const {
    return _paged && _isPossible && _areClassesKnown && isAlone(tile, visitor) && _paged->getNumChildren() == 1 &&
           isMesh(*_paged->getChild(0)) && isMeshAsKnown(visitor, visitor);
}

void FamilyTile::noteMesh(Footprint::Notes& notes) const {
    for (std::size_t i = 0; i < _count; ++i) {
        const osg::Node& node = *_parts[i].node;
        notes.add(&node, sizeof(osg::MatrixTransform));
        if (_parts[i].kind == Kind::Group || _parts[i].kind == Kind::Transform)
            notes.addChildren(static_cast<const osg::Group&>(node));
    }
}

bool FamilyTile::isMeshAsKnown(const osg::NodeVisitor& visitor, const osg::CullSettings& settings) const {
    for (std::size_t i = 0; i < _count; ++i) {
        const Part& known = _parts[i];
        const bool isTile = i == 0 && _isOwnMesh;
        if (!isTile && !isPassive(*known.node, visitor, settings)) return false;
        if (known.kind == Kind::Transform && !isRelative(static_cast<const osg::Transform&>(*known.node))) return false;
        if (i == 0) continue;
        // each group among the parts is above one
        const Part& above = _parts[known.above];
        const osg::Group& group = static_cast<const osg::Group&>(*above.node);
        if (group.getNumChildren() != above.children || group.getChild(known.place) != known.node) return false;
    }
    return true;
}

}  // namespace osgAnalyticBin
