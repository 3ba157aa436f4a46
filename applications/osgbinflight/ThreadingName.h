// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgViewer/ViewerBase>

#include <array>
#include <utility>

namespace osgAnalyticBin::flight {

/// OSG's threading models, by the names that OSG gives them.
inline constexpr std::array<std::pair<osgViewer::ViewerBase::ThreadingModel, const char*>, 4> kThreadingNames{
    {{osgViewer::ViewerBase::SingleThreaded, "SingleThreaded"},
     {osgViewer::ViewerBase::CullDrawThreadPerContext, "CullDrawThreadPerContext"},
     {osgViewer::ViewerBase::DrawThreadPerContext, "DrawThreadPerContext"},
     {osgViewer::ViewerBase::CullThreadPerCameraDrawThreadPerContext, "CullThreadPerCameraDrawThreadPerContext"}}};

[[nodiscard]] inline const char* threadingName(osgViewer::ViewerBase::ThreadingModel model) {
    for (const auto& [known, name] : kThreadingNames)
        if (known == model) return name;
    return "another threading model";
}

}  // namespace osgAnalyticBin::flight
