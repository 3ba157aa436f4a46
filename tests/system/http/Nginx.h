// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TestRaster.h"

#include <gtest/gtest.h>

#include <arpa/inet.h>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <netinet/in.h>
#include <support/Programs.h>
#include <support/TemporaryFolder.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
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

    [[nodiscard]] static bool isInstalled() { return std::filesystem::exists(NGINX_FILE); }

    explicit Nginx(std::string folder) : _served(std::move(folder)) {}
    ~Nginx() { stop(); }
    Nginx(const Nginx&) = delete;
    Nginx& operator=(const Nginx&) = delete;

    /// `rules`: more lines for nginx's server block. Returns: false, after a failure of the test, when it does not run.
    bool start(const std::string& rules = {}) {
        constexpr std::chrono::seconds kLongestStart{20};
        stop();
        (void)_own.write("nginx.conf", configuration(rules));
        const std::string folder = _own.path();
        _process = fork();
        if (_process == 0) becomeNginx(folder);
        const auto end = std::chrono::steady_clock::now() + kLongestStart;
        while (std::chrono::steady_clock::now() < end && waitpid(_process, nullptr, WNOHANG) == 0) {
            if (answers()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        ADD_FAILURE() << "nginx does not start: " << textOfFile(_own / "output.log") << textOfFile(_own / "error.log");
        stop();
        return false;
    }

    /// At once, in the middle of whatever it sends.
    void stop() {
        if (_process <= 0) return;
        kill(_process, SIGKILL);
        waitpid(_process, nullptr, 0);
        _process = -1;
    }

    [[nodiscard]] std::string url(const std::string& file) const {
        return "http://127.0.0.1:" + std::to_string(_port) + '/' + file;
    }

    /// What was answered completely since the beginning, earlier starts included.
    [[nodiscard]] std::vector<Request> requests() const {
        std::vector<Request> requests;
        std::istringstream lines(textOfFile(_own / "access.log"));
        for (Request request; lines >> request.status >> request.bytes >> request.path;) requests.push_back(request);
        return requests;
    }

private:
    static sockaddr_in loopback(int port) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        return address;
    }

    static int freePort() {
        const int handle = socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address = loopback(0);
        socklen_t size = sizeof address;
        bind(handle, reinterpret_cast<sockaddr*>(&address), size);
        getsockname(handle, reinterpret_cast<sockaddr*>(&address), &size);
        close(handle);
        return ntohs(address.sin_port);
    }

    // One process, in the foreground: what is killed leaves nothing behind. Temporary paths have to be named, because
    // those that are compiled in belong to the system's service.
    [[nodiscard]] std::string configuration(const std::string& rules) const {
        std::ostringstream text;
        text << "daemon off;\nmaster_process off;\npid nginx.pid;\nevents {}\nhttp {\n"
             << "log_format counts '$status $body_bytes_sent $request_uri';\naccess_log access.log counts;\n";
        for (const char* kind : {"client_body", "proxy", "fastcgi", "uwsgi", "scgi"})
            text << kind << "_temp_path temporary;\n";
        text << "server {\nlisten 127.0.0.1:" << _port << ";\nroot '" << _served << "';\n" << rules << "\n}\n}\n";
        return text.str();
    }

    [[noreturn]] static void becomeNginx(const std::string& folder) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        const int log = open((folder + "/output.log").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
        dup2(log, 1);
        dup2(log, 2);
        execl(NGINX_FILE, NGINX_FILE, "-p", folder.c_str(), "-c", "nginx.conf", "-e", "error.log", nullptr);
        _exit(127);
    }

    [[nodiscard]] bool answers() const {
        const int handle = socket(AF_INET, SOCK_STREAM, 0);
        const sockaddr_in address = loopback(_port);
        const bool connected = connect(handle, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
        close(handle);
        return connected;
    }

    const std::string _served;
    const TemporaryFolder _own;
    const int _port = freePort();
    pid_t _process = -1;
};

/// Makes a globe with osgbindem: 128 start tiles and two finer levels in 640 files of some 20 kB.
/// Returns: whether FOLDER/earth.osgb is there.
inline bool makeSmallGlobe(const std::string& folder) {
    const std::string grid = TestRaster::globe(1.0, hills).write(folder + "/hills.tif");
    const Outcome outcome = runStock(quoted(OSGBINDEM_FILE) + ' ' + quoted(grid) + " --levels 2 --cells 8 --quiet -o " +
                                         quoted(folder + "/earth.osgb"),
                                     Modules::Present);
    std::filesystem::remove(grid);
    return outcome.code == 0 && std::filesystem::exists(folder + "/earth.osgb");
}

}  // namespace osgAnalyticBin::test
