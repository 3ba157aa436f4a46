// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PhotogrammetryMetadata.h"

#include <osg/ref_ptr>
#include <osgDB/FileNameUtils>
#include <osgDB/XmlParser>

#include <cmath>
#include <fstream>
#include <locale>
#include <sstream>

namespace osgAnalyticBin::plugin {

namespace {

const osgDB::XmlNode* childOf(const osgDB::XmlNode& node, const std::string& name) {
    for (const auto& child : node.children) {
        if (child->name == name) return child.get();
    }
    return nullptr;
}

std::string textIn(const osgDB::XmlNode& node, const std::string& name) {
    const osgDB::XmlNode* const child = childOf(node, name);
    return child ? child->getTrimmedContents() : std::string();
}

osg::ref_ptr<osgDB::XmlNode> parsed(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return in ? osgDB::readXmlStream(in) : nullptr;
}

}  // namespace

std::optional<osg::Vec3d> numbersFrom(const std::string& text, int count) {
    std::istringstream in(text);
    in.imbue(std::locale::classic());
    osg::Vec3d numbers;
    for (int i = 0; i < count; ++i) {
        char comma = ',';
        if (i > 0) in >> comma;
        in >> numbers[i];
        if (!in || comma != ',' || !std::isfinite(numbers[i])) return std::nullopt;
    }
    return (in >> std::ws).eof() ? std::optional(numbers) : std::nullopt;
}

bool isPhotogrammetryMetadata(const std::string& path) {
    if (osgDB::getLowerCaseFileExtension(path) != "xml") return false;
    if (osgDB::convertToLowerCase(osgDB::getSimpleFileName(path)) == "metadata.xml") return true;
    const osg::ref_ptr<osgDB::XmlNode> root = parsed(path);
    return root && childOf(*root, "ModelMetadata");
}

std::optional<PhotogrammetryMetadata> readPhotogrammetryMetadata(const std::string& path, std::string& error) {
    const osg::ref_ptr<osgDB::XmlNode> root = parsed(path);
    const osgDB::XmlNode* const model = root ? childOf(*root, "ModelMetadata") : nullptr;
    if (!model) {
        error = "\"" + path + "\" is not the metadata of a photogrammetry set: it has no element ModelMetadata";
        return std::nullopt;
    }
    PhotogrammetryMetadata metadata;
    metadata.srs = textIn(*model, "SRS");
    const std::string origin = textIn(*model, "SRSOrigin");
    if (origin.empty()) return metadata;
    const auto numbers = numbersFrom(origin, 3);
    if (!numbers) {
        error = "\"" + path + "\": SRSOrigin is \"" + origin + "\"; three numbers with commas between are expected";
        return std::nullopt;
    }
    metadata.origin = *numbers;
    return metadata;
}

}  // namespace osgAnalyticBin::plugin
