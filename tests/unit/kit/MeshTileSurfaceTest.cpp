// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Surfaces of meshes. Oracle: samples of the triangles that are drawn, taken back to latitude, longitude and altitude.

#include "TileSurfaceCases.h"

#include <osg/PrimitiveSetIndirect>
#include <osg/ShapeDrawable>

#include <support/Planets.h>

namespace osgAnalyticBin::test::surfaces {
namespace {

TEST(TileSurface, TellsSkirtsOfMeshesFromTheirSurface) {
    Random random(7);
    for (std::size_t i = 0; i < 2 * tileCases().size(); ++i) {
        const TileCase c = tileCases()[i / 2];
        VpbMesh mesh;
        mesh.extents = c.extents;
        mesh.doSkirtsLean = i % 2 == 1;
        mesh.skirt = 50.0 + 40000.0 * c.extents.latitude().width();
        const auto tile = makeVpbTile(mesh, random);
        const TileSurface surface = surfaceOf(*tile);
        ASSERT_TRUE(surface.bin.valid()) << c.name;
        EXPECT_FALSE(surface.isScalable);
        EXPECT_NEAR(surface.skirt, mesh.skirt, 4.0) << c.name;
        const auto samples = samplesOf(surfaceTriangles(*tile, mesh.posts));
        EXPECT_LE(metresOutside(surface.bin, samples, kEllipsoid), surface.bin.margin()) << c.name;
        const core::Interval seen = altitudesOf(samples);
        const double width = std::max(c.extents.latitude().width(), c.extents.longitude().width());
        const double sag = 6.4e6 * 0.28 * width * width / 256.0;
        EXPECT_LE(surface.bin.bin().altitude().upper, seen.upper + 35.0) << c.name;
        EXPECT_GE(surface.bin.bin().altitude().lower, seen.lower - 1.2 * sag - 35.0) << c.name;
        const auto all = samplesOf(drawnTriangles(*tile).surface);
        EXPECT_LE(metresOutside(surface.bin.withSkirts(surface.skirt), all, kEllipsoid), surface.bin.margin())
            << c.name;
    }
}

TEST(TileSurface, HoldsAllWhereSkirtsCannotBeTold) {
    Random random(9);
    VpbMesh mesh;
    mesh.extents = GeodeticBin::fromDegrees({30, 35}, {60, 65}, {0, 0});
    mesh.low = mesh.high = 0.0;
    const auto texCoordsOf = [](osg::Geometry& drawn) -> osg::Vec2Array& {
        return static_cast<osg::Vec2Array&>(*drawn.getTexCoordArray(0));
    };
    ASSERT_NEAR(surfaceOf(*makeVpbTile(mesh, random)).skirt, mesh.skirt, 4.0);
    const std::pair<const char*, std::function<void(osg::Geometry&)>> spoilings[] = {
        {"no texture coordinates", [&](auto& drawn) { drawn.setTexCoordArray(0, nullptr); }},
        {"skirts of unequal depth", [&](auto& drawn) { verticesOf(drawn)[16 * 17 + 8].z() -= 300.0f; }},
        {"one skirt vertex moved sideways", [&](auto& drawn) { verticesOf(drawn).back().x() += 2000.0f; }},
        {"a border vertex without a partner", [&](auto& drawn) { texCoordsOf(drawn).back().y() = 0.513f; }},
        {"texture coordinates beyond the tile", [&](auto& drawn) { texCoordsOf(drawn)[20].x() = 3.0f; }},
        {"a triangle from a skirt to the middle of the tile", [&](auto& drawn) {
             auto& triangles = static_cast<osg::DrawElementsUShort&>(*drawn.getPrimitiveSet(0));
             for (const unsigned int i : {0u, 150u, 17u * 17u + 3u}) triangles.push_back(static_cast<GLushort>(i));
         }}};
    for (const auto& [name, spoil] : spoilings) {
        const auto tile = makeVpbTile(mesh, random);
        spoil(geometryOf(*tile));
        const TileSurface surface = surfaceOf(*tile);
        EXPECT_EQ(surface.skirt, 0.0) << name;
        EXPECT_LE(surface.bin.bin().altitude().lower, -5000.0 + 10.0) << name;
        const auto samples = samplesOf(drawnTriangles(*tile).surface);
        EXPECT_LE(metresOutside(surface.bin, samples, kEllipsoid), surface.bin.margin()) << name;
    }
}

TEST(TileSurface, FollowsFixedTransformsOnly) {
    Random random(10);
    VpbMesh mesh;
    mesh.extents = GeodeticBin::fromDegrees({30, 35}, {60, 65}, {0, 0});
    const auto tile = makeVpbTile(mesh, random);
    const TileSurface expected = surfaceOf(*tile);
    const osg::Matrixd frame = tile->getMatrix();
    tile->setMatrix(osg::Matrixd::rotate(0.7, 1, 2, 3));
    const auto above = makeTransform(osg::Matrixd::inverse(tile->getMatrix()), {tile});
    const TileSurface moved = tileSurface(*above, *kModel, frame);
    ASSERT_TRUE(moved.bin.valid());
    EXPECT_NEAR(moved.bin.bin().altitude().lower, expected.bin.bin().altitude().lower, 1e-3);
    EXPECT_NEAR(moved.bin.bin().longitude().upper, expected.bin.bin().longitude().upper, 1e-9);

    const auto isKnown = [&frame](osg::Node& node) { return tileSurface(node, *kModel, frame).bin.valid(); };
    above->setDataVariance(osg::Object::DYNAMIC);
    EXPECT_FALSE(isKnown(*above));
    above->setDataVariance(osg::Object::STATIC);
    above->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    EXPECT_FALSE(isKnown(*above));
    above->setReferenceFrame(osg::Transform::RELATIVE_RF);
    const osg::Matrixd affine = above->getMatrix();
    osg::Matrixd dividing = affine;
    dividing(1, 3) = 165.0;
    above->setMatrix(dividing);
    EXPECT_FALSE(isKnown(*above));
    EXPECT_FALSE(tileSurface(*tile, *kModel, dividing).bin.valid());
    above->setMatrix(affine);
    EXPECT_TRUE(isKnown(*above));
    struct Turning : osg::MatrixTransform {};
    const osg::ref_ptr<osg::MatrixTransform> turning = new Turning;
    turning->setMatrix(affine);
    turning->addChild(tile);
    EXPECT_FALSE(isKnown(*turning)) << "a class that may turn to the eye";
    above->addChild(new osg::PagedLOD);
    EXPECT_FALSE(isKnown(*above));
}

TEST(TileSurface, HoldsVerticesInTheFrameOfTheGlobeWhereTheyAreDrawn) {
    Random random(12);
    for (int trial = 0; trial < 50; ++trial) {
        const double south = random.uniform(-80.0, 80.0), west = random.uniform(-180.0, 180.0);
        const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
        for (int i = 0; i < 30; ++i)
            vertices->push_back(osg::Vec3(
                ecefDeg(south + random.uniform(0.0, 0.01), west + random.uniform(0.0, 0.01), random.uniform(0, 100))));
        const auto geometry = makeGeometry(vertices, new osg::DrawArrays(GL_POINTS, 0, 30));
        const TileSurface surface = surfaceOf(*geometry);
        const osg::Matrixd view =
            osg::Matrixd::lookAt(ecefDeg(south, west, 200.0), osg::Vec3d((*vertices)[0]), osg::Vec3d(0, 0, 1));
        for (const osg::Vec3& v : *vertices) {
            const osg::Vec3d ecef = drawnByFloats(v, view);
            EXPECT_LE(metresOutside(surface.bin, {ecef.x(), ecef.y(), ecef.z()}, kEllipsoid), surface.bin.margin());
        }
    }
}

TEST(TileSurface, HoldsLinesPointsAndShapes) {
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    const osg::ref_ptr<osg::Geometry> road = new osg::Geometry;
    const osg::Vec3 vertices[] = {{6378137.0f, 0.0f, 0.0f}, {6378137.0f, 1e5f, 0.0f}, {6379137.0f, 0.0f, 1000.0f}};
    road->setVertexArray(new osg::Vec3Array(3, vertices));
    geode->addDrawable(road);
    EXPECT_FALSE(surfaceOf(*geode).bin.valid());
    road->addPrimitiveSet(new osg::DrawArrays(GL_LINE_STRIP, 0, 2));
    EXPECT_NEAR(surfaceOf(*geode).bin.bin().altitude().upper, 784.0, 2.0);
    road->addPrimitiveSet(new osg::DrawArrays(GL_POINTS, 2, 1));
    EXPECT_NEAR(surfaceOf(*geode).bin.bin().altitude().upper, 1000.0, 2.0);
    geode->addDrawable(new osg::ShapeDrawable(new osg::Box(osg::Vec3(6378137.0f, 0.0f, 0.0f), 8000.0f)));
    EXPECT_NEAR(surfaceOf(*geode).bin.bin().altitude().upper, 4000.0, 10.0);

    road->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 1, 3));
    EXPECT_FALSE(surfaceOf(*geode).bin.valid()) << "an index beyond the vertices";
}

osg::BoundingBox boxAbove() {
    return {6381000.0f, -200.0f, -300.0f, 6382000.0f, 200.0f, 300.0f};
}

// Draws within its bound, as osgSim::LightPointNode does.
struct Lights : osg::Node {
    osg::BoundingSphere computeBound() const override { return osg::BoundingSphere(boxAbove()); }
};
// Beside its children.
struct Cloud : osg::Group {
    osg::BoundingSphere computeBound() const override { return osg::BoundingSphere(boxAbove()); }
};
struct OwnGeometry : osg::Geometry {
    osg::BoundingBox computeBoundingBox() const override { return boxAbove(); }
};
struct OwnBox : osg::Drawable::ComputeBoundingBoxCallback {
    osg::BoundingBox computeBound(const osg::Drawable& /*drawable*/) const override { return boxAbove(); }
};
struct OwnDrawing : osg::Drawable::DrawCallback {};

osg::ref_ptr<osg::Geometry> makeLine(osg::Geometry* line, const osg::Vec3& from, const osg::Vec3& to) {
    const osg::Vec3 ends[] = {from, to};
    line->setVertexArray(new osg::Vec3Array(2, ends));
    line->addPrimitiveSet(new osg::DrawArrays(GL_LINES, 0, 2));
    return line;
}

TEST(TileSurface, HoldsTheBoundOfWhatItsVerticesDoNotTell) {
    const osg::Vec3 low(6378137.0f, 0.0f, 0.0f), beside(6378137.0f, 1000.0f, 0.0f);
    const auto ground = makeLine(new osg::Geometry, low, beside);
    const auto ofOtherClass = makeLine(new OwnGeometry, low, beside),
               withBox = makeLine(new osg::Geometry, low, beside),
               withInitialBound = makeLine(new osg::Geometry, low, beside),
               drawn = makeLine(new osg::Geometry, boxAbove()._min, boxAbove()._max);
    withBox->setComputeBoundingBoxCallback(new OwnBox);
    withInitialBound->setInitialBound(boxAbove());
    drawn->setDrawCallback(new OwnDrawing);
    const std::vector<osg::ref_ptr<osg::Node>> contents{new Lights, new Cloud,        ofOtherClass,
                                                        withBox,    withInitialBound, drawn};
    for (std::size_t number = 0; number < contents.size(); ++number) {
        const auto tile = makeGroup({ground});
        const std::uint64_t without = surfaceFingerprint(*tile, osg::Matrixd());
        tile->addChild(contents[number]);
        const TileSurface surface = surfaceOf(*tile);
        ASSERT_TRUE(surface.bin.valid()) << number;
        for (unsigned int i = 0; i < 8; ++i) {
            const osg::Vec3d corner(boxAbove().corner(i));
            const double outside = metresOutside(surface.bin, {corner.x(), corner.y(), corner.z()}, kEllipsoid);
            EXPECT_LE(outside, surface.bin.margin()) << number;
        }
        EXPECT_LE(surface.bin.bin().altitude().upper, 5000.0) << number;
        EXPECT_NE(surfaceFingerprint(*tile, osg::Matrixd()), without) << number;
    }
}

// The ground sags deepest below the longer diagonal, which is the first one of a quad or the other one.
TEST(TileSurface, HoldsQuadsWhicheverDiagonalDividesThem) {
    const osg::Vec3d around[] = {ecefDeg(40.0, 10.0, 0.0), ecefDeg(37.0, 13.0, 0.0), ecefDeg(40.3, 10.3, 0.0),
                                 ecefDeg(43.0, 7.0, 0.0)};
    for (const GLenum mode : {GLenum{GL_QUADS}, GLenum{GL_QUAD_STRIP}}) {
        for (std::size_t first = 0; first < 4; ++first) {
            const auto corner = [&](std::size_t i) { return osg::Vec3(around[(first + i) % 4] - around[0]); };
            const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
            for (const std::size_t i : {0U, 1U, 2U, 3U}) vertices->push_back(corner(i));
            if (mode == GL_QUAD_STRIP) std::swap((*vertices)[2], (*vertices)[3]);
            const auto geometry = makeGeometry(vertices, new osg::DrawArrays(mode, 0, 4));
            const TileSurface surface = tileSurface(*geometry, *kModel, osg::Matrixd::translate(around[0]), 1.0);
            const osg::Vec3d middle = (around[1] + around[3]) * 0.5;
            const double outside = metresOutside(surface.bin, {{middle.x(), middle.y(), middle.z()}}, kEllipsoid);
            EXPECT_LE(outside, surface.bin.margin()) << mode << ' ' << first;
        }
    }
}

osg::ref_ptr<osg::Billboard> randomBillboard(osg::Billboard::Mode mode, bool isPlain, Random& random) {
    const auto any = [&random](double size) {
        return osg::Vec3(
            osg::Vec3d(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)));
    };
    const osg::ref_ptr<osg::Billboard> billboard = new osg::Billboard;
    billboard->setMode(mode);
    if (!isPlain) {
        billboard->setAxis(any(1.0));
        billboard->setNormal(any(1.0));
    }
    for (int i = 0; i < 4; ++i) {
        const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
        for (int corner = 0; corner < 4; ++corner) vertices->push_back(any(50.0));
        billboard->addDrawable(makeGeometry(vertices, new osg::DrawArrays(GL_QUADS, 0, 4)), any(2000.0));
    }
    return billboard;
}

// Oracle: OSG's own matrices for random eyes.
TEST(TileSurface, HoldsABillboardHoweverItTurns) {
    Random random(9);
    const osg::Matrixd frame =
        osg::Matrixd::rotate(0.3, 0.1, 0.7, 0.2) * osg::Matrixd::translate(ecefDeg(47, 11, 1000.0));
    for (int trial = 0; trial < 24; ++trial) {
        const auto mode = static_cast<osg::Billboard::Mode>(trial % 3);
        const auto billboard = randomBillboard(mode, trial % 2 == 0, random);
        const TileSurface surface = tileSurface(*billboard, *kModel, frame, 1.0);
        ASSERT_TRUE(surface.bin.valid());
        core::Interval seen{1e9, -1e9};
        for (int i = 0; i < 60; ++i) {
            const osg::Vec3d eye(random.uniform(-3e3, 3e3), random.uniform(-3e3, 3e3), random.uniform(-3e3, 3e3));
            const auto look = osg::Matrixd::lookAt(eye, {0, 0, 0}, {0, random.uniform(-1.0, 1.0), 1});
            for (unsigned int k = 0; k < billboard->getNumDrawables(); ++k) {
                osg::Matrix turned = look;
                billboard->computeMatrix(turned, osg::Vec3(eye), billboard->getPosition(k));
                const osg::Matrixd toEcef = turned * osg::Matrixd::inverse(look) * frame;
                const auto points = samplesOf(drawnTriangles(*billboard->getDrawable(k), toEcef).surface);
                EXPECT_LE(metresOutside(surface.bin, points, kEllipsoid), surface.bin.margin()) << trial;
                const core::Interval own = altitudesOf(points);
                seen = {std::min(seen.lower, own.lower), std::max(seen.upper, own.upper)};
            }
        }
        // vertices are up to 87 m from the position, corners of the cube 150 m
        EXPECT_LE(surface.bin.bin().altitude().upper - seen.upper, 150.0) << trial;
        EXPECT_LE(seen.lower - surface.bin.bin().altitude().lower, 150.0) << trial;
    }
}

TEST(TileSurface, IsUnknownWhereThereIsNoTerrainNoPositionForEachDrawableOrNoRightRadii) {
    Random random(10);
    const auto billboard = randomBillboard(osg::Billboard::POINT_ROT_EYE, true, random);
    const osg::Matrixd frame = osg::Matrixd::translate(ecefDeg(47, 11, 1000.0));
    ASSERT_TRUE(tileSurface(*billboard, *kModel, frame, 1.0).bin.valid());
    billboard->getPositionList().pop_back();
    EXPECT_FALSE(tileSurface(*billboard, *kModel, frame, 1.0).bin.valid());
    EXPECT_FALSE(surfaceOf(*makeGroup({})).bin.valid());
    const osg::ref_ptr<osg::Geode> planar = new osg::Geode;
    planar->addDrawable(new osg::ShapeDrawable(new osg::Box(osg::Vec3(500.0f, 0.0f, 0.0f), 1000.0f)));
    EXPECT_FALSE(surfaceOf(*planar).bin.valid());
    const osg::ref_ptr<osg::Node> tile = makeMeshTile(extentsDeg(10, 11, 20, 21), 200.0);
    EXPECT_TRUE(surfaceOf(*tile).bin.valid());
    EXPECT_FALSE(tileSurface(*tile, osg::EllipsoidModel(std::nan(""), 6.4e6), osg::Matrixd::identity()).bin.valid());
}

// Mountains of small bodies are a tenth of their radius high; what is far above any is no terrain, in any unit.
TEST(TileSurface, TellsTerrainOfAnyPlanetFromWhatIsNone) {
    Random random(2300);
    for (const Planet& planet : kPlanets) {
        for (const double unit : planet.units()) {
            const core::Ellipsoid ellipsoid = planet.in(unit);
            const double radius = ellipsoid.equatorialRadius(), polar = ellipsoid.polarRadius();
            const osg::EllipsoidModel model(radius, polar);
            const auto isKnown = [&](double altitude) {
                const GeodeticBin extents = GeodeticBin::fromDegrees({10.0, 15.0}, {20.0, 25.0}, {0.0, 0.0});
                const auto tile = makeVpbTile({extents, 9, 0.005 * radius, altitude, altitude}, random, model);
                return tileSurface(*tile, model, osg::Matrixd()).bin.valid();
            };
            const double mountain =
                std::min(22000.0 * radius / planet.equatorialRadius, 0.09 * std::min(radius, polar));
            EXPECT_TRUE(isKnown(mountain)) << planet.name << unit;
            EXPECT_TRUE(isKnown(-std::min(mountain, 0.05 * polar))) << planet.name << unit;
            EXPECT_FALSE(isKnown(0.12 * std::max(radius, polar))) << planet.name << unit;
            EXPECT_FALSE(isKnown(-0.2 * std::max(radius, polar))) << planet.name << unit;
        }
    }
}

// A few bytes in a file may claim ranges of billions of vertices, or triangles that end in the middle.
TEST(TileSurface, ReadsNothingBeyondVerticesAndIndices) {
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (int i = 0; i < 6; ++i)
        vertices->push_back(
            osg::Vec3(6378137.0f, 1000.0f * static_cast<float>(i / 2), 1000.0f * static_cast<float>(i % 2)));
    geometry->setVertexArray(vertices);
    geode->addDrawable(geometry);
    const auto isKnownWith = [&](osg::PrimitiveSet* primitives) {
        geometry->removePrimitiveSet(0, geometry->getNumPrimitiveSets());
        geometry->addPrimitiveSet(primitives);
        (void)surfaceFingerprint(*geode, osg::Matrixd());
        return surfaceOf(*geode).bin.valid();
    };
    const int all = std::numeric_limits<int>::max();
    for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode) {
        EXPECT_TRUE(isKnownWith(new osg::DrawArrays(mode, 0, 6))) << mode;
        EXPECT_FALSE(isKnownWith(new osg::DrawArrays(mode, 0, all))) << mode;
        EXPECT_FALSE(isKnownWith(new osg::DrawArrays(mode, all, all))) << mode;
        EXPECT_FALSE(isKnownWith(new osg::DrawArrays(mode, -3, 6))) << mode;
        const osg::ref_ptr<osg::DrawArrayLengths> lengths = new osg::DrawArrayLengths(mode, 2);
        lengths->push_back(4);
        EXPECT_TRUE(isKnownWith(lengths)) << mode;
        const osg::ref_ptr<osg::DrawArrayLengths> more = new osg::DrawArrayLengths(mode, 2);
        for (const int length : {4, all, all, 2}) more->push_back(length);
        EXPECT_FALSE(isKnownWith(more)) << mode;
        for (unsigned int count = 0; count < 6; ++count) {
            const osg::ref_ptr<osg::DrawElementsUByte> bytes = new osg::DrawElementsUByte(mode);
            bytes->reserveElements(count);
            for (unsigned int i = 0; i < count; ++i) bytes->push_back(static_cast<GLubyte>(i));
            const unsigned int least = mode <= GL_LINE_STRIP ? 1 : mode == GL_QUADS || mode == GL_QUAD_STRIP ? 4 : 3;
            EXPECT_EQ(isKnownWith(bytes), count >= least) << mode << ' ' << count;
        }
    }
    // the triangle of the vertices 3 to 5
    const osg::ref_ptr<osg::DrawElementsIndirectUShort> indirect = new osg::DrawElementsIndirectUShort(GL_TRIANGLES);
    for (const GLushort i : {GLushort{0}, GLushort{1}, GLushort{2}}) indirect->push_back(i);
    indirect->setIndirectCommandArray(new osg::DefaultIndirectCommandDrawElements);
    static_cast<osg::DefaultIndirectCommandDrawElements&>(*indirect->getIndirectCommandArray())
        .push_back({3, 1, 0, 3, 0});
    EXPECT_FALSE(isKnownWith(indirect));
    // the triangles of the vertices 0 to 2 and 3 to 5
    const osg::ref_ptr<osg::MultiDrawArrays> fans = new osg::MultiDrawArrays(GL_TRIANGLE_FAN);
    fans->add(0, 3);
    fans->add(3, 3);
    EXPECT_FALSE(isKnownWith(fans));
}

}  // namespace
}  // namespace osgAnalyticBin::test::surfaces
