// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string>
#include <support/TemporaryFolder.h>
#include <sys/types.h>
#include <vector>

/// A folder that is removed with everything in it.
class TempFolder : public osgAnalyticBin::test::TemporaryFolder {
public:
    [[nodiscard]] std::string file(const std::string& name) const { return *this / name; }
    /// Names of everything directly in the folder, sorted.
    [[nodiscard]] std::vector<std::string> names() const;
};

struct Outcome {
    int exitCode = -1;
    std::string errors;
    std::string output;
};

/// A running osgbindem.
class Program {
public:
    /// A file-size limit of 0 bytes is none.
    explicit Program(const std::vector<std::string>& arguments, unsigned long fileSizeLimit = 0);
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;
    ~Program();

    void interrupt() const;
    [[nodiscard]] bool isRunning();
    [[nodiscard]] Outcome wait();

private:
    pid_t _process = -1;
    bool _isOver = false;
    int _status = 0;
    TempFolder _folder;
};

/// Runs osgbindem to its end.
[[nodiscard]] Outcome run(const std::vector<std::string>& arguments, unsigned long fileSizeLimit = 0);

/// Runs osgbindem, which has to succeed in silence.
void build(const std::vector<std::string>& arguments);

using osgAnalyticBin::test::Files;
using osgAnalyticBin::test::filesBelow;
