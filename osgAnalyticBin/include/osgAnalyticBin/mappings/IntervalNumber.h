// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <boost/numeric/interval.hpp>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

/// Boost.Interval's way to round downward and upward: the result of any operation or function, moved by more than its
/// error. A processor's rounding modes, Boost's own way, are not obeyed by compilers and C libraries.
class OutwardRounding {
public:
    /// @{
    /// Which way force_rounding() moves.
    void downward() noexcept { _direction = -1.0; }
    void upward() noexcept { _direction = 1.0; }
    void to_nearest() noexcept { _direction = 0.0; }
    /// @}

    /// A bound of what `computed` is the rounded value of.
    [[nodiscard]] double force_rounding(double computed) const noexcept {
        constexpr double kRounding = 5.0 * std::numeric_limits<double>::epsilon();
        constexpr double kTiny = std::numeric_limits<double>::denorm_min(), kMost = std::numeric_limits<double>::max();
        const double step = std::abs(computed) * kRounding + kTiny;
        if (_direction < 0.0) return std::min(computed, kMost) - step;
        return _direction > 0.0 ? std::max(computed, -kMost) + step : computed;
    }
    /// The next integer in that direction.
    [[nodiscard]] double to_int(double x) const noexcept { return _direction < 0.0 ? std::floor(x) : std::ceil(x); }

private:
    double _direction = 0.0;
};

/// Operations and functions that round by OutwardRounding. Sums with zero are exact, and keep zeros zero.
struct IntervalRounding : boost::numeric::interval_lib::rounded_transc_std<
                              double, boost::numeric::interval_lib::rounded_arith_std<double, OutwardRounding>> {
    /// @{
    /// Bounds of a sum.
    double add_down(double x, double y) { return x == 0.0 || y == 0.0 ? x + y : rounded_arith_std::add_down(x, y); }
    double add_up(double x, double y) { return x == 0.0 || y == 0.0 ? x + y : rounded_arith_std::add_up(x, y); }
    /// @}
};

/// A number known to lie between two doubles. Arithmetic and functions return an interval that holds every result for
/// arguments within the given ones and the function's domain, rounding included. Ends are infinite where a result has
/// no bounds (division by an interval with zero, the logarithm of zero, overflow), and NaN where there is none. Source:
/// doc/theory/mappings.md, section 2. Guarantee: holds with a C library whose elementary functions are right to 4 ulps
/// (glibc states at most 2); tests: IntervalNumber.*.
using IntervalNumber = boost::numeric::interval<
    double, boost::numeric::interval_lib::policies<boost::numeric::interval_lib::save_state_nothing<IntervalRounding>,
                                                   boost::numeric::interval_lib::checking_base<double>>>;

}  // namespace osgAnalyticBin::core
