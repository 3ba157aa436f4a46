// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

namespace osgAnalyticBin {

/// Holds one object for each thread: `thread_local PerThread<T> name`. With MinGW the object is never destroyed,
/// because GCC frees the memory of thread_local objects there before it calls their destructors (GCC's bug 80816).
#if defined(__MINGW32__)
template <class T>
class PerThread final {
public:
    T& operator*() {
        if (!_object) _object = new T;
        return *_object;
    }

private:
    T* _object = nullptr;
};
#else
template <class T>
class PerThread final {
public:
    T& operator*() noexcept { return _object; }

private:
    T _object{};
};
#endif

}  // namespace osgAnalyticBin
