// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "KitTest.h"

namespace osgAnalyticBin::test {

/// Reads as OSG does, in any thread, and counts how often it is asked for each name.
struct CountedReads : osgDB::ReadFileCallback {
    osgDB::ReaderWriter::ReadResult readNode(const std::string& name, const osgDB::Options* options) override {
        count(name);
        return osgDB::Registry::instance()->readNodeImplementation(name, options);
    }

    osgDB::ReaderWriter::ReadResult readObject(const std::string& name, const osgDB::Options* options) override {
        count(name);
        return osgDB::Registry::instance()->readObjectImplementation(name, options);
    }

    [[nodiscard]] std::map<std::string, int> counts() const {
        const std::lock_guard<std::mutex> lock(_mutex);
        return _counts;
    }

    [[nodiscard]] int total() const {
        int sum = 0;
        for (const auto& [name, count] : counts()) sum += count;
        return sum;
    }

    /// Of one name.
    [[nodiscard]] int most() const {
        int most = 0;
        for (const auto& [name, count] : counts()) most = std::max(most, count);
        return most;
    }

private:
    void count(const std::string& name) {
        const std::lock_guard<std::mutex> lock(_mutex);
        ++_counts[name];
    }

    mutable std::mutex _mutex;
    std::map<std::string, int> _counts;
};

}  // namespace osgAnalyticBin::test
