// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ProgressLine.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <fcntl.h>
#include <memory>
#include <string>
#include <unistd.h>

namespace osgAnalyticBin::support {
namespace {

struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using Stream = std::unique_ptr<std::FILE, Close>;

std::string textFrom(int handle, std::size_t most) {
    std::string text(most, '\0');
    const ssize_t count = ::read(handle, text.data(), text.size());
    text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return text;
}

TEST(ProgressLine, SaysWhatIsLeft) {
    EXPECT_EQ(timeLeft(0.5, 1.0), "");  // nobody knows yet
    EXPECT_EQ(timeLeft(0.5, 40.0), "40 s left");
    EXPECT_EQ(timeLeft(0.25, 240.0), "12 min left");
    EXPECT_EQ(timeLeft(0.1, 1234.0), "3 h 06 min left");
    EXPECT_EQ(timeLeft(1.0, 50.0), "");
}

TEST(ProgressLine, WhatWasDoneBeforeTookNoTime) {
    EXPECT_EQ(timeLeft(0.5, 40.0, 0.25), "80 s left");
    EXPECT_EQ(timeLeft(0.5, 40.0, 0.5), "");
    EXPECT_EQ(timeLeft(1.0, 40.0, 1.0), "");
}

TEST(ProgressLine, IsALineOfItsOwnInAFile) {
    const Stream file(std::tmpfile());
    ASSERT_TRUE(file);
    ProgressLine line(file.get());
    EXPECT_FALSE(line.isTerminal());
    EXPECT_FALSE(line.isDue());
    line.show(0.25, "tool: 3 files, ");
    line.show(1.1, "");
    line.finish(1.0, "tool: 12 files, ");
    std::rewind(file.get());
    EXPECT_EQ(textFrom(::fileno(file.get()), 200), "tool: 3 files, 25 %\n99 %\ntool: 12 files, 100 %, done in 1 s\n");
}

TEST(ProgressLine, IsWrittenOverOnATerminal) {
    const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
    ASSERT_TRUE(terminal >= 0 && ::grantpt(terminal) == 0 && ::unlockpt(terminal) == 0);
    const Stream stream(std::fopen(::ptsname(terminal), "w"));
    ASSERT_TRUE(stream);
    {
        ProgressLine line(stream.get());
        EXPECT_TRUE(line.isTerminal());
        line.show(0.25, "a long text, ");
        line.show(0.5, "short, ");
        EXPECT_EQ(textFrom(terminal, 200), "\ra long text, 25 %\rshort, 50 %      ");
    }
    EXPECT_EQ(textFrom(terminal, 200), "\r           \r") << "not erased";
    {
        ProgressLine line(stream.get());
        line.show(0.5, "short, ");
        line.finish(1.0, "");
    }
    EXPECT_EQ(textFrom(terminal, 200), "\rshort, 50 %\r100 %, done in 1 s\r\n");
    ::close(terminal);
}

}  // namespace
}  // namespace osgAnalyticBin::support
