// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/Export.h>

#include <osg/NodeCallback>

#include <string>

namespace osgAnalyticBin {

/// The update callback of a database whose tiles carry stored bins: installs bins below the node at the first
/// update traversal. It is the only object of this library in such a database; OSG without the library warns about
/// it once, and draws the database with its own spheres.
/// Then it becomes an event callback of its node, so that it is saved with a scene: viewers that draw on demand draw
/// frames as long as there is an update callback.
class OSGANALYTICBIN_EXPORT InstallBinsCallback : public osg::NodeCallback {
public:
    /// Installs bins with these options.
    explicit InstallBinsCallback(const CullOptions& options = {}) : _options(options) {}
    /// Copies the options; the copy installs bins even if the original has done so.
    InstallBinsCallback(const InstallBinsCallback& other, const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY)
        : osg::Object(other, copyop),
          osg::Callback(other, copyop),
          osg::NodeCallback(other, copyop),
          _options(other._options) {}

    /// Read at the first update traversal.
    void setCullOptions(const CullOptions& options) { _options = options; }
    /// Default: CullOptions().
    [[nodiscard]] const CullOptions& getCullOptions() const { return _options; }

    /// The options as text; what the serializer stores.
    void setOptionsText(const std::string& text) { _options = storedCullOptions(text); }
    /// toText() of the options.
    [[nodiscard]] std::string getOptionsText() const { return toText(_options); }

    /// Marks bins as installed: nothing is done from then on.
    void setDone() { _done = true; }
    /// Whether bins are installed.
    [[nodiscard]] bool isDone() const { return _done; }

    /// Called by OSG's update traversal, then by its event traversals. Defined with installBins().
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

    META_Object(osgAnalyticBin, InstallBinsCallback);

protected:
    ~InstallBinsCallback() override = default;

private:
    CullOptions _options;
    bool _done = false;
};

}  // namespace osgAnalyticBin
