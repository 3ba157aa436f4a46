// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Interruption.h"

#include <csignal>

namespace osgAnalyticBin::support {

void stopOnSignals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, [](int) { stopRequested.store(true); });
    std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace osgAnalyticBin::support
