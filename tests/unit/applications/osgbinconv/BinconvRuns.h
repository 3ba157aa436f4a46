// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Runs of osgbinconv, and what is expected of them.

#pragma once

#include <osgAnalyticBin/BinIndex.h>

#include <gtest/gtest.h>

#include <string>
#include <support/FailureText.h>
#include <support/StockPrograms.h>
#include <vector>

namespace osgAnalyticBin::test {

/// For two minutes at most: what hangs ends with 124.
inline Outcome runBinconv(std::vector<std::string> words) {
    words.insert(words.begin(), OSGBINCONV_PROGRAM);
    return runStock("timeout 120 " + quoted(words), Modules::Present);
}

/// --index on a root file.
inline Outcome runIndex(const std::string& rootFile) {
    return runBinconv({"--quiet", "--index", rootFile});
}

/// `option`: of those without a value.
inline Outcome runCopy(const std::string& from, const std::string& to, const std::string& option = "--quiet") {
    return runBinconv({"--quiet", option, from, to});
}

/// The index beside a root file; an empty one where there is none.
inline osg::ref_ptr<BinIndex> indexOf(const std::string& rootFile) {
    std::string error;
    const osg::ref_ptr<BinIndex> index = readBinIndex(rootFile, nullptr, error);
    EXPECT_TRUE(index) << error;
    return index ? index : osg::ref_ptr<BinIndex>(new BinIndex);
}

inline void expectFailure(const Outcome& outcome, const std::string& what, int code = 1) {
    expectOneLine(outcome, "osgbinconv", what, code);
}

inline void expectSuccess(const Outcome& outcome) {
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.text, "");
}

}  // namespace osgAnalyticBin::test
