// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Shows the thread sanitizer that the counter of references puts the deletion of an object after its releases. Counters
// are in inline functions: their changes are seen in the kit, and not in OSG's own code, which is not instrumented and
// often makes the last release. The program's symbol takes the place of the library's, in all libraries.

#if defined(__SANITIZE_THREAD__) && defined(__linux__)

#include <osg/Referenced>

#include <cstdlib>
#include <dlfcn.h>

__attribute__((visibility("default"))) void osg::Referenced::signalObserversAndDelete(bool signals,
                                                                                      bool deletes) const {
    using Original = void (*)(const osg::Referenced*, bool, bool);
    static const auto original =
        reinterpret_cast<Original>(dlsym(RTLD_NEXT, "_ZNK3osg10Referenced24signalObserversAndDeleteEbb"));
    if (!original) std::abort();
    // changes nothing, and comes after each release that was seen
    (void)_refCount.OR(0);
    original(this, signals, deletes);
}

#endif
