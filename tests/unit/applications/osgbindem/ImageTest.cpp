// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Which colours a database has of several images: the finest, through holes those below. The
// oracles are the images' own colours, and a database that has none of them.

#include "RasterTest.h"

#include <osg/Texture2D>

namespace {

constexpr Colour kBlue{10, 40, 230};
constexpr Colour kRed{230, 30, 20};
constexpr Colour kGreen{20, 200, 50};

/// The image of a tile's texture; nullptr without one.
const osg::Image* textureOf(const LoadedTile& tile) {
    const osg::StateSet* state = tile.geometry->getStateSet();
    const osg::StateAttribute* texture = state ? state->getTextureAttribute(0, osg::StateAttribute::TEXTURE) : nullptr;
    return texture ? dynamic_cast<const osg::Texture2D&>(*texture).getImage() : nullptr;
}

/// What a tile shows at its texel nearest to the position.
Colour shownAt(const LoadedTile& tile, double latitudeDeg, double longitudeDeg) {
    const osg::Image* image = textureOf(tile);
    if (!image) throw std::runtime_error("no texture there");
    const Rect rect = tile.rect();
    const auto texel = [&](double share) { return static_cast<unsigned int>(std::lround(share * (image->s() - 1))); };
    const unsigned char* shown = image->data(texel((longitudeDeg - rect.west) / (rect.east - rect.west)),
                                             texel((latitudeDeg - rect.south) / (rect.north - rect.south)));
    return {shown[0], shown[1], shown[2]};
}
/// What the finest tile there shows.
Colour shownAt(const LoadedDatabase& database, double latitudeDeg, double longitudeDeg) {
    return shownAt(database.leafAt(latitudeDeg, longitudeDeg), latitudeDeg, longitudeDeg);
}

class Images : public RasterTest {
protected:
    void SetUp() override { (void)TestRaster::globe(1.0, hills).write(file("globe.tif")); }

    std::string image(const std::string& name, const TestImage& image) const { return image.write(file(name)); }
    [[nodiscard]] std::string blueGlobe() const { return image("blue.tif", TestImage::globe(1.0, kBlue)); }

    /// Tiles of 5.6 degrees at the finest level.
    [[nodiscard]] Words command(const Words& images, Words words = {}) const {
        words.insert(words.begin(), {file("globe.tif"), "--cells", "8", "--levels", "2", "-te", "0", "40", "30", "60"});
        for (const std::string& name : images) words.insert(words.end(), {"--image", name});
        return words;
    }
    [[nodiscard]] LoadedDatabase built(const Words& images, const Words& words = {}) const {
        return databaseOf(command(images, words));
    }
    void expectRefused(const std::string& image, const std::string& what) const {
        expectFailure(command({image}, {"-o", file("earth.osgb")}), what);
    }

    /// An image of six degrees from 10 E, 50 N on.
    [[nodiscard]] OpenRaster sixDegrees(GDALDataType type, int bands) const {
        return {file("any.tif"), {60, 60, bands}, type, 10.0, 50.0, 0.1, 0.1};
    }
};

void expectNear(const Colour& colour, const Colour& expected, int most) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(colour[c], expected[c], most) << c;
}

const osg::Vec4ubArray& coloursOf(const LoadedTile& tile) {
    return dynamic_cast<const osg::Vec4ubArray&>(*tile.geometry->getColorArray());
}

TEST_F(Images, TheFinestCountsWhateverTheOrder) {
    const std::string blue = blueGlobe();
    const std::string red = image("red.tif", {10.0, 50.0, 0.1, 60, kRed});
    const std::string green = image("green.tif", {12.0, 49.0, 0.05, 60, kGreen});
    const std::string equal = image("equal.tif", {12.0, 49.0, 0.05, 60, kRed});
    for (const Words& images : {Words{blue, red, green}, Words{green, red, blue}, Words{green, equal, blue}}) {
        const LoadedDatabase database = built(images);
        EXPECT_EQ(shownAt(database, 58.0, 28.0), kBlue);
        EXPECT_EQ(shownAt(database, 47.5, 13.5), kGreen);
        EXPECT_EQ(shownAt(database, 45.5, 10.5), images[1] == red ? kRed : kBlue);
    }
}

TEST_F(Images, TexturesAreAsFineAsTheFinestImageOfTheTile) {
    const LoadedDatabase database = built({blueGlobe(), image("fine.tif", {10.0, 50.0, 0.02, 50, kRed})});
    EXPECT_EQ(textureOf(database.leafAt(49.5, 10.5))->s(), 256);
    EXPECT_EQ(textureOf(database.leafAt(58.0, 28.0))->s(), 16);
    database.forEach([](const LoadedTile& tile) {
        EXPECT_EQ(tile.geometry->getTexCoordArray(0)->getNumElements(), tile.vertices.size());
    });
    checkNodes(database);
    // Where a texture shows relief beside its image, it is as fine as the posts.
    const LoadedDatabase relief = databaseOf({file("globe.tif"), "--cells", "64", "--levels", "1", "-te", "10", "47",
                                              "13", "50", "--image", image("coarse.tif", {10.0, 50.0, 1.0, 3, kRed})});
    EXPECT_EQ(textureOf(relief.leafAt(48.5, 11.5))->s(), 64);
}

TEST_F(Images, OfAnyTypeAndOrderOfBandsHaveTheirColours) {
    const std::array<double, 3> colour{200.0, 100.0, 50.0};
    const auto write = [&](GDALDataType type, double brightest, const std::array<int, 3>& order) {
        const OpenRaster raster = sixDegrees(type, 3);
        for (int i = 0; i < 3; ++i) {
            const int channel = order[static_cast<std::size_t>(i)];
            raster.band(i + 1).SetColorInterpretation(static_cast<GDALColorInterp>(GCI_RedBand + channel));
            raster.band(i + 1).Fill(colour[static_cast<std::size_t>(channel)] / 255.0 * brightest);
        }
        return file("any.tif");
    };
    for (const auto& [type, brightest] :
         {std::pair{GDT_Byte, 255.0}, std::pair{GDT_UInt16, 65535.0}, std::pair{GDT_Float32, 1.0}})
        expectNear(shownAt(built({write(type, brightest, {2, 1, 0})}), 47.5, 13.5), {200, 100, 50}, 1);
    expectRefused(write(GDT_Float32, 1e6, {0, 1, 2}), "-ot Byte -scale");
}

TEST_F(Images, AlphaCountsInAnyPlaceAndBesideNodata) {
    for (const int alpha : {1, 4, 5}) {
        {
            const OpenRaster raster = sixDegrees(GDT_Byte, std::max(alpha, 4));
            int colour = GCI_RedBand;
            for (int i = 1; i <= raster->GetRasterCount(); ++i) {
                GDALRasterBand& band = raster.band(i);
                band.SetColorInterpretation(i == alpha              ? GCI_AlphaBand
                                            : colour > GCI_BlueBand ? GCI_Undefined
                                                                    : static_cast<GDALColorInterp>(colour++));
                band.Fill(i == alpha ? 0.0 : 99.0);
                if (alpha == 4) band.SetNoDataValue(7.0);
            }
        }
        EXPECT_NE(shownAt(built({file("any.tif")}), 47.5, 13.5), (Colour{99, 99, 99})) << alpha;
    }
}

TEST_F(Images, OtherColoursThanRedGreenAndBlueAreRefused) {
    {
        const OpenRaster raster = sixDegrees(GDT_Byte, 4);
        for (int i = 0; i < 4; ++i)
            raster.band(i + 1).SetColorInterpretation(static_cast<GDALColorInterp>(GCI_CyanBand + i));
    }
    expectRefused(file("any.tif"), "red, green and blue");
}

TEST_F(Images, TilesOfAMapProjectionHaveNoSeams) {
    Words images;
    for (int i = 0; i < 4; ++i) {
        images.push_back(file("tile" + std::to_string(i) + ".tif"));
        const OpenRaster raster(images.back(), {50, 50, 3}, GDT_Byte, 600000.0 + 250000.0 * (i % 2),
                                5600000.0 + 250000.0 * (i / 2), 5000.0, 5000.0, "EPSG:32632");
        for (int band = 1; band <= 3; ++band) raster.band(band).Fill(255.0);
    }
    const LoadedDatabase database = built(images);
    for (double latitude = 49.5; latitude < 51.5; latitude += 0.07)
        for (double longitude = 12.5; longitude < 15.0; longitude += 0.07)
            EXPECT_EQ(shownAt(database, latitude, longitude), (Colour{255, 255, 255})) << latitude << ' ' << longitude;
}

TEST_F(Images, HolesShowWhatLiesBelow) {
    // The south-eastern quarter of the inset is a hole, and so is the western half of the coarser image.
    TestImage coarse(0.0, 60.0, 0.5, 60, kBlue);
    coarse.colourAt = [](double, double longitudeDeg) {
        return longitudeDeg < 15.0 ? std::nullopt : std::optional(kBlue);
    };
    TestImage fine(11.0, 50.0, 0.1, 80, kRed);
    fine.colourAt = [](double latitudeDeg, double longitudeDeg) {
        return latitudeDeg < 46.0 && longitudeDeg > 13.0 ? std::nullopt : std::optional(kRed);
    };
    const LoadedDatabase relief = built({image("far.tif", {28.0, 58.0, 0.1, 10, kRed})});
    for (const Hole hole : {Hole::Alpha, Hole::Mask, Hole::Nodata, Hole::Palette}) {
        coarse.hole = fine.hole = hole;
        const LoadedDatabase database = built({image("coarse.tif", coarse), image("fine.tif", fine)});
        EXPECT_EQ(shownAt(database, 48.0, 14.0), kRed);
        EXPECT_EQ(shownAt(database, 44.0, 17.0), kBlue);
        // A tile without an image has its colours at the posts.
        const LoadedTile& tile = relief.leafAt(44.3, 13.7);
        ASSERT_EQ(textureOf(tile), nullptr);
        const osg::Vec4ub& post = coloursOf(tile)[static_cast<std::size_t>(4 * (tile.cells + 1) + 4)];
        const Colour expected{post[0], post[1], post[2]};
        // The texels beside the middle post are 1/15 of the tile apart.
        const Rect rect = tile.rect();
        expectNear(shownAt(database, 0.5 * (rect.south + rect.north), 0.5 * (rect.west + rect.east)), expected, 12);
        EXPECT_FALSE(expected == kBlue);
    }
}

TEST_F(Images, HolesStayHolesInReducedTextures) {
    // In the start tile of 11.25 degrees, some four pixels of the image are one of the texture.
    TestImage fine(2.0, 54.0, 0.01, 400, kRed);
    fine.colourAt = [](double, double longitudeDeg) { return longitudeDeg > 4.0 ? std::nullopt : std::optional(kRed); };
    for (const Hole hole : {Hole::Alpha, Hole::Mask, Hole::Nodata, Hole::Palette}) {
        fine.hole = hole;
        const LoadedDatabase database = built({blueGlobe(), image("fine.tif", fine)});
        const auto start = std::find_if(database.tiles.begin(), database.tiles.end(), [](const LoadedTile& tile) {
            const Rect r = tile.rect();
            return r.west <= 2.0 && r.south <= 50.0 && r.east >= 6.0 && r.north >= 54.0;
        });
        ASSERT_NE(start, database.tiles.end());
        EXPECT_EQ(textureOf(*start)->s(), 256);
        EXPECT_EQ(shownAt(*start, 52.0, 3.0), kRed);
        EXPECT_EQ(shownAt(*start, 52.0, 5.0), kBlue);
    }
}

TEST_F(Images, ANodataValueInOneColourIsNoHole) {
    TestImage pale = TestImage::globe(1.0, {7, 99, 7});
    pale.hole = Hole::Nodata;
    EXPECT_EQ(shownAt(built({image("pale.tif", pale)}), 50.0, 10.0), (Colour{7, 99, 7}));
}

TEST_F(Images, TilesWithoutAnImageAreAsInADatabaseWithoutImages) {
    const LoadedDatabase plain = built({});
    const LoadedDatabase database = built({image("red.tif", {10.0, 50.0, 0.1, 60, kRed})});
    int textures = 0;
    database.forEach([&textures](const LoadedTile& tile) { textures += textureOf(tile) ? 1 : 0; });
    EXPECT_GT(textures, 3);
    EXPECT_LT(textures, 12);
    EXPECT_EQ(coloursOf(database.leafAt(58.0, 28.0)).asVector(), coloursOf(plain.leafAt(58.0, 28.0)).asVector());
}

TEST_F(Images, ThreadsChangeNothing) {
    TestImage fine(8.0, 50.0, 0.05, 90, kRed);
    fine.colourAt = [](double latitudeDeg, double) { return latitudeDeg < 48.0 ? std::nullopt : std::optional(kRed); };
    const Words images{image("blue.tif", {-10.0, 60.0, 0.5, 60, kBlue}), image("fine.tif", fine)};
    for (const std::string threads : {"1", "3"})
        build(command(images, {"--threads", threads, "-o", _folder.makeFolder(threads) + "/earth.osgb"}));
    EXPECT_TRUE(filesBelow(file("1")) == filesBelow(file("3")));
}

}  // namespace
