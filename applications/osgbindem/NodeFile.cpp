// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "NodeFile.h"

#include "Failure.h"
#include "ModuleFolder.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/InstallBinsCallback.h>
#include <osgAnalyticBin/PackedTerrain.h>

#include <osg/CoordinateSystemNode>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osg/Texture2D>
#include <osgDB/ObjectWrapper>
#include <osgDB/Registry>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <ostream>
#include <streambuf>
#include <unistd.h>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

osgDB::ReaderWriter& writer() {
    osgDB::ReaderWriter* found = osgDB::Registry::instance()->getReaderWriterForExtension("osgb");
    if (found == nullptr)
        throw Failure("OpenSceneGraph's plugin for .osgb is missing; install it or set OSG_LIBRARY_PATH");
    return *found;
}

/// Sums up what the arrays of meshes take, most of a file by far.
class ArrayBytes final : public osg::NodeVisitor {
public:
    ArrayBytes() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Geometry& geometry) override {
        osg::Geometry::ArrayList arrays;
        geometry.getArrayList(arrays);
        for (const auto& array : arrays) _sum += array->getTotalDataSize();
    }
    [[nodiscard]] std::size_t sum() const noexcept { return _sum; }

private:
    std::size_t _sum = 0;
};

/// What is written, without the copy that a std::ostringstream gives out: the root file alone is some megabytes. The
/// writer goes back to fill sizes in.
class ByteBuffer final : public std::streambuf {
public:
    explicit ByteBuffer(std::size_t expected) : _bytes(expected, '\0') {}

    [[nodiscard]] std::string take() {
        _bytes.resize(_end);
        return std::move(_bytes);
    }

protected:
    int_type overflow(int_type value) override {
        if (traits_type::eq_int_type(value, traits_type::eof())) return traits_type::not_eof(value);
        const char byte = traits_type::to_char_type(value);
        return xsputn(&byte, 1) == 1 ? value : traits_type::eof();
    }
    std::streamsize xsputn(const char* source, std::streamsize count) override {
        const auto size = static_cast<std::size_t>(count);
        if (_place + size > _bytes.size()) _bytes.resize(2 * (_place + size));
        char* const target = _bytes.data() + _place;
        // Arrays are written number by number: a copy of known size is no call.
        if (size == sizeof(float)) {
            std::memcpy(target, source, sizeof(float));
        } else {
            std::memcpy(target, source, size);
        }
        _place += size;
        _end = std::max(_end, _place);
        return count;
    }
    pos_type seekoff(off_type offset, std::ios_base::seekdir way, std::ios_base::openmode) override {
        const std::size_t from = way == std::ios_base::beg ? 0 : way == std::ios_base::cur ? _place : _end;
        return seekpos(static_cast<off_type>(from) + offset, std::ios_base::out);
    }
    pos_type seekpos(pos_type position, std::ios_base::openmode) override {
        const off_type place = position;
        if (place < 0 || static_cast<std::size_t>(place) > _end) return pos_type(off_type(-1));
        _place = static_cast<std::size_t>(place);
        return position;
    }

private:
    std::string _bytes;  // longer than what is written
    std::size_t _place = 0;
    std::size_t _end = 0;
};

/// A file that is open for writing, removed again unless it is kept.
class OpenFile {
public:
    explicit OpenFile(std::string path)
        : _path(std::move(path)), _handle(::open(_path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
        if (_handle < 0) fail();
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    ~OpenFile() {
        if (_handle >= 0) ::close(_handle);
        if (!_path.empty()) ::unlink(_path.c_str());
    }

    void write(const std::string& bytes) {
        for (std::size_t done = 0; done < bytes.size();) {
            const ssize_t count = ::write(_handle, bytes.data() + done, bytes.size() - done);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) fail();
            done += static_cast<std::size_t>(count);
        }
    }

    void keepAs(const std::string& path) {
        const int handle = _handle;
        _handle = -1;
        if (::close(handle) != 0 || std::rename(_path.c_str(), path.c_str()) != 0) fail();
        _path.clear();
    }

private:
    [[noreturn]] void fail() const {
        const int error = errno;
        throw Failure("cannot write \"" + _path + "\": " + std::strerror(error) +
                      "; make room or choose another folder");
    }

    std::string _path;
    int _handle;
};

}  // namespace

void prepareNodeFiles() {
    osgAnalyticBin::addModuleFolder();
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(new osg::EllipsoidModel);
    root->setUpdateCallback(new osgAnalyticBin::InstallBinsCallback);
    const char* className = "osgAnalyticBin::InstallBinsCallback";
    if (osgDB::Registry::instance()->getObjectWrapperManager()->findWrapper(className) == nullptr) {
        throw Failure(std::string("OpenSceneGraph finds no serializer for ") + className +
                      "; install this library's modules or set OSG_LIBRARY_PATH");
    }
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(new osg::Vec3Array(3));
    geometry->setNormalArray(new osg::Vec3Array(osg::Array::BIND_PER_VERTEX, 3));
    geometry->setColorArray(new osg::Vec4ubArray(osg::Array::BIND_OVERALL, 1));
    geometry->setTexCoordArray(0, new osg::Vec2Array(osg::Array::BIND_PER_VERTEX, 3));
    geometry->addPrimitiveSet(new osg::DrawElementsUShort(GL_TRIANGLES, 3));
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(1, 1, 1, GL_RGB, GL_UNSIGNED_BYTE);
    geometry->getOrCreateStateSet()->setTextureAttributeAndModes(0, new osg::Texture2D(image));
    geometry->getOrCreateStateSet()->setAttributeAndModes(new osg::Material);
    const osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform;
    transform->addChild(geometry);
    const osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
    lod->addChild(transform, 0.0F, 1.0F);
    osgAnalyticBin::setStoredBin(*lod, osgAnalyticBin::AnalyticBin());
    root->addChild(lod);
    const osg::ref_ptr<osg::Geometry> packed = new osgAnalyticBin::PackedTerrain;
    packed->addPrimitiveSet(new osg::DrawElementsUShort(GL_TRIANGLES));
    packed->setTexCoordArray(0, new osg::Vec2Array(osg::Array::BIND_PER_VERTEX));
    transform->addChild(packed);
    (void)nodeFileBytes(*root, true);
}

std::string nodeFileBytes(const osg::Node& node, bool compress) {
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    options->setPluginStringData("fileType", "Binary");
    options->setPluginStringData("WriteImageHint", "IncludeData");
    if (compress) options->setPluginStringData("Compressor", "zlib");
    ArrayBytes arrays;
    const_cast<osg::Node&>(node).accept(arrays);  // which changes nothing
    constexpr std::size_t kRest = 100000;
    ByteBuffer buffer(compress ? 0 : arrays.sum() + arrays.sum() / 8 + kRest);
    std::ostream stream(&buffer);
    const osgDB::ReaderWriter::WriteResult result = writer().writeNode(node, stream, options);
    if (!result.success() || !stream) throw Failure("OpenSceneGraph cannot store a tile: " + result.message());
    return buffer.take();
}

void writeFile(const std::string& path, const std::string& bytes) {
    OpenFile file(path + ".tmp");
    file.write(bytes);
    file.keepAs(path);
}

}  // namespace osgbindem
