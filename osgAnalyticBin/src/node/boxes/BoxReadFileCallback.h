// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../page/FailedReads.h"
#include "BoxSet.h"

#include <osgDB/Options>
#include <osgDB/ReadFile>

#include <map>
#include <string>

namespace osgAnalyticBin {

/// Installs boxes on what the DatabasePager reads below a photogrammetry set, in the thread that reads it. A file that
/// could not be read is not tried again for a while (FailedReads).
class BoxReadFileCallback final : public osgDB::ReadFileCallback {
public:
    /// `replaced`: the options that the PagedLODs came with; null: none.
    BoxReadFileCallback(BoxSet* set, osgDB::Options* replaced, osgDB::ReadFileCallback* previous)
        : _set(set), _replaced(replaced), _previous(previous) {}

    /// Announces a file: the name by which it will be requested, its name in the index, and the tile that pages it. Do
    /// not call once the pager may read.
    void expect(const std::string& fileName, const std::string& file, BoxTile* parent) {
        _expected[fileName] = {file, parent};
    }
    [[nodiscard]] bool expects(const std::string& fileName) const { return _expected.count(fileName) > 0; }

    [[nodiscard]] osgDB::Options* replaced() const { return _replaced.get(); }
    /// The expiry times that the PagedLODs were given.
    [[nodiscard]] double expiry() const { return _set->options().expiry; }

    osgDB::ReaderWriter::ReadResult readNode(const std::string& fileName, const osgDB::Options* options) override;

protected:
    ~BoxReadFileCallback() override = default;

private:
    struct Expected {
        std::string file;
        osg::ref_ptr<BoxTile> parent;
    };

    void install(osg::Node& node, const Expected& expected) const;

    const osg::ref_ptr<BoxSet> _set;
    const osg::ref_ptr<osgDB::Options> _replaced;
    const osg::ref_ptr<osgDB::ReadFileCallback> _previous;
    std::map<std::string, Expected> _expected;
    FailedReads _failures;
};

}  // namespace osgAnalyticBin
