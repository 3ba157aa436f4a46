// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace osgAnalyticBin::support {

/// The command line of a program, with --help and --version: one file includes CLI11, which takes long to compile.
/// Names begin with "--", or are those of words without an option, such as "DATABASE". Values keep what they hold
/// unless their option is given.
class CommandLine final {
public:
    /// `program`: with its command, as "osgbinbench report". `footer`: what stands below the options in the help.
    CommandLine(const std::string& program, const std::string& description, const std::string& footer);
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    void add(const char* name, bool& isGiven, const std::string& help);
    void add(const char* name, std::string& value, const std::string& help);
    void add(const char* name, int& value, int lowest, int highest, const std::string& help);
    void add(const char* name, double& value, double lowest, double highest, const std::string& help);

    /// Values parted by commas.
    void addList(const char* name, std::vector<std::string>& values, const std::string& help);
    void addList(const char* name, std::vector<int>& values, int lowest, int highest, const std::string& help);

    /// An option that may be given several times, or all words without an option.
    void addAll(const char* name, std::vector<std::string>& values, const std::string& help);
    /// An option that takes two words.
    void addPair(const char* name, std::vector<std::string>& values, const std::string& help);

    /// Returns: whether there is something to do: --help and --version are answered at once. Throws: UsageError.
    [[nodiscard]] bool parse(int argc, const char* const* argv);

private:
    std::unique_ptr<CLI::App> _app;
};

}  // namespace osgAnalyticBin::support
