// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/index/DatabaseWalk.h>

#include <gtest/gtest.h>
#include <osg/CoordinateSystemNode>
#include <osg/Drawable>
#include <osg/MatrixTransform>
#include <osg/Matrixd>
#include <osg/Node>
#include <osgDB/ReadFile>
#include <osgDB/ReaderWriter>
#include <osgDB/Registry>

#include <cstdlib>
#include <string>
#include <support/CapturedNotes.h>
#include <support/PhotogrammetrySample.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {

/// A photogrammetry set in a folder of its own.
class PhotogrammetryFixture : public ::testing::Test {
protected:
    PhotogrammetryFixture() { ::setenv("XDG_CACHE_HOME", _cache.path().c_str(), 1); }
    ~PhotogrammetryFixture() override { ::unsetenv("XDG_CACHE_HOME"); }
    void SetUp() override { write({}); }

    void write(const PhotogrammetrySample& sample) {
        _metadata = writePhotogrammetrySample(_folder.path(), sample);
        ASSERT_FALSE(_metadata.empty());
    }

    void writeMetadata(const std::string& srs, const std::string& origin) const {
        (void)_folder.write("metadata.xml", "<?xml version=\"1.0\"?>\n<ModelMetadata version=\"1\"><SRS>" + srs +
                                                "</SRS><SRSOrigin>" + origin + "</SRSOrigin></ModelMetadata>\n");
    }

    void makeIndex() const {
        std::string error;
        ASSERT_TRUE(madeIndex()->write(binIndexName(_metadata), error)) << error;
    }
    [[nodiscard]] osg::ref_ptr<BinIndex> madeIndex() const {
        const indexing::DatabaseFiles files(_metadata);
        indexing::WalkObserver observer;
        return indexing::indexFrom(files, indexing::walkDatabase(files, {}, observer, 2)).index;
    }

    [[nodiscard]] osgDB::ReaderWriter::ReadResult readResult(const std::string& options = "") const {
        const std::string name = _metadata + (options.empty() ? "" : ".(" + options + ")") + ".analyticbin";
        return osgDB::Registry::instance()->readNode(name, nullptr);
    }
    [[nodiscard]] osg::ref_ptr<osg::Node> read(const std::string& options = "") const {
        osgDB::ReaderWriter::ReadResult result = readResult(options);
        return result.getNode();
    }
    [[nodiscard]] std::string errorOfRead() const {
        osgDB::ReaderWriter::ReadResult result = readResult();
        return result.validNode() ? "no error" : result.message();
    }

    /// The transform that holds the tiles of a set that was read.
    [[nodiscard]] static osg::MatrixTransform* setIn(osg::Node& scene) {
        auto* const globe = dynamic_cast<osg::CoordinateSystemNode*>(&scene);
        return dynamic_cast<osg::MatrixTransform*>(globe ? globe->getChild(0) : &scene);
    }

    TemporaryFolder _folder, _cache;
    std::string _metadata;
};

}  // namespace osgAnalyticBin::test
