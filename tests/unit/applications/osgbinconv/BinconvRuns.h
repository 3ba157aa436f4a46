// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Runs of osgbinconv, and what is expected of them.

#pragma once

#include <osgAnalyticBin/BinIndex.h>

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <support/StockPrograms.h>

namespace osgAnalyticBin::test {

inline Outcome runBinconv(const std::string& arguments, const std::string& before = {}) {
    return runStock(before + test::quoted(OSGBINCONV_PROGRAM) + ' ' + arguments, Modules::Present);
}

/// --index on a root file.
inline Outcome runIndex(const std::string& rootFile, const std::string& before = {}) {
    return runBinconv("--quiet --index " + test::quoted(rootFile), before);
}

/// The index beside a root file; an empty one where there is none.
inline osg::ref_ptr<BinIndex> indexOf(const std::string& rootFile) {
    std::string error;
    const osg::ref_ptr<BinIndex> index = readBinIndex(rootFile, nullptr, error);
    EXPECT_TRUE(index) << error;
    return index ? index : osg::ref_ptr<BinIndex>(new BinIndex);
}

inline std::string bytesOf(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline void writeBytes(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

inline void expectOneLine(const Outcome& outcome, const std::string& what) {
    EXPECT_EQ(outcome.text.rfind("osgbinconv: ", 0), 0u) << outcome.text;
    EXPECT_NE(outcome.text.find(what), std::string::npos) << outcome.text;
    EXPECT_EQ(outcome.text.find('\n'), outcome.text.size() - 1) << outcome.text;
}

inline void expectFailure(const Outcome& outcome, const std::string& what) {
    EXPECT_EQ(outcome.code, 1);
    expectOneLine(outcome, what);
}

inline void expectUsageError(const Outcome& outcome, const std::string& what) {
    EXPECT_EQ(outcome.code, 2);
    expectOneLine(outcome, what);
}

}  // namespace osgAnalyticBin::test
