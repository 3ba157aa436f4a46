// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What class an object is of, classes derived from it left aside.

#pragma once

#include <typeinfo>

namespace osgAnalyticBin {

/// Whether an object is of this class, and not of one derived from it. By address: comparing names takes longer.
template <class Class, class Object>
[[nodiscard]] bool isExactly(const Object& object) {
    return &typeid(object) == &typeid(Class);
}

/// Whether an object is of one of these classes, and not of one derived from it, whatever library it was made in. By
/// address first, then by name.
template <class... Classes, class Object>
[[nodiscard]] bool isOneOf(const Object& object) {
    const std::type_info& type = typeid(object);
    return (isExactly<Classes>(object) || ...) || ((type == typeid(Classes)) || ...);
}

}  // namespace osgAnalyticBin
