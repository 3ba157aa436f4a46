// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace osgAnalyticBin::core {

/// A box in the three parameters of a mapping.
struct ParameterBox {
    /// In the mapping's own parameters and units.
    glm::dvec3 center{0.0};
    /// Half the widths, 0 or more.
    glm::dvec3 halfSize{0.0};
};

/// The second partial derivatives of a mapping, a vector each; u, v, w are its three parameters.
struct Hessians {
    /// @{
    /// By the two parameters that each is named for.
    glm::dvec3 uu{0.0}, vv{0.0}, ww{0.0}, uv{0.0}, uw{0.0}, vw{0.0};
    /// @}
};

/// A three times differentiable mapping of a parameter box into space: what a bin is a box *of*.
/// Source: [JJ] eq. (1).
class AnalyticMapping {
public:
    virtual ~AnalyticMapping() = default;

    /// The mapped point, in metres.
    [[nodiscard]] virtual glm::dvec3 value(const glm::dvec3& parameters) const noexcept = 0;

    /// Column i is the derivative by parameter i.
    [[nodiscard]] virtual glm::dmat3 jacobian(const glm::dvec3& parameters) const noexcept = 0;

    /// The second derivatives at the parameters.
    [[nodiscard]] virtual Hessians hessians(const glm::dvec3& parameters) const noexcept = 0;

    /// An upper bound of the distance between mapped points of the box and the second-order model about its middle: a
    /// sixth of the longest third differential D3f(x)[e, e, e] over all x in the box and all steps |e_i| <= halfSize_i.
    /// Source: doc/theory/derivation.md, section 3.
    [[nodiscard]] virtual double remainder(const ParameterBox& box) const noexcept = 0;

    /// An upper bound of the magnitudes of all terms that value and derivatives times half sizes are sums of, at the
    /// middle of the box: what their rounding is in proportion to where the terms cancel. The default stands for a
    /// mapping whose terms do not cancel, or whose remainder() covers the rounding by itself.
    /// Source: doc/theory/derivation.md, section 7.
    [[nodiscard]] virtual double termMagnitude(const ParameterBox& /*box*/) const noexcept { return 0.0; }

protected:
    /// For derived classes alone, as are copies.
    AnalyticMapping() = default;
    /// Not through the base.
    AnalyticMapping(const AnalyticMapping&) = default;
    /// Not through the base.
    AnalyticMapping& operator=(const AnalyticMapping&) = default;
};

}  // namespace osgAnalyticBin::core
