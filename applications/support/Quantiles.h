// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace osgAnalyticBin::support {

/// The quantiles of some numbers.
class Quantiles final {
public:
    explicit Quantiles(std::vector<double> numbers) : _sorted(std::move(numbers)) {
        std::sort(_sorted.begin(), _sorted.end());
    }

    /// The number that `part` of `parts` equal parts do not exceed: at(1, 4) is the first quartile. 0 of no numbers.
    [[nodiscard]] double at(std::size_t part, std::size_t parts) const {
        return _sorted.empty() ? 0.0 : _sorted[(_sorted.size() - 1) * part / parts];
    }

private:
    std::vector<double> _sorted;
};

}  // namespace osgAnalyticBin::support
