// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// A database of hostile files, written and read by OSG, with bins installed as for the pager, and views of it: whatever
// its files hold, it is read, paged, updated and culled. That nothing is culled that is seen: tests/long/scenes.

#include "Fuzz.h"
#include "TileScene.h"

#include <osgAnalyticBin/InstallBins.h>

#include <osg/Geometry>
#include <osg/Notify>
#include <osg/PagedLOD>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgTerrain/TerrainTile>
#include <osgUtil/UpdateVisitor>

#include <kit/CullFixture.h>
#include <support/WrittenAndRead.h>

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
    static const osg::ref_ptr<FilesInMemory> files = new FilesInMemory;
    osgDB::Registry::instance()->setReadFileCallback(files);
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

/// Loads what PagedLODs name, as far as there is patience, the way the pager does.
void page(osg::Node& scene) {
    NodeCollector collector;
    scene.accept(collector);
    int loads = 0;
    for (std::size_t i = 0; i < collector.nodes.size() && loads < kMostLoads; ++i) {
        auto* paged = dynamic_cast<osg::PagedLOD*>(collector.nodes[i]);
        if (!paged || paged->getNumChildren() == 0 || paged->getNumFileNames() != paged->getNumChildren() + 1) continue;
        ++loads;
        const osg::ref_ptr<osg::Node> content = osgDB::readRefNodeFile(
            paged->getFileName(paged->getNumChildren()), dynamic_cast<osgDB::Options*>(paged->getDatabaseOptions()));
        if (!content) continue;
        paged->addChild(content);
        content->accept(collector);
    }
}

CullOptions makeOptions(Bytes& bytes) {
    constexpr std::array<Method, 3> kMethods{Method::Quadratic, Method::Exact, Method::None};
    CullOptions options;
    options.method = bytes.pick(kMethods);
    return options;
}

/// Views of what is there, from near and far.
void look(Bytes& bytes, osg::Node& scene) {
    const osg::BoundingSphere bound = scene.getBound();
    const osg::Vec3d target = bound.valid() ? osg::Vec3d(bound.center()) : osg::Vec3d();
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    for (unsigned int frame = 3; frame < 7; ++frame) {
        // in braces, for these are taken in order, whatever the compiler
        const osg::Vec3d aside{bytes.between(-1.0, 1.0), bytes.between(-1.0, 1.0), bytes.between(-1.0, 1.0)};
        const osg::Vec3d eye = target * bytes.between(1.0, 2.0) + aside * std::pow(10.0, bytes.between(2.0, 7.0));
        (void)cull(scene, CullView::lookAt(eye, target, osg::Vec3d(0.1, 0.2, 1.0), bytes.between(0.5, 60.0)), *visitor,
                   frame);
    }
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
    const osg::ref_ptr<osg::Node> scene = writtenAndRead(*made, asText);
    if (!scene) return 0;
    (void)installBins(*scene, options);
    page(*scene);
    // OSG draws such meshes itself, and reads what is not there
    if (traits.hasWildIndices || traits.hasTerrainTiles) return 0;
    for (unsigned int frame = 1; frame < 3; ++frame) {
        const osg::ref_ptr<osgUtil::UpdateVisitor> update = new osgUtil::UpdateVisitor;
        update->setTraversalNumber(frame);
        scene->accept(*update);
    }
    look(bytes, *scene);
    return 0;
}
