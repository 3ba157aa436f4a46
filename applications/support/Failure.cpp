// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Failure.h"

#include <exception>
#include <iostream>
#include <new>

namespace osgAnalyticBin::support {

ExitCode runProgram(const std::string& name, const std::function<ExitCode()>& run) {
    const auto complain = [&name](const std::exception& error, ExitCode code) {
        std::cerr << name + ": " + error.what() + '\n' << std::flush;
        return code;
    };
    try {
        return run();
    } catch (const Interrupted& error) {
        return complain(error, kInterrupted);
    } catch (const UsageError& error) {
        return complain(error, kWrongUsage);
    } catch (const std::bad_alloc&) {
        return complain(Failure("out of memory; use fewer --threads, or close other programs"), kFailed);
    } catch (const std::exception& error) {
        return complain(error, kFailed);
    }
}

}  // namespace osgAnalyticBin::support
