// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// States that an application may set: attributes and modes of all kinds that OpenSceneGraph has, harmless ones too.

#pragma once

#include "Includes.h"

namespace osgAnalyticBin::test {

/// They have the numbers from 0 on.
[[nodiscard]] int stateCount();
[[nodiscard]] std::string stateName(int number);
/// Returns: the number of a name that is there.
[[nodiscard]] int stateOf(const std::string& name);

/// Sets attribute and modes of a state. `value`: of each; OFF sets attributes all the same, and switches modes off.
void setState(int number, osg::StateAttribute::GLModeValue value, osg::StateSet& states);

/// Whether a picture shows the same drawables in the same places whatever these states are.
[[nodiscard]] bool isHarmless(const osg::StateSet& states);

}  // namespace osgAnalyticBin::test
