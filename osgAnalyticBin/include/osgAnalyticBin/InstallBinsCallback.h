// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/InstallRequest.h>

namespace osgAnalyticBin {

/// The update callback of a database whose tiles carry stored bins: installs bins below the node at the first
/// update traversal. It is the only object of this library in such a database; OSG without the library warns about
/// it once, and draws the database with its own spheres.
/// Then it becomes an event callback of its node, so that it is saved with a scene: viewers that draw on demand draw
/// frames as long as there is an update callback.
class OSGANALYTICBIN_EXPORT InstallBinsCallback : public InstallRequest {
public:
    /// Installs bins with these options.
    explicit InstallBinsCallback(const CullOptions& options = {}) : InstallRequest(options) {}
    /// Copies the options; the copy installs bins even if the original has done so.
    InstallBinsCallback(const InstallBinsCallback& other, const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);

    /// Called by OSG's update traversal, then by its event traversals.
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

    META_Object(osgAnalyticBin, InstallBinsCallback);

protected:
    ~InstallBinsCallback() override = default;
};

}  // namespace osgAnalyticBin
