// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/Export.h>

#include <osg/NodeCallback>

#include <string>

namespace osgAnalyticBin {

/// The options that a database wants bins to be installed with; see InstallBinsCallback.
class OSGANALYTICBIN_EXPORT InstallRequest : public osg::NodeCallback {
public:
    /// To be installed with these options.
    explicit InstallRequest(const CullOptions& options) : _options(options) {}
    /// Copies the options; what it asks for is still to be done, even if it was for the original.
    InstallRequest(const InstallRequest& other, const osg::CopyOp& copyop);

    /// Read at the first update traversal.
    void setCullOptions(const CullOptions& options) { _options = options; }
    /// Default: CullOptions().
    [[nodiscard]] const CullOptions& getCullOptions() const { return _options; }

    /// The options as text; what the serializer stores.
    void setOptionsText(const std::string& text);
    /// toText() of the options.
    [[nodiscard]] std::string getOptionsText() const;

    /// Marks bins as installed: nothing is done from then on.
    void setDone() { _done = true; }
    /// Whether bins are installed.
    [[nodiscard]] bool isDone() const { return _done; }

protected:
    ~InstallRequest() override = default;

private:
    CullOptions _options;
    bool _done = false;
};

}  // namespace osgAnalyticBin
