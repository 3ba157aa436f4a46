// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The file of an index, as it is and with a checksum that fits: what is read can be written and read again.

#include "Fuzz.h"

#include <osgAnalyticBin/BinIndex.h>

#include <index/Checksum.h>
#include <sstream>

using namespace osgAnalyticBin;

namespace {

void tryIndex(const std::string& bytes) {
    std::istringstream in(bytes);
    std::string error;
    const osg::ref_ptr<BinIndex> index = BinIndex::read(in, error);
    test::require(index.valid() == error.empty());
    if (!index) return;
    std::ostringstream out;
    test::require(index->write(out));
    std::istringstream back(out.str());
    const osg::ref_ptr<BinIndex> again = BinIndex::read(back, error);
    test::require(again && again->tileCount() == index->tileCount() && again->fileCount() == index->fileCount());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string bytes(reinterpret_cast<const char*>(data), size);
    tryIndex(bytes);
    if (size < 4) return 0;
    const std::uint32_t checksum = indexing::crc32(std::string_view(bytes).substr(0, size - 4));
    for (std::size_t i = 0; i < 4; ++i) bytes[size - 4 + i] = static_cast<char>(checksum >> (8 * i));
    tryIndex(bytes);
    return 0;
}
