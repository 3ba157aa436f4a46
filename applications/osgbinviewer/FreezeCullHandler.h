// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "KeyHandler.h"

namespace osgAnalyticBin::viewer {

/// Key `F`: freezes the culling of a view's cameras, while the view can still be moved. The tiles that were in view
/// stay drawn, with the frustum as lines and translucent sides down to the globe. `F` again: back to normal. One
/// handler for each view.
class FreezeCullHandler : public KeyHandler {
public:
    FreezeCullHandler();

    /// Whether culling is frozen.
    [[nodiscard]] bool isFrozen() const { return _isFrozen; }

    /// Freezes or thaws the view's cameras, as the key does. Between frames only.
    void setFrozen(osgViewer::View& view, bool frozen);

protected:
    ~FreezeCullHandler() override;

private:
    bool _isFrozen = false;
};

}  // namespace osgAnalyticBin::viewer
