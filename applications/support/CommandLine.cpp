// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CommandLine.h"

#include "Failure.h"
#include "NumberRange.h"
#include "ProgramRun.h"

#include <osgAnalyticBin/Version.h>

namespace osgAnalyticBin::support {

bool parseCommandLine(CLI::App& app, int argc, const char* const* argv) {
    try {
        app.parse(argc, argv);
        return true;
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0)
            throw UsageError(std::string(error.what()) + "; see " + app.get_name() + " --help");
        (void)app.exit(error);
        return false;
    }
}

CommandLine::CommandLine(const std::string& program, const std::string& description, const std::string& footer)
    : _app(std::make_unique<CLI::App>(description, program)) {
    _app->set_version_flag("--version", program + " (osgAnalyticBin) " + version());
    _app->footer(footer);
}

CommandLine::~CommandLine() = default;

void CommandLine::add(const char* name, bool& isGiven, const std::string& help) {
    _app->add_flag(name, isGiven, help);
}

void CommandLine::add(const char* name, std::string& value, const std::string& help) {
    _app->add_option(name, value, help);
}

void CommandLine::add(const char* name, int& value, int lowest, int highest, const std::string& help) {
    _app->add_option(name, value, help)->check(CLI::Range(lowest, highest));
}

void CommandLine::add(const char* name, double& value, double lowest, double highest, const std::string& help) {
    _app->add_option(name, value, help)->check(within(lowest, highest));
}

void CommandLine::addList(const char* name, std::vector<std::string>& values, const std::string& help) {
    _app->add_option(name, values, help)->delimiter(',')->allow_extra_args(false);
}

void CommandLine::addList(const char* name, std::vector<int>& values, int lowest, int highest,
                          const std::string& help) {
    _app->add_option(name, values, help)->delimiter(',')->allow_extra_args(false)->check(CLI::Range(lowest, highest));
}

void CommandLine::addAll(const char* name, std::vector<std::string>& values, const std::string& help) {
    _app->add_option(name, values, help)->allow_extra_args(*name != '-');
}

void CommandLine::addPair(const char* name, std::vector<std::string>& values, const std::string& help) {
    _app->add_option(name, values, help)->type_name("OLD NEW")->expected(2);
}

bool CommandLine::parse(int argc, const char* const* argv) {
    return parseCommandLine(*_app, argc, argv);
}

}  // namespace osgAnalyticBin::support
