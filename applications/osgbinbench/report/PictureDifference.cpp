// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PictureDifference.h"

#include "Failure.h"

#include <osgDB/ReadFile>

#include <cstddef>
#include <cstring>

namespace osgAnalyticBin::report {

using support::Failure;

namespace {

std::string sizeOf(const osg::Image& image) {
    return std::to_string(image.s()) + "x" + std::to_string(image.t());
}

osg::ref_ptr<osg::Image> read(const std::string& file) {
    osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(file);
    if (!image) throw Failure(file + ": cannot be read as a picture");
    return image;
}

}  // namespace

std::uint64_t differingPixels(const std::string& first, const std::string& second) {
    const osg::ref_ptr<osg::Image> a = read(first), b = read(second);
    try {
        return differingPixels(*a, *b);
    } catch (const Failure& failure) {
        throw Failure(first + ", " + second + ": " + failure.what());
    }
}

std::uint64_t differingPixels(const osg::Image& first, const osg::Image& second) {
    if (first.s() != second.s() || first.t() != second.t())
        throw Failure("sizes differ: " + sizeOf(first) + " and " + sizeOf(second));
    if (first.getPixelFormat() != second.getPixelFormat() || first.getDataType() != GL_UNSIGNED_BYTE ||
        second.getDataType() != GL_UNSIGNED_BYTE)
        throw Failure("formats differ, or are not 8 bits per channel");
    const std::size_t channels = first.getPixelSizeInBits() / 8u;
    std::uint64_t pixels = 0;
    for (unsigned int row = 0; row < static_cast<unsigned int>(first.t()); ++row)
        for (unsigned int column = 0; column < static_cast<unsigned int>(first.s()); ++column)
            pixels += std::memcmp(first.data(column, row), second.data(column, row), channels) != 0;
    return pixels;
}

}  // namespace osgAnalyticBin::report
