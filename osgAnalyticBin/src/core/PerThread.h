// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

namespace osgAnalyticBin {

/// Holds one object for each thread: `thread_local PerThread<T> name`. The object is behind a pointer: shared libraries
/// ask for the address of what is thread_local itself at each use. With MinGW it is never destroyed, because GCC frees
/// the memory of thread_local objects there before it calls their destructors (GCC's bug 80816).
template <class T>
class PerThread final {
public:
    PerThread() = default;
    PerThread(const PerThread&) = delete;
    PerThread& operator=(const PerThread&) = delete;
    ~PerThread() {
#if !defined(__MINGW32__)
        delete _object;
#endif
    }

    T& operator*() {
        if (!_object) _object = new T{};
        return *_object;
    }

private:
    T* _object = nullptr;
};

}  // namespace osgAnalyticBin
