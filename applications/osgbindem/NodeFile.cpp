// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "NodeFile.h"

#include "Failure.h"
#include "ModuleFolder.h"
#include "PackedTerrain.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/InstallBinsCallback.h>

#include <osg/CoordinateSystemNode>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osg/Texture2D>
#include <osgDB/ObjectWrapper>
#include <osgDB/Registry>

#include <sstream>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

osgDB::ReaderWriter& writer() {
    osgDB::ReaderWriter* found = osgDB::Registry::instance()->getReaderWriterForExtension("osgb");
    if (found == nullptr)
        throw Failure("OpenSceneGraph's plugin for .osgb is missing; install it or set OSG_LIBRARY_PATH");
    return *found;
}

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
    std::ostringstream stream;
    const osgDB::ReaderWriter::WriteResult result = writer().writeNode(node, stream, options);
    if (!result.success() || !stream) throw Failure("OpenSceneGraph cannot store a tile: " + result.message());
    return stream.str();
}

}  // namespace osgbindem
