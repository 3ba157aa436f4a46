// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "ReadInFront.h"

#include <atomic>

namespace osgAnalyticBin::bench {

/// A callback of the Registry that raises the minimum expiry time of what PagedLODs page in, as bins do by
/// CullOptions::expiry, in every node that is read: pages that the DatabasePager loads too. Longer times stay.
class ExpiryRaiser : public flight::ReadInFront<ExpiryRaiser> {
public:
    /// 0, as at first, leaves what is read as it is.
    void setSeconds(double seconds) { _seconds = seconds; }

    Result readNode(const std::string& fileName, const osgDB::Options* options) override;

protected:
    ~ExpiryRaiser() override = default;

private:
    std::atomic<double> _seconds{0.0};
};

}  // namespace osgAnalyticBin::bench
