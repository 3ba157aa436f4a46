// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgDB/Callbacks>
#include <osgDB/Registry>

namespace osgAnalyticBin::flight {

/// A callback of the Registry that hands every read on to the one that was there before; derived classes look at what
/// is read, or change it. `Callback` is the derived class.
/// Threads: the calls come from the DatabasePager's threads.
template <class Callback>
class ReadInFront : public osgDB::ReadFileCallback {
public:
    using Result = osgDB::ReaderWriter::ReadResult;

    /// Puts a callback in front of the Registry's. Must not be called while files are read.
    [[nodiscard]] static osg::ref_ptr<Callback> install() {
        const osg::ref_ptr<Callback> callback = new Callback;
        osgDB::Registry& registry = *osgDB::Registry::instance();
        osg::ref_ptr<osgDB::ReadFileCallback>& next = static_cast<ReadInFront&>(*callback)._next;
        next = registry.getReadFileCallback();
        // a plain callback does what the Registry does by itself
        if (!next) next = new osgDB::ReadFileCallback;
        registry.setReadFileCallback(callback);
        return callback;
    }

    /// Puts the earlier callback back, if this one is still the Registry's. Must not be called while files are read.
    void uninstall() {
        osgDB::Registry& registry = *osgDB::Registry::instance();
        if (registry.getReadFileCallback() == this) registry.setReadFileCallback(_next);
    }

    Result openArchive(const std::string& fileName, osgDB::ReaderWriter::ArchiveStatus status,
                       unsigned int indexBlockSizeHint, const osgDB::Options* options) override {
        return _next->openArchive(fileName, status, indexBlockSizeHint, options);
    }
    Result readObject(const std::string& fileName, const osgDB::Options* options) override {
        return _next->readObject(fileName, options);
    }
    Result readImage(const std::string& fileName, const osgDB::Options* options) override {
        return _next->readImage(fileName, options);
    }
    Result readHeightField(const std::string& fileName, const osgDB::Options* options) override {
        return _next->readHeightField(fileName, options);
    }
    Result readNode(const std::string& fileName, const osgDB::Options* options) override {
        return _next->readNode(fileName, options);
    }
    Result readShader(const std::string& fileName, const osgDB::Options* options) override {
        return _next->readShader(fileName, options);
    }
    Result readScript(const std::string& fileName, const osgDB::Options* options) override {
        return _next->readScript(fileName, options);
    }

protected:
    ~ReadInFront() override = default;

private:
    osg::ref_ptr<osgDB::ReadFileCallback> _next;
};

}  // namespace osgAnalyticBin::flight
