// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "FailedReads.h"

#include <osgAnalyticBin/CullOptions.h>

#include <osg/CoordinateSystemNode>
#include <osg/Matrixd>
#include <osgDB/ReadFile>

#include <string>

namespace osgAnalyticBin {

/// Installs bins on what the DatabasePager reads, in the thread that reads it. Reading itself is left to the callback
/// that was there before, if any, else to the Registry's, else to OSG. A file that could not be read is left alone for
/// a while (FailedReads); the pager then gets nothing at once, and asks again.
/// With osgDB::Options::CACHE_NODES the object cache keeps tiles with bins under options of their own: those who read
/// without bins, or for another globe, place or method, never share them.
class BinReadFileCallback : public osgDB::ReadFileCallback {
public:
    BinReadFileCallback(const CullOptions& options, const osg::EllipsoidModel* ellipsoid,
                        const osg::Matrixd& localToEcef, osgDB::ReadFileCallback* previous);

    osgDB::ReaderWriter::ReadResult readNode(const std::string& fileName, const osgDB::Options* options) override;

    [[nodiscard]] osgDB::ReadFileCallback* previous() { return _previous.get(); }

protected:
    ~BinReadFileCallback() override;

private:
    using ReadResult = osgDB::ReaderWriter::ReadResult;

    [[nodiscard]] ReadResult readOrFail(const std::string& fileName, const osgDB::Options* options);
    [[nodiscard]] ReadResult readThroughCache(const std::string& fileName, const osgDB::Options& options);
    [[nodiscard]] ReadResult readTreated(const std::string& fileName, const osgDB::Options* options);
    void treat(osg::Node& node) const;
    [[nodiscard]] osgDB::ReaderWriter::ReadResult readUntreated(const std::string& fileName,
                                                                const osgDB::Options* options);

    const CullOptions _options;
    const osg::ref_ptr<const osg::EllipsoidModel> _ellipsoid;
    const osg::Matrixd _localToEcef;
    const std::string _place;  // which globe, and where on it
    const osg::ref_ptr<osgDB::ReadFileCallback> _previous;
    FailedReads _failures;
};

}  // namespace osgAnalyticBin
