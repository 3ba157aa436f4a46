// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/index/FileRecord.h>

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace osgAnalyticBin::indexing {

/// The bins of the tiles of a file once all files below it are known: they hold the tile and its descendants with their
/// whole skirts, whatever neighbours there are. They are a little deeper than those of the whole index, which lowers
/// bins by no more of the skirts than cracks show.
/// Guarantee: such a bin holds all that the tile and its descendants draw; tests: SubtreeBins.*.
class SubtreeBins final {
public:
    using Publish = std::function<void(const std::string& file, std::vector<BinIndex::Entry> tiles)>;

    explicit SubtreeBins(Publish publish) : _publish(std::move(publish)) {}

    /// Adds the record of a file, each once. Publishes the files that are complete with it.
    void add(const FileRecord& record);

    /// Files that wait for others below them.
    [[nodiscard]] std::size_t waiting() const { return _waiting.size(); }

private:
    // All that a file draws with what is below it.
    struct Content {
        AnalyticBin united;
        bool isKnown = true;
        bool lacksFiles = false;  // which may draw any terrain over the tile above
    };
    struct Waiting {
        FileRecord record;
        std::size_t awaited = 0;
    };

    void complete(const FileRecord& record);

    const Publish _publish;
    std::map<std::string, Waiting> _waiting;
    std::map<std::string, Content> _complete;
    std::map<std::string, std::vector<std::string>> _namedBy;  // by files that are not complete
};

}  // namespace osgAnalyticBin::indexing
