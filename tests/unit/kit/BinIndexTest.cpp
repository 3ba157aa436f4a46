// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The file format by round trips and by damage of every kind, and an index beside its database. How it is used:
// AutoIndexTest.cpp. What osgbinconv puts into an index is tested in tests/unit/applications/osgbinconv, reading by
// OSG's file names in tests/unit/plugin.

#include "../../osgAnalyticBin/src/index/Checksum.h"
#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

AnalyticBin randomEntry(Random& random) {
    const double south = random.uniform(-1.5, 1.4), west = random.uniform(-3.1, 3.1),
                 low = random.uniform(-9000.0, 3000.0);
    AnalyticBin bin(
        core::GeodeticBin({south, south + random.uniform(0.0, 0.1)}, {west, west + random.uniform(0.0, 0.2)},
                          {low, low + random.uniform(0.0, 5000.0)}),
        random.uniform(0.0, 3.0));
    bin.setSag(random.uniform(0.0, 800.0));
    return bin;
}

osg::ref_ptr<BinIndex> randomIndex(int files) {
    Random random(4711);
    const osg::ref_ptr<BinIndex> index = new BinIndex;
    index->setSource({"earth.ive", 123456789012ull, -5});
    for (int i = 0; i < files; ++i) {
        std::vector<BinIndex::Entry> tiles;
        for (int n = random.integer(0, 4); n >= 0; --n)
            tiles.push_back({randomEntry(random), random.uniform(-9000.0, 3000.0), random.bits()});
        tiles.push_back({});  // never culled
        index->setTiles(i == 0 ? "" : "earth_tiles/L" + std::to_string(i % 7) + "/tile_" + std::to_string(i) + ".ive",
                        tiles);
    }
    return index;
}

std::string bytesOf(const BinIndex& index) {
    std::ostringstream out;
    EXPECT_TRUE(index.write(out));
    return out.str();
}

osg::ref_ptr<BinIndex> indexFrom(const std::string& bytes, std::string& error) {
    std::istringstream in(bytes);
    return BinIndex::read(in, error);
}

void expectRefused(const std::string& bytes, const std::string& what) {
    std::string error;
    ASSERT_FALSE(indexFrom(bytes, error)) << what;
    EXPECT_NE(error.find("osgbinconv --index"), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

void expectSame(const BinIndex& a, const BinIndex& b) {
    ASSERT_EQ(a.fileCount(), b.fileCount());
    for (const auto& [file, tiles] : a.files()) {
        const std::vector<BinIndex::Entry>* others = b.tilesOf(file);
        ASSERT_TRUE(others) << file;
        ASSERT_EQ(tiles.size(), others->size());
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            EXPECT_EQ(tiles[i].bin.valid(), (*others)[i].bin.valid());
            EXPECT_TRUE(!tiles[i].bin.valid() || tiles[i].bin == (*others)[i].bin);
            EXPECT_EQ(tiles[i].ownLow, (*others)[i].ownLow);
            EXPECT_EQ(tiles[i].fingerprint, (*others)[i].fingerprint);
        }
    }
}

// The values that are published for "123456789" with these polynomials.
TEST(BinIndex, ChecksumsAreThoseOfTheStandards) {
    EXPECT_EQ(indexing::crc32("123456789"), 0xCBF43926u);
    EXPECT_EQ(indexing::crc32("6789", indexing::crc32("12345")), 0xCBF43926u);
    EXPECT_EQ(indexing::crc64("123456789"), 0x995DC9BBDF1939FAu);
}

TEST(BinIndex, ReadsBackWhatItWrote) {
    for (const int files : {0, 1, 200}) {
        const osg::ref_ptr<BinIndex> index = randomIndex(files);
        const std::string bytes = bytesOf(*index);
        std::string error;
        const osg::ref_ptr<BinIndex> copy = indexFrom(bytes, error);
        ASSERT_TRUE(copy) << error;
        expectSame(*index, *copy);
        EXPECT_EQ(copy->source().name, "earth.ive");
        EXPECT_EQ(copy->source().size, 123456789012ull);
        EXPECT_EQ(copy->source().time, -5);
        EXPECT_EQ(bytesOf(*copy), bytes);
    }
}

TEST(BinIndex, FindsTilesByFileAndOrdinal) {
    const osg::ref_ptr<BinIndex> index = randomIndex(20);
    index->setTiles("a/b.osgb", {{AnalyticBin(core::GeodeticBin::fromDegrees({1, 2}, {3, 4}, {5, 6})), 5.0, 77}});
    ASSERT_TRUE(index->find("a/b.osgb", 0));
    EXPECT_EQ(index->find("a/b.osgb", 0)->fingerprint, 77u);
    EXPECT_TRUE(index->find("", 0));
    EXPECT_FALSE(index->find("a/b.osgb", 1));
    EXPECT_FALSE(index->find("b.osgb", 0));
}

TEST(BinIndex, RoundsOutward) {
    Random random(4712);
    for (int i = 0; i < 2000; ++i) {
        const AnalyticBin bin = randomEntry(random);
        const double ownLow = random.uniform(-12000.0, 9000.0);
        const osg::ref_ptr<BinIndex> index = new BinIndex;
        index->setTiles("", {{bin, ownLow, 1}});
        const BinIndex::Entry& entry = *index->find("", 0);
        ASSERT_TRUE(entry.bin.contains(bin));
        ASSERT_EQ(entry.bin.bin().latitude(), bin.bin().latitude());
        ASSERT_EQ(entry.bin.bin().longitude(), bin.bin().longitude());
        ASSERT_LT(entry.bin.bin().altitude().width(), bin.bin().altitude().width() + 0.002);
        ASSERT_LE(entry.ownLow, ownLow);
        ASSERT_GT(entry.ownLow, ownLow - 0.001);
    }
}

TEST(BinIndex, WhatItCannotHoldIsNeverCulled) {
    const osg::ref_ptr<BinIndex> index = new BinIndex;
    const double inf = std::numeric_limits<double>::infinity();
    const core::GeodeticBin good = core::GeodeticBin::fromDegrees({1, 2}, {3, 4}, {5, 6});
    const core::GeodeticBin far({0.0, 0.1}, {100.0, 100.1}, {0.0, 1.0});
    index->setTiles("", {{AnalyticBin(good), -inf, 1},
                         {AnalyticBin(good), std::nan(""), 2},
                         {AnalyticBin(good.withAltitude({-1e300, 1.0})), 0.0, 3},
                         {AnalyticBin(good, 1e300), 0.0, 4},
                         {AnalyticBin(far), 0.0, 5},
                         {AnalyticBin(), 0.0, 6}});
    std::string error;
    const osg::ref_ptr<BinIndex> copy = indexFrom(bytesOf(*index), error);
    ASSERT_TRUE(copy) << error;
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_FALSE(copy->find("", i)->bin.valid()) << i;
        EXPECT_EQ(copy->find("", i)->fingerprint, i + 1);
    }
}

TEST(BinIndex, EveryTruncationIsRefused) {
    const std::string bytes = bytesOf(*randomIndex(12));
    for (std::size_t length = 0; length < bytes.size(); ++length) expectRefused(bytes.substr(0, length), "truncated");
    expectRefused(bytes + 'x', "longer");
}

TEST(BinIndex, EveryFlippedBitIsRefused) {
    const std::string bytes = bytesOf(*randomIndex(12));
    Random random(4713);
    const int last = static_cast<int>(bytes.size()) - 1;
    for (int i = 0; i < 1500; ++i) {
        // the head with its sizes wholly, then anywhere
        const int at = i < 640 ? i / 8 : random.integer(0, last);
        std::string damaged = bytes;
        damaged[static_cast<std::size_t>(at)] = static_cast<char>(damaged[static_cast<std::size_t>(at)] ^ (1 << i % 8));
        expectRefused(damaged, "byte " + std::to_string(at));
    }
}

TEST(BinIndex, ForeignFilesAreRefused) {
    expectRefused("", "empty");
    expectRefused(std::string(100000, '\0'), "zeros");
    expectRefused("<html>404 not found</html>", "a web page");
    for (const char version : {'\1', '\3'}) {
        std::string other = bytesOf(*randomIndex(1));
        other[8] = version;
        std::string error;
        EXPECT_FALSE(indexFrom(other, error));
        EXPECT_NE(error.find("version"), std::string::npos) << error;
    }
}

TEST(BinIndex, WritesAWholeFileOrNone) {
    const TemporaryFolder scratch;
    const osg::ref_ptr<BinIndex> index = randomIndex(5);
    std::string error;
    ASSERT_TRUE(index->write(scratch / "earth.ive.bins", error)) << error;
    EXPECT_FALSE(std::filesystem::exists(scratch / "earth.ive.bins.tmp"));
    const osg::ref_ptr<BinIndex> copy = BinIndex::read(scratch / "earth.ive.bins", error);
    ASSERT_TRUE(copy) << error;
    expectSame(*index, *copy);
    EXPECT_FALSE(index->write(scratch / "absent/earth.ive.bins", error));
    EXPECT_NE(error.find("absent"), std::string::npos) << error;
    EXPECT_FALSE(BinIndex::read(scratch / "absent.bins", error));
    EXPECT_NE(error.find("absent.bins"), std::string::npos) << error;
}

TEST(BinIndex, StandsBesideItsDatabase) {
    const TemporaryFolder scratch;
    const std::string database = scratch / "earth.ive";
    std::string error = "left over";
    std::ofstream(database) << "nine bytes";
    EXPECT_FALSE(readBinIndex(database, nullptr, error));
    EXPECT_EQ(error, "");  // none there: in silence
    const osg::ref_ptr<BinIndex> index = randomIndex(5);
    index->setSource({"earth.ive", 10, 0});
    ASSERT_TRUE(index->write(binIndexName(database), error)) << error;
    const osg::ref_ptr<BinIndex> found = readBinIndex(database, nullptr, error);
    ASSERT_TRUE(found) << error;
    expectSame(*index, *found);
    std::ofstream(database, std::ios::app) << "changed";
    EXPECT_FALSE(readBinIndex(database, nullptr, error));
    EXPECT_NE(error.find("another \"earth.ive\""), std::string::npos) << error;
    std::ofstream(binIndexName(database)) << "rubbish";
    EXPECT_FALSE(readBinIndex(database, nullptr, error));
    EXPECT_NE(error.find("another kind of file"), std::string::npos) << error;
}

}  // namespace
}  // namespace osgAnalyticBin::test
