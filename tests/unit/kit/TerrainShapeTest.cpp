// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What osgTerrain::Terrain says about its tiles: vertical scale, equalised boundaries, another technique; set before
// bins are installed, and changed while the database is shown. Oracle: the triangles that osgTerrain draws.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

osg::ref_ptr<osgTerrain::TerrainTile> makeHilly(const core::GeodeticBin& extents, Random& random) {
    const double high = random.uniform(0.0, 8000.0);
    return makeTerrainTile(
        extents, 9, 9, [&](unsigned int, unsigned int) { return static_cast<float>(random.uniform(-3000.0, high)); });
}

// The names of tiles that a cull traversal reaches, noted by callbacks on nodes before bins are installed.
class ReachedTiles {
public:
    void watch(osg::Node& node, const std::string& name) {
        const osg::ref_ptr<VisitRecorder> recorder = new VisitRecorder(name, _names);
        setTraversesAlways(*recorder);
        node.setCullCallback(recorder);
    }
    const std::set<std::string>& in(osg::Node& scene, const osg::Vec3d& eye, const osg::Vec3d& center, double fovDeg) {
        _names.clear();
        osg::Vec3d up = eye ^ center;
        if (up.length2() == 0.0) up.set(0, 0, 1);
        (void)cull(scene, CullView::lookAt(eye, center, up, fovDeg));
        return _names;
    }

private:
    std::set<std::string> _names;
};

// A terrain of 6 x 6 tiles, half a degree wide, that are drawn by osgTerrain itself.
struct Hills {
    Hills() {
        Random random(50);
        for (int row = 0; row < 6; ++row) {
            for (int column = 0; column < 6; ++column) {
                const double south = 40.0 + 0.5 * row, west = 10.0 + 0.5 * column;
                const auto tile = makeHilly(extentsDeg(south, south + 0.5, west, west + 0.5), random);
                tile->setTileID(osgTerrain::TileID(5, column, row));
                tiles.push_back(tile);
                terrain->addChild(tile);
            }
        }
    }

    void watch() {
        for (std::size_t i = 0; i < tiles.size(); ++i) reached.watch(*tiles[i], std::to_string(i));
    }

    void update() {
        const osg::ref_ptr<osgUtil::UpdateVisitor> visitor = new osgUtil::UpdateVisitor;
        visitor->setTraversalNumber(++frame);
        terrain->accept(*visitor);
        // OSG makes the mesh of a tile when the tile is culled for the first time, or in the next update
        (void)reached.in(*terrain, ecefDeg(45, 15, 2e7), {0, 0, 0}, 90.0);
    }

    [[nodiscard]] AnalyticBinCullCallback& bin(std::size_t i) const { return *installedOn(*tiles[i]); }

    std::vector<osg::ref_ptr<osgTerrain::TerrainTile>> tiles;
    ReachedTiles reached;
    unsigned int frame = 0;
    osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
};

// What the tile draws at present.
std::vector<glm::dvec3> drawnSamples(osgTerrain::TerrainTile& tile) {
    const auto* technique = dynamic_cast<osgTerrain::GeometryTechnique*>(tile.getTerrainTechnique());
    return technique ? samplesOf(drawnTriangles(tile).surface, 3) : std::vector<glm::dvec3>();
}

void expectHeld(const Hills& hills) {
    for (std::size_t i = 0; i < hills.tiles.size(); ++i) {
        const auto samples = drawnSamples(*hills.tiles[i]);
        ASSERT_FALSE(samples.empty());
        const AnalyticBin bin = culledBin(hills.bin(i));
        EXPECT_LE(metresOutside(bin, samples, earth()), bin.margin()) << i;
    }
}

// Narrow views at points of what is drawn: the tile must be reached. The first of each tile is at the point that is
// farthest from the middle of OSG's sphere, past the sphere if the point is not in it.
// Returns: the tiles that were not reached, over all views.
std::set<std::size_t> tilesMissed(Hills& hills) {
    Random random(51);
    std::set<std::size_t> missed;
    for (std::size_t i = 0; i < hills.tiles.size(); ++i) {
        const auto samples = drawnSamples(*hills.tiles[i]);
        const osg::Vec3d middle = hills.tiles[i]->getBound().center();
        const glm::dvec3& farthest =
            *std::max_element(samples.begin(), samples.end(), [&](const glm::dvec3& a, const glm::dvec3& b) {
                return (osgVector(a) - middle).length2() < (osgVector(b) - middle).length2();
            });
        for (int k = 0; k < 12; ++k) {
            const int last = static_cast<int>(samples.size()) - 1;
            const osg::Vec3d at =
                osgVector(k == 0 ? farthest : samples[static_cast<std::size_t>(random.integer(0, last))]);
            osg::Vec3d towardsEye = osgVector(random.direction());
            if (k == 0) towardsEye = towardsEye ^ (at - middle);
            towardsEye.normalize();
            const auto& names = hills.reached.in(*hills.terrain, at + towardsEye * 3e5, at, 0.1);
            if (!names.count(std::to_string(i))) missed.insert(i);
        }
    }
    return missed;
}

// An osg::LOD measures distances from there.
TEST(VerticalScale, LeavesTheMiddlesOfSpheresWhereOsgHasThem) {
    Hills spheres, bins;
    for (Hills* const hills : {&spheres, &bins}) hills->terrain->setVerticalScale(10.0f);
    installBins(*bins.terrain);
    for (Hills* const hills : {&spheres, &bins}) hills->update();
    bool isGrown = false;
    for (std::size_t i = 0; i < bins.tiles.size(); ++i) {
        const osg::BoundingSphere theirs = spheres.tiles[i]->getBound(), ours = bins.tiles[i]->getBound();
        EXPECT_EQ(ours.center(), theirs.center()) << i;
        EXPECT_GE(ours.radius(), theirs.radius()) << i;
        isGrown = isGrown || ours.radius() > theirs.radius();
    }
    EXPECT_TRUE(isGrown);
}

TEST(VerticalScale, IsFollowedAtRunTime) {
    Hills hills;
    hills.terrain->setVerticalScale(10.0f);
    hills.watch();
    hills.update();
    EXPECT_FALSE(tilesMissed(hills).empty()) << "by OSG's spheres";
    installBins(*hills.terrain);
    hills.update();
    expectHeld(hills);
    for (const float scale : {4.0f, 0.0f, -2.0f, 1.0f}) {
        hills.terrain->setVerticalScale(scale);
        // noticed in one frame, fitted in the next
        for (int i = 0; i < 2; ++i) {
            hills.update();
            EXPECT_TRUE(tilesMissed(hills).empty()) << scale;
        }
        expectHeld(hills);
        EXPECT_EQ(hills.bin(0).getTerrainShape()->verticalScale, static_cast<double>(scale));
    }
}

TEST(VerticalScale, ATileOfAnotherShapeIsCulledByItsSphereAloneUntilItIsFitted) {
    Hills hills;
    hills.watch();
    installBins(*hills.terrain);
    hills.update();
    // beside the tiles, over the spheres about some of them
    const osg::Vec3d eye = ecefDeg(41.5, 9.85, 2e4), below = ecefDeg(41.5, 9.85, -1e4);
    const auto reached = [&] { return hills.reached.in(*hills.terrain, eye, below, 10.0); };
    ASSERT_TRUE(reached().empty());
    // changed after the update traversal: tiles are as they were, and may be drawn anew at any time
    hills.terrain->setVerticalScale(5.0f);
    EXPECT_FALSE(reached().empty());
    hills.update();
    EXPECT_TRUE(reached().empty());

    // a tile that the pager fitted before, and merged after that
    hills.bin(18).setTerrainShape(TerrainShape());
    EXPECT_EQ(reached(), std::set<std::string>{"18"});
    hills.update();
    EXPECT_TRUE(reached().empty());
    EXPECT_EQ(hills.bin(18).getTerrainShape()->verticalScale, 5.0);
}

// Also while OSG's sphere is out of view, which does not know of the scale.
TEST(VerticalScale, CountsForATileThatWasOnItsWayWhenItChanged) {
    Hills hills;
    installBins(*hills.terrain);
    hills.update();
    Random random(52);
    const auto tile = makeHilly(extentsDeg(43.0, 43.5, 10.0, 10.5), random);
    EXPECT_EQ(addTile(*hills.terrain, *tile), 1u);
    hills.terrain->setVerticalScale(5.0f);
    for (int i = 0; i < 2; ++i) hills.update();
    EXPECT_EQ(hills.bin(0).getTerrainShape()->verticalScale, 5.0);
    hills.terrain->addChild(tile);
    const osg::Vec3d eye = ecefDeg(40.25, 10.25, 3e5), below = ecefDeg(40.25, 10.25, 0);
    for (int i = 0; i < 2; ++i) {
        (void)hills.reached.in(*hills.terrain, eye, below, 1.0);
        osgUtil::UpdateVisitor visitor;
        hills.terrain->accept(visitor);
    }
    EXPECT_EQ(installedOn(*tile)->getTerrainShape()->verticalScale, 5.0);
}

// Their scale, sample ratio, blending and technique are those of the Terrain that the application has set.
TEST(OtherTerrain, ItsTilesHaveNoBins) {
    Hills hills;
    const osg::ref_ptr<osgTerrain::Terrain> other = new osgTerrain::Terrain;
    hills.tiles[0]->setTerrain(other);
    hills.tiles[1]->setTerrain(hills.terrain);
    installBins(*hills.terrain);
    EXPECT_FALSE(installedOn(*hills.tiles[0]));
    EXPECT_TRUE(installedOn(*hills.tiles[1]));
    EXPECT_TRUE(installedOn(*hills.tiles[2]));
    hills.tiles[0]->setTerrain(hills.terrain);
    installBins(*hills.terrain);
    EXPECT_TRUE(installedOn(*hills.tiles[0]));
}

TEST(OtherTerrain, AboveADatabaseLeavesItToOsg) {
    std::set<std::size_t> missed[2];
    for (const bool hasBins : {false, true}) {
        Hills hills;
        const auto globe = makeGlobe();
        for (const auto& tile : hills.tiles) globe->addChild(tile);
        hills.terrain->removeChildren(0, hills.terrain->getNumChildren());
        hills.terrain->addChild(globe);
        hills.terrain->setVerticalScale(10.0f);
        hills.watch();
        if (hasBins) installBins(*globe);
        hills.update();
        missed[hasBins ? 1 : 0] = tilesMissed(hills);
    }
    EXPECT_EQ(missed[0], missed[1]);
}

TEST(EqualBoundaries, BinsHoldTheHeightsOfNeighbours) {
    Hills before;
    before.terrain->setEqualizeBoundaries(true);
    installBins(*before.terrain);
    before.update();
    before.update();  // neighbours that came later
    expectHeld(before);

    Hills later;
    later.watch();
    installBins(*later.terrain, optionsOf("heights=-3000..8000"));
    later.update();
    expectHeld(later);
    const double own = later.bin(0).getBin().bin().altitude().upper;
    ASSERT_LT(own, 7990.0);
    later.terrain->setEqualizeBoundaries(true);
    later.update();
    later.update();
    expectHeld(later);
    EXPECT_TRUE(tilesMissed(later).empty());
    EXPECT_EQ(later.bin(0).getBin().bin().altitude().upper, 8000.0);
    EXPECT_LE(later.bin(0).getSurface().bin().altitude().lower, -3000.0 - later.bin(0).getSurface().sag());
    later.terrain->setEqualizeBoundaries(false);
    later.update();
    EXPECT_EQ(later.bin(0).getBin().bin().altitude().upper, own);
}

class OtherTechnique : public osgTerrain::GeometryTechnique {
public:
    OtherTechnique() = default;
    OtherTechnique(const OtherTechnique& other, const osg::CopyOp& copyop)
        : osgTerrain::GeometryTechnique(other, copyop) {}
    META_Object(osgAnalyticBin, OtherTechnique)
};

TEST(TerrainTechnique, TilesOfAnUnknownOneAreCulledByTheirSpheresAlone) {
    Hills plain;
    plain.watch();
    plain.update();
    Hills hills;
    hills.watch();
    hills.terrain->setTerrainTechniquePrototype(new OtherTechnique);
    const CapturedNotes notes(osg::INFO);
    installBins(*hills.terrain);
    hills.update();
    for (const double longitude : {8.0, 9.7, 9.85, 11.0}) {
        const osg::Vec3d eye = ecefDeg(41.5, longitude, 2e4), below = ecefDeg(41.5, longitude, -1e4);
        EXPECT_EQ(hills.reached.in(*hills.terrain, eye, below, 10.0),
                  plain.reached.in(*plain.terrain, eye, below, 10.0));
    }
    EXPECT_FALSE(hills.bin(0).getBin().valid());
    EXPECT_FALSE(hills.bin(0).getSurface().valid());
    EXPECT_EQ(notes.count("technique"), 1u);
}

TEST(TerrainTechnique, OsgsOwnAsAPrototypeIsKnown) {
    Hills hills;
    hills.terrain->setTerrainTechniquePrototype(new osgTerrain::GeometryTechnique);
    installBins(*hills.terrain);
    EXPECT_TRUE(hills.bin(0).getBin().valid());
    hills.terrain->setTerrainTechniquePrototype(new OtherTechnique);
    hills.update();
    EXPECT_FALSE(hills.bin(0).getBin().valid());
}

CullOptions vouchingFor(double metres) {
    CullOptions options;
    options.techniqueMargin = metres;
    return options;
}

// At the border of a region, what is drawn may end before the tiles do.
TEST(TerrainTechnique, TilesOfOneThatIsVouchedForAreNoRegion) {
    for (const double metres : {0.0, 100.0}) {
        const CapturedNotes notes(osg::NOTICE);
        Hills hills;
        installBins(*hills.terrain, vouchingFor(metres));
        hills.update();
        EXPECT_EQ(notes.count("leave gaps"), metres > 0.0 ? 1u : 0u);
        EXPECT_EQ(notes.count("not over the regional database"), metres > 0.0 ? 0u : 1u);
    }
}

// Moves the vertices that OSG makes, by as much as an application vouches for.
class Shifting : public osgTerrain::GeometryTechnique {
public:
    static constexpr double kMost = 2000.0;

    Shifting() = default;
    Shifting(const Shifting& other, const osg::CopyOp& copyop) : osgTerrain::GeometryTechnique(other, copyop) {}
    META_Object(osgAnalyticBin, Shifting)

        protected
        : void generateGeometry(BufferData& buffer, osgTerrain::Locator* locator, const osg::Vec3d& center) override {
        osgTerrain::GeometryTechnique::generateGeometry(buffer, locator, center);
        Random random(52);
        auto& vertices = dynamic_cast<osg::Vec3Array&>(*buffer._geometry->getVertexArray());
        for (osg::Vec3& vertex : vertices) vertex += osgVector(random.direction()) * kMost;
    }
};

TEST(TerrainTechnique, TilesOfOneThatIsVouchedForAreCulledByEnlargedBins) {
    Hills hills;
    hills.watch();
    hills.terrain->setTerrainTechniquePrototype(new Shifting);
    installBins(*hills.terrain, vouchingFor(Shifting::kMost));
    for (const float scale : {1.0f, 0.5f, 3.0f}) {
        hills.terrain->setVerticalScale(scale);
        hills.update();
        hills.update();
        expectHeld(hills);
        EXPECT_EQ(tilesMissed(hills), std::set<std::size_t>()) << scale;
        const osg::Vec3d eye = ecefDeg(-30, -120, 1e5);
        EXPECT_EQ(hills.reached.in(*hills.terrain, eye, ecefDeg(-31, -121, 0), 10.0).size(), 0u) << scale;
    }
    // a figure that is too small loses tiles
    EXPECT_EQ(setCullOptions(*hills.terrain, vouchingFor(0.0)), hills.tiles.size());
    hills.update();
    EXPECT_NE(tilesMissed(hills), std::set<std::size_t>());
}

}  // namespace
}  // namespace osgAnalyticBin::test
