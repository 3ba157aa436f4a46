// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Notify>

#include <algorithm>
#include <mutex>
#include <numeric>
#include <string>
#include <vector>

namespace osgAnalyticBin::test {

/// Keeps what OSG and the kit say during its life, instead of printing it.
class CapturedNotes {
public:
    explicit CapturedNotes(osg::NotifySeverity level = osg::WARN)
        : _handler(new Handler), _before(osg::getNotifyHandler()), _levelBefore(osg::getNotifyLevel()) {
        osg::setNotifyHandler(_handler);
        osg::setNotifyLevel(level);
    }
    ~CapturedNotes() {
        osg::setNotifyHandler(_before);
        osg::setNotifyLevel(_levelBefore);
    }
    CapturedNotes(const CapturedNotes&) = delete;
    CapturedNotes& operator=(const CapturedNotes&) = delete;

    /// Number of the kit's or the plugin's messages that hold the text.
    [[nodiscard]] std::size_t count(const std::string& text) const {
        const std::lock_guard<std::mutex> lock(_handler->mutex);
        return static_cast<std::size_t>(
            std::count_if(_handler->notes.begin(), _handler->notes.end(), [&](const std::string& note) {
                const bool isOurs = note.find("osgAnalyticBin") != std::string::npos || note.find("analyticbin:") == 0;
                return isOurs && note.find(text) != std::string::npos;
            }));
    }

    /// All messages.
    [[nodiscard]] std::string text() const {
        const std::lock_guard<std::mutex> lock(_handler->mutex);
        return std::accumulate(_handler->notes.begin(), _handler->notes.end(), std::string());
    }

private:
    struct Handler : public osg::NotifyHandler {
        void notify(osg::NotifySeverity, const char* message) override {
            const std::lock_guard<std::mutex> lock(mutex);
            notes.emplace_back(message);
        }
        std::mutex mutex;
        std::vector<std::string> notes;
    };

    const osg::ref_ptr<Handler> _handler;
    const osg::ref_ptr<osg::NotifyHandler> _before;
    const osg::NotifySeverity _levelBefore;
};

}  // namespace osgAnalyticBin::test
