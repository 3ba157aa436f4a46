// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CountedReads.h"

#include <osg/Group>
#include <osg/NodeVisitor>
#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <atomic>
#include <cstring>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace osgAnalyticBin::test {

/// Where and how often a BinInstaller went over nodes.
class InstallerVisits {
public:
    /// Returns: a number for a new node; addresses come back.
    [[nodiscard]] int newNode() { return ++_nodes; }

    void note(int node) {
        const std::lock_guard<std::mutex> lock(_mutex);
        _threads[node].push_back(std::this_thread::get_id());
    }

    /// The threads of the visits to each node; exact once they are over.
    [[nodiscard]] const std::map<int, std::vector<std::thread::id>>& threads() const { return _threads; }

private:
    std::mutex _mutex;
    std::map<int, std::vector<std::thread::id>> _threads;
    std::atomic<int> _nodes{0};
};

/// A group that notes when a BinInstaller visits it.
class InstallerProbe : public osg::Group {
public:
    explicit InstallerProbe(InstallerVisits& visits) : _visits(visits), _number(visits.newNode()) {}

    void accept(osg::NodeVisitor& visitor) override {
        if (std::strcmp(visitor.className(), "BinInstaller") == 0) _visits.note(_number);
        osg::Group::accept(visitor);
    }

private:
    InstallerVisits& _visits;
    const int _number;
};

/// Reads as OSG does, and puts a probe above what it has read.
class ProbingReader : public CountedReads {
public:
    osgDB::ReaderWriter::ReadResult readNode(const std::string& name, const osgDB::Options* options) override {
        osgDB::ReaderWriter::ReadResult result = CountedReads::readNode(name, options);
        if (!result.validNode()) return result;
        const osg::ref_ptr<InstallerProbe> probe = new InstallerProbe(visits);
        probe->addChild(result.getNode());
        const std::lock_guard<std::mutex> lock(_mutex);
        if (!_kept && keepsOne) _kept = probe;
        return keepsOne ? _kept.get() : probe.get();
    }

    bool keepsOne = false;  // hands out the same node always, as a cache of the user's would
    InstallerVisits visits;

private:
    std::mutex _mutex;
    osg::ref_ptr<InstallerProbe> _kept;
};

}  // namespace osgAnalyticBin::test
