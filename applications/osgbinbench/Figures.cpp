// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Figures.h"

namespace osgAnalyticBin::bench {

Figures& Figures::operator+=(const Figures& other) {
    for (const CountColumn& column : kCountColumns) this->*column.count += other.*column.count;
    for (const TimeColumn& column : kTimeColumns) this->*column.ms += other.*column.ms;
    return *this;
}

Figures sumOf(const MethodFigures& method, const PathGroup& group) {
    Figures sum;
    for (const std::size_t pose : group.poses) sum += method.poses[pose];
    return sum;
}

Figures MethodFigures::sum() const {
    Figures sum;
    for (const Figures& pose : poses) sum += pose;
    return sum;
}

}  // namespace osgAnalyticBin::bench
