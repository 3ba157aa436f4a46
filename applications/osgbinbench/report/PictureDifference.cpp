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

// The grey copy leaves a third of the brightness, so that red stands out.
constexpr int kDimming = 3;

std::string sizeOf(const osg::Image& image) {
    return std::to_string(image.s()) + "x" + std::to_string(image.t());
}

osg::ref_ptr<osg::Image> read(const std::string& file) {
    osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(file);
    if (!image) throw Failure(file + ": cannot be read as a picture");
    return image;
}

void paint(unsigned char* target, const unsigned char* source, std::size_t channels, bool differs) {
    int sum = 0;
    for (std::size_t i = 0; i < channels; ++i) sum += source[i];
    const int grey = sum / static_cast<int>(channels) / kDimming;
    target[0] = static_cast<unsigned char>(differs ? 255 : grey);
    target[1] = target[2] = static_cast<unsigned char>(differs ? 0 : grey);
}

}  // namespace

PictureDifference compareFiles(const std::string& first, const std::string& second) {
    const osg::ref_ptr<osg::Image> a = read(first), b = read(second);
    try {
        return compare(*a, *b);
    } catch (const Failure& failure) {
        throw Failure(first + ", " + second + ": " + failure.what());
    }
}

PictureDifference compare(const osg::Image& first, const osg::Image& second) {
    if (first.s() != second.s() || first.t() != second.t())
        throw Failure("sizes differ: " + sizeOf(first) + " and " + sizeOf(second));
    if (first.getPixelFormat() != second.getPixelFormat() || first.getDataType() != GL_UNSIGNED_BYTE ||
        second.getDataType() != GL_UNSIGNED_BYTE)
        throw Failure("formats differ, or are not 8 bits per channel");
    PictureDifference difference;
    difference.picture = new osg::Image;
    difference.picture->allocateImage(first.s(), first.t(), 1, GL_RGB, GL_UNSIGNED_BYTE);
    const std::size_t channels = first.getPixelSizeInBits() / 8u;
    for (unsigned int row = 0; row < static_cast<unsigned int>(first.t()); ++row) {
        for (unsigned int column = 0; column < static_cast<unsigned int>(first.s()); ++column) {
            const unsigned char* const a = first.data(column, row);
            const bool differs = std::memcmp(a, second.data(column, row), channels) != 0;
            if (differs) ++difference.pixels;
            paint(difference.picture->data(column, row), a, channels, differs);
        }
    }
    return difference;
}

}  // namespace osgAnalyticBin::report
