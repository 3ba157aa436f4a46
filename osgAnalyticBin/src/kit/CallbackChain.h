// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Classes.h"

#include <osg/Callback>
#include <osg/Node>
#include <osg/NodeCallback>
#include <osg/ref_ptr>

#include <type_traits>

namespace osgAnalyticBin {

/// A callback as one of a class of node callbacks. Returns: nullptr where it is none. A dynamic_cast across OSG's
/// virtual bases takes long, and groups may have thousands of children.
template <class Wanted, class Any>
[[nodiscard]] Wanted* callbackAs(Any& callback) {
    if (isExactly<Wanted>(callback)) return static_cast<Wanted*>(callback.asNodeCallback());
    return std::is_final_v<Wanted> ? nullptr : dynamic_cast<Wanted*>(&callback);
}

/// Searches a chain of nested callbacks, const or not. Returns: the first one of the class; nullptr when there is none.
template <class Callback, class First>
[[nodiscard]] Callback* findCallback(First* first) {
    for (First* callback = first; callback; callback = callback->getNestedCallback()) {
        if (auto* found = callbackAs<Callback>(*callback)) return found;
    }
    return nullptr;
}

/// Removes a cull callback from a node. It keeps its nested callbacks while other nodes have it, too: clones of a scene
/// may share callbacks.
inline void takeOff(osg::Node& node, osg::Callback& callback) {
    if (node.getCullCallback() != &callback) return node.removeCullCallback(&callback);
    const osg::ref_ptr<osg::Callback> nested = callback.getNestedCallback();
    node.setCullCallback(nested.get());
    if (callback.referenceCount() == 1) callback.setNestedCallback(nullptr);
}

/// Removes the first cull callback of the class from a node, if it has one.
template <class Callback>
void takeOffFirst(osg::Node& node) {
    if (const osg::ref_ptr<osg::Callback> callback = findCallback<Callback>(node.getCullCallback()))
        takeOff(node, *callback);
}

/// Adds a cull callback to a node in front of those that it has.
inline void putInFront(osg::Node& node, osg::Callback& callback) {
    callback.setNestedCallback(node.getCullCallback());
    node.setCullCallback(&callback);
}

}  // namespace osgAnalyticBin
