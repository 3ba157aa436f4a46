// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "ReadInFront.h"

#include <atomic>
#include <cstdint>

namespace osgAnalyticBin::flight {

/// Counts the node files that are read through the Registry. The bins' own read callback ends at the Registry's, so
/// that files below bins are counted too.
class ReadCounter : public ReadInFront<ReadCounter> {
public:
    /// Node files read so far.
    [[nodiscard]] std::uint64_t nodeFiles() const { return _nodeFiles; }

    /// Bytes of these files on the disk; what is not found there, such as pseudo-loaders' names, counts nothing.
    [[nodiscard]] std::uint64_t nodeBytes() const { return _nodeBytes; }

    Result readNode(const std::string& fileName, const osgDB::Options* options) override;

protected:
    ~ReadCounter() override = default;

private:
    std::atomic<std::uint64_t> _nodeFiles{0};
    std::atomic<std::uint64_t> _nodeBytes{0};
};

}  // namespace osgAnalyticBin::flight
