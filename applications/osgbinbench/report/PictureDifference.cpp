// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PictureDifference.h"

#include <osgDB/ReadFile>

#include <cstddef>
#include <cstring>

namespace osgAnalyticBin::report {

namespace {

// The grey copy leaves a third of the brightness, so that red stands out.
constexpr int kDimming = 3;

std::string sizeOf(const osg::Image& image) {
    return std::to_string(image.s()) + "x" + std::to_string(image.t());
}

osg::ref_ptr<osg::Image> read(const std::string& file, std::string& error) {
    osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(file);
    if (!image) error = file + ": cannot be read as a picture";
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

std::optional<PictureDifference> compareFiles(const std::string& first, const std::string& second, std::string& error) {
    const osg::ref_ptr<osg::Image> a = read(first, error);
    const osg::ref_ptr<osg::Image> b = a ? read(second, error) : nullptr;
    if (!b) return std::nullopt;
    auto difference = compare(*a, *b, error);
    if (!difference) error = first + ", " + second + ": " + error;
    return difference;
}

std::optional<PictureDifference> compare(const osg::Image& first, const osg::Image& second, std::string& error) {
    if (first.s() != second.s() || first.t() != second.t()) {
        error = "sizes differ: " + sizeOf(first) + " and " + sizeOf(second);
        return std::nullopt;
    }
    if (first.getPixelFormat() != second.getPixelFormat() || first.getDataType() != GL_UNSIGNED_BYTE ||
        second.getDataType() != GL_UNSIGNED_BYTE) {
        error = "formats differ, or are not 8 bits per channel";
        return std::nullopt;
    }
    PictureDifference difference;
    difference.picture = new osg::Image;
    difference.picture->allocateImage(first.s(), first.t(), 1, GL_RGB, GL_UNSIGNED_BYTE);
    const std::size_t channels = first.getPixelSizeInBits() / 8u;
    for (int row = 0; row < first.t(); ++row) {
        for (int column = 0; column < first.s(); ++column) {
            const unsigned char* const a =
                first.data(static_cast<unsigned int>(column), static_cast<unsigned int>(row));
            const unsigned char* const b =
                second.data(static_cast<unsigned int>(column), static_cast<unsigned int>(row));
            const bool differs = std::memcmp(a, b, channels) != 0;
            if (differs) ++difference.pixels;
            paint(difference.picture->data(static_cast<unsigned int>(column), static_cast<unsigned int>(row)), a,
                  channels, differs);
        }
    }
    return difference;
}

}  // namespace osgAnalyticBin::report
