// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using osgAnalyticBin::test::textOfFile;

namespace {

[[noreturn]] void becomeProgram(std::vector<char*>& arguments, const std::string& errors, const std::string& output,
                                unsigned long fileSizeLimit) {
    dup2(open(errors.c_str(), O_WRONLY | O_CREAT, 0600), 2);
    dup2(open(output.c_str(), O_WRONLY | O_CREAT, 0600), 1);
    if (fileSizeLimit > 0) {
        const rlimit limit{fileSizeLimit, fileSizeLimit};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    execv(arguments.front(), arguments.data());
    _exit(127);
}

}  // namespace

std::vector<std::string> TempFolder::names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path())) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}

Program::Program(const std::vector<std::string>& arguments, unsigned long fileSizeLimit) {
    std::vector<std::string> words{OSGBINDEM_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const std::string errors = _folder.file("errors");
    const std::string output = _folder.file("output");
    _process = fork();
    if (_process == 0) becomeProgram(pointers, errors, output, fileSizeLimit);
}

Program::~Program() {
    if (_isOver) return;
    kill(_process, SIGKILL);
    waitpid(_process, nullptr, 0);
}

void Program::interrupt() const {
    kill(_process, SIGINT);
}

bool Program::isRunning() {
    if (!_isOver && waitpid(_process, &_status, WNOHANG) == _process) _isOver = true;
    return !_isOver;
}

Outcome Program::wait() {
    if (!_isOver) waitpid(_process, &_status, 0);
    _isOver = true;
    return {WIFEXITED(_status) ? WEXITSTATUS(_status) : -1, textOfFile(_folder.file("errors")),
            textOfFile(_folder.file("output"))};
}

Outcome run(const std::vector<std::string>& arguments, unsigned long fileSizeLimit) {
    return Program(arguments, fileSizeLimit).wait();
}

void build(const std::vector<std::string>& arguments) {
    std::vector<std::string> words = arguments;
    words.push_back("--quiet");
    const Outcome outcome = run(words);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    ASSERT_EQ(outcome.errors, "");
    ASSERT_EQ(outcome.output, "");
}
