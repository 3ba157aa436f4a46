// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// A database of hostile files, written and read by OSG, with bins installed as for the pager: what is loaded and seen
// is not culled, whatever its bins say.

#include "Fuzz.h"
#include "TileScene.h"

#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/TileFinder.h>
#include <osgAnalyticBin/TileSurface.h>

#include <osg/Geometry>
#include <osg/Notify>
#include <osg/ValueObject>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgTerrain/TerrainTile>
#include <osgUtil/UpdateVisitor>

#include <cstdio>
#include <kit/CullFixture.h>

using namespace osgAnalyticBin;
using namespace osgAnalyticBin::test;

namespace {

constexpr std::size_t kFiles = 4;
constexpr int kMostLoads = 8;
constexpr std::size_t kMostBytes = 2048;

/// The files of the present input, instead of those of a folder.
class FilesInMemory : public osgDB::ReadFileCallback {
public:
    osgDB::ReaderWriter::ReadResult readNode(const std::string& name, const osgDB::Options*) override {
        const std::size_t number = name.empty() ? kFiles : static_cast<std::size_t>(name.front() - '0');
        if (number >= kFiles || !files[number]) return osgDB::ReaderWriter::ReadResult::FILE_NOT_FOUND;
        const osg::ref_ptr<osg::Node> copy = writtenAndRead(*files[number], false);
        if (!copy) return osgDB::ReaderWriter::ReadResult::ERROR_IN_READING_FILE;
        return copy.get();
    }
    std::array<osg::ref_ptr<osg::Node>, kFiles> files;
};

FilesInMemory& filesInMemory() {
    static const osg::ref_ptr<FilesInMemory> files = [] {
        const osg::ref_ptr<FilesInMemory> made = new FilesInMemory;
        osgDB::Registry::instance()->setReadFileCallback(made);
        return made;
    }();
    return *files;
}

class NodeCollector : public osg::NodeVisitor {
public:
    NodeCollector() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0u); }
    void apply(osg::Node& node) override {
        nodes.push_back(&node);
        if (!dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
    }
    std::vector<osg::Node*> nodes;
};

std::vector<osg::Node*> nodesOf(osg::Node& scene) {
    NodeCollector collector;
    scene.accept(collector);
    return collector.nodes;
}

/// Loads what PagedLODs name, as far as there is patience, the way the pager does.
void page(osg::Node& scene) {
    std::vector<osg::Node*> nodes = nodesOf(scene);
    int loads = 0;
    for (std::size_t i = 0; i < nodes.size() && loads < kMostLoads; ++i) {
        auto* paged = dynamic_cast<osg::PagedLOD*>(nodes[i]);
        if (!paged || paged->getNumChildren() == 0 || paged->getNumFileNames() != paged->getNumChildren() + 1) continue;
        ++loads;
        const osg::ref_ptr<osg::Node> content = osgDB::readRefNodeFile(
            paged->getFileName(paged->getNumChildren()), dynamic_cast<osgDB::Options*>(paged->getDatabaseOptions()));
        if (!content) continue;
        paged->addChild(content);
        for (osg::Node* node : nodesOf(*content)) nodes.push_back(node);
    }
}

/// The vertices that are drawn, in the frame of the scene; none where one is not finite.
std::vector<osg::Vec3d> drawnVertices(osg::Geometry& geometry) {
    std::vector<osg::Vec3d> result;
    const osg::NodePathList paths = geometry.getParentalNodePaths();
    if (paths.size() != 1 || !geometry.getVertexArray()) return result;
    const osg::Matrixd matrix = osg::computeLocalToWorld(paths.front());
    const auto* floats = dynamic_cast<const osg::Vec3Array*>(geometry.getVertexArray());
    const auto* doubles = dynamic_cast<const osg::Vec3dArray*>(geometry.getVertexArray());
    for (const auto& primitives : geometry.getPrimitiveSetList()) {
        for (unsigned int i = 0; i < primitives->getNumIndices(); ++i) {
            const unsigned int index = primitives->index(i);
            const osg::Vec3d local = floats ? osg::Vec3d((*floats)[index]) : (*doubles)[index];
            const osg::Vec3d point = local * matrix;
            if (!(point.length() < 1e30)) return {};
            result.push_back(point);
        }
    }
    return result;
}

/// That which culls a node, be it behind others.
AnalyticBinCullCallback* binOf(osg::Node& node) {
    for (osg::Callback* callback = node.getCullCallback(); callback; callback = callback->getNestedCallback()) {
        if (auto* found = dynamic_cast<AnalyticBinCullCallback*>(callback)) return found;
    }
    return nullptr;
}

struct Scene {
    osg::ref_ptr<osg::Node> root;
    std::map<const osg::Node*, std::string> names;
    std::set<std::string> reached;
    std::map<const osg::Node*, FoundTile> tiles;
};

/// From here on only bins cull, and it is noted which of them do not.
void watch(Scene& scene) {
    for (osg::Node* node : nodesOf(*scene.root)) {
        if (AnalyticBinCullCallback* callback = binOf(*node)) {
            const std::string& name = scene.names[node] = std::to_string(scene.names.size());
            callback->setNestedCallback(new VisitRecorder(name, scene.reached));
        }
        node->setCullingActive(false);
    }
    for (const FoundTile& tile : findTiles(*scene.root)) scene.tiles[tile.node.get()] = tile;
}

TileSurface surfaceOf(osg::Node& mesh, const FoundTile& tile) {
    const osg::ref_ptr<const osg::EllipsoidModel> wgs84 = new osg::EllipsoidModel;
    return tileSurface(mesh, tile.frame.ellipsoid ? *tile.frame.ellipsoid : *wgs84, tile.frame.localToEcef);
}

bool isSurfaceKnown(const FoundTile& tile) {
    return std::all_of(tile.meshes.begin(), tile.meshes.end(), [&](const osg::ref_ptr<osg::Node>& mesh) {
        const TileSurface surface = surfaceOf(*mesh, tile);
        return surface.isEmpty || surface.bin.valid();
    });
}

/// The tile's own mesh that a path goes through; null: none.
osg::Node* ownMesh(const FoundTile& tile, const osg::NodePath& path) {
    const auto mesh = std::find_first_of(path.begin(), path.end(), tile.meshes.begin(), tile.meshes.end());
    return mesh == path.end() ? nullptr : *mesh;
}

/// What moves by itself is culled with the tile that it is in, wherever it is.
bool mayMove(osg::Node& node) {
    const osg::Transform* transform = node.asTransform();
    const bool isStatic = node.getDataVariance() != osg::Object::DYNAMIC && !node.getUpdateCallback();
    return transform && (!isStatic || transform->getReferenceFrame() != osg::Transform::RELATIVE_RF);
}

/// By how far terrain may leave bins that hide it, in metres; negative: bins say more about it than the kit can check.
double tolerance(const Scene& scene, const osg::NodePath& path, const std::vector<osg::Vec3d>& vertices) {
    constexpr double kRounding = 0.1;
    std::size_t culprit = 0;
    while (culprit < path.size() && (!binOf(*path[culprit]) || scene.reached.count(scene.names.at(path[culprit])) > 0))
        ++culprit;
    require(culprit < path.size());
    bool isStored = false, isStoredAbove = false;
    std::size_t innermost = path.size();
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (hasStoredBin(*path[i])) (i <= culprit ? isStoredAbove : isStored) = true;
        if (scene.tiles.count(path[i]) > 0) innermost = i;
    }
    if (innermost == path.size()) return -1.0;
    const FoundTile& tile = scene.tiles.at(path[innermost]);
    osg::Node* const mesh = ownMesh(tile, path);
    // ignore meshes whose primitives all have too few vertices
    if (mesh && surfaceOf(*mesh, tile).isEmpty) return -1.0;
    // what cannot be told keeps the stored bins above it open
    if (!isSurfaceKnown(tile)) return hasStoredBin(*path[culprit]) && mesh ? kRounding : -1.0;
    if (std::any_of(path.begin() + static_cast<std::ptrdiff_t>(innermost) + 1, path.end(),
                    [](osg::Node* node) { return mayMove(*node); }))
        return -1.0;
    isStored = isStored || isStoredAbove;
    // bins of tiles that have none stored hold what is within their extents, whatever is stored above them
    if (!isStored || !hasStoredBin(*path[culprit])) return innermost <= culprit && mesh ? kRounding : -1.0;
    if (!isStoredAbove) return -1.0;
    double extent = 0.0;
    for (const osg::Vec3d& vertex : vertices) extent = std::max(extent, (vertex - vertices.front()).length());
    return 100.0 + 0.25 * extent;
}

bool isWithin(const osg::Vec3d& point, const std::vector<osg::Plane>& planes, double radius) {
    return std::all_of(planes.begin(), planes.end(), [&](const osg::Plane& p) { return p.distance(point) > radius; });
}

/// What was culled wrongly, for whoever mends it.
void describe(const osg::Vec3d& vertex, const Scene& scene, const osg::NodePath& path) {
    std::fprintf(stderr, "culled, though seen: %.17g %.17g %.17g\n", vertex.x(), vertex.y(), vertex.z());
    for (osg::Node* node : path) {
        const AnalyticBinCullCallback* bin = binOf(*node);
        std::string stored;
        (void)node->getUserValue("osgAnalyticBin", stored);
        const char* const verdict = !bin ? "" : scene.reached.count(scene.names.at(node)) > 0 ? ", kept" : ", culled";
        std::fprintf(stderr, "%s%s, stored [%s]%s, bin [%s]\n", node->className(),
                     scene.tiles.count(node) > 0 ? ", tile" : "", stored.c_str(), verdict,
                     bin ? bin->getBinText().c_str() : "");
    }
}

void requireKept(Scene& scene, const CullView& view) {
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    CullView open = view;
    open.cullingMode = osg::CullSettings::NO_CULLING;
    const CullResult all = cull(*scene.root, open, *visitor, 3);
    scene.reached.clear();
    const CullResult kept = cull(*scene.root, view, *visitor, 4);
    const std::vector<osg::Plane> planes = view.sidePlanes();
    for (const osg::Drawable* drawable : all.drawn) {
        if (kept.drawn.count(drawable) > 0 || !drawable->asGeometry()) continue;
        auto& geometry = const_cast<osg::Geometry&>(*drawable->asGeometry());
        const std::vector<osg::Vec3d> vertices = drawnVertices(geometry);
        if (vertices.empty()) continue;
        const osg::NodePath path = geometry.getParentalNodePaths().front();
        const double allowed = tolerance(scene, path, vertices);
        if (allowed < 0.0) continue;
        for (const osg::Vec3d& vertex : vertices) {
            if (!isWithin(vertex, planes, allowed)) continue;
            describe(vertex, scene, path);
            require(false);
        }
    }
}

/// Views of terrain that is there, from near and far.
void look(Bytes& bytes, Scene& scene) {
    std::vector<osg::Vec3d> targets;
    for (osg::Node* node : nodesOf(*scene.root)) {
        if (!node->asGeometry()) continue;
        const std::vector<osg::Vec3d> vertices = drawnVertices(*node->asGeometry());
        if (!vertices.empty()) targets.push_back(vertices[bytes.byte() % vertices.size()]);
    }
    if (targets.empty()) targets.emplace_back(6378137.0, 0.0, 0.0);
    for (int i = 0; i < 4; ++i) {
        const osg::Vec3d target = targets[bytes.byte() % targets.size()];
        // in braces, for these are taken in order, whatever the compiler
        const osg::Vec3d aside{bytes.between(-1.0, 1.0), bytes.between(-1.0, 1.0), bytes.between(-1.0, 1.0)};
        const double lift = bytes.between(1.0, 2.0);
        const osg::Vec3d eye = target * lift + aside * std::pow(10.0, bytes.between(2.0, 7.0));
        requireKept(scene, CullView::lookAt(eye, target, osg::Vec3d(0.1, 0.2, 1.0), bytes.between(0.5, 60.0)));
    }
}

CullOptions makeOptions(Bytes& bytes) {
    constexpr std::array<Method, 3> kMethods{Method::Quadratic, Method::Exact, Method::None};
    CullOptions options;
    options.method = bytes.pick(kMethods);
    options.horizonUse = HorizonUse::Off;
    return options;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2 || size > kMostBytes) return 0;
    osg::setNotifyLevel(osg::ALWAYS);
    FilesInMemory& memory = filesInMemory();
    Bytes bytes(data, size);
    const CullOptions options = makeOptions(bytes);
    const int spare = bytes.byte();
    const ScenePlace place{-90.0 + 30 * (spare % 5), -60.0 + 30 * (spare % 5), -170.0 + spare, -140.0 + spare, 0.0};
    const osg::ref_ptr<osg::Node> made = makeFile(bytes, place, true);
    SceneTraits traits = traitsOf(*made);
    for (osg::ref_ptr<osg::Node>& file : memory.files) {
        file = bytes.empty() ? nullptr : makeFile(bytes, place, false);
        const SceneTraits own = file ? traitsOf(*file) : SceneTraits();
        traits.hasWildIndices = traits.hasWildIndices || own.hasWildIndices;
        traits.hasTerrainTiles = traits.hasTerrainTiles || own.hasTerrainTiles;
    }
    // OSG's text reader does not end at a "nan"
    const bool asText = !traits.hasOddNumbers && spare % 4 == 0;
    Scene scene;
    scene.root = writtenAndRead(*made, asText);
    if (!scene.root) return 0;
    (void)installBins(*scene.root, options);
    page(*scene.root);
    // OSG draws such meshes itself, and reads what is not there
    if (traits.hasWildIndices || traits.hasTerrainTiles) return 0;
    for (unsigned int frame = 1; frame < 3; ++frame) {
        const osg::ref_ptr<osgUtil::UpdateVisitor> update = new osgUtil::UpdateVisitor;
        update->setTraversalNumber(frame);
        scene.root->accept(*update);
    }
    watch(scene);
    look(bytes, scene);
    return 0;
}
