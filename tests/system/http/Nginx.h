// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <support/TemporaryFolder.h>
#include <sys/types.h>
#include <vector>

namespace osgAnalyticBin::test {

/// Debian's nginx as a process of the test: serves a folder on the loopback device, on a port that was free, with every
/// file of its own in a temporary folder. It ends with this object, and with the test however that ends.
class Nginx {
public:
    /// One line of the access log.
    struct Request {
        int status = 0;
        std::size_t bytes = 0;  // of the body
        std::string path;

        /// A tile's file, rather than what OSG's client and the pseudo-loader look for beside the root.
        [[nodiscard]] bool isTile() const { return path.find("/earth_tiles/") == 0; }
    };

    [[nodiscard]] static bool isInstalled();

    explicit Nginx(std::string folder);
    ~Nginx();
    Nginx(const Nginx&) = delete;
    Nginx& operator=(const Nginx&) = delete;

    /// `rules`: more lines for nginx's server block. Returns: false, after a failure of the test, when it does not run.
    bool start(const std::string& rules = {});

    /// At once, in the middle of whatever it sends.
    void stop();

    [[nodiscard]] std::string url(const std::string& file) const;

    /// What was answered completely since the beginning, earlier starts included.
    [[nodiscard]] std::vector<Request> requests() const;

private:
    [[nodiscard]] bool answers() const;

    std::string _served;
    TemporaryFolder _own;
    int _port = 0;
    pid_t _process = -1;
};

}  // namespace osgAnalyticBin::test
