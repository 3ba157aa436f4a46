// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

namespace osgAnalyticBin {

/// Sets a member for the length of a scope.
template <class T>
class Scoped {
public:
    Scoped(T& member, const T& value) : _member(member), _outer(member) { _member = value; }
    ~Scoped() { _member = _outer; }
    Scoped(const Scoped&) = delete;
    Scoped& operator=(const Scoped&) = delete;

private:
    T& _member;
    const T _outer;
};

}  // namespace osgAnalyticBin
