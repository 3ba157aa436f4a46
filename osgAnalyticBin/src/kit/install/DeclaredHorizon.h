// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../CallbackChain.h"

#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/InstallBinsCallback.h>

#include <osg/Node>
#include <osg/ref_ptr>

namespace osgAnalyticBin {

/// For a node and what is below it: marks a database's own request to install bins as done, and uses the horizon that
/// it declares where the installer's options give none. It uses little stack, for scenes that are nested deep.
class DeclaredHorizon {
public:
    DeclaredHorizon(osg::Node& node, CullOptions& options)
        : _options(options), _outerUse(options.horizonUse), _outer(options.horizon) {
        for (osg::Callback* const first : {node.getUpdateCallback(), node.getEventCallback()}) {
            const osg::ref_ptr<InstallBinsCallback> request = findCallback<InstallBinsCallback>(first);
            if (request) use(*request);
        }
    }
    ~DeclaredHorizon() {
        _options.horizonUse = _outerUse;
        _options.horizon = _outer;
    }
    DeclaredHorizon(const DeclaredHorizon&) = delete;
    DeclaredHorizon& operator=(const DeclaredHorizon&) = delete;

private:
    void use(InstallBinsCallback& request) {
        const CullOptions& declared = request.getCullOptions();
        if (_options.horizonUse == HorizonUse::Declared && declared.horizonUse == HorizonUse::Given) {
            _options.horizonUse = HorizonUse::Given;
            _options.horizon = declared.horizon;
        }
        request.setDone();
    }

    CullOptions& _options;
    const HorizonUse _outerUse;
    const double _outer;
};

}  // namespace osgAnalyticBin
