// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Nginx.h"

#include <gtest/gtest.h>

#include <arpa/inet.h>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <netinet/in.h>
#include <sstream>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace osgAnalyticBin::test {

namespace {

constexpr std::chrono::seconds kLongestStart{20};

sockaddr_in loopback(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

int freePort() {
    const int handle = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address = loopback(0);
    socklen_t size = sizeof address;
    bind(handle, reinterpret_cast<sockaddr*>(&address), size);
    getsockname(handle, reinterpret_cast<sockaddr*>(&address), &size);
    close(handle);
    return ntohs(address.sin_port);
}

// One process, in the foreground: what is killed leaves nothing behind. Temporary paths have to be named, because those
// that are compiled in belong to the system's service.
std::string configuration(const std::string& served, int port, const std::string& rules) {
    std::ostringstream text;
    text << "daemon off;\nmaster_process off;\npid nginx.pid;\nevents {}\nhttp {\n"
         << "log_format counts '$status $body_bytes_sent $request_uri';\naccess_log access.log counts;\n";
    for (const char* kind : {"client_body", "proxy", "fastcgi", "uwsgi", "scgi"})
        text << kind << "_temp_path temporary;\n";
    text << "server {\nlisten 127.0.0.1:" << port << ";\nroot '" << served << "';\n" << rules << "\n}\n}\n";
    return text.str();
}

[[noreturn]] void becomeNginx(const std::string& folder) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int log = open((folder + "/output.log").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    dup2(log, 1);
    dup2(log, 2);
    execl(NGINX_FILE, NGINX_FILE, "-p", folder.c_str(), "-c", "nginx.conf", "-e", "error.log", nullptr);
    _exit(127);
}

}  // namespace

bool Nginx::isInstalled() {
    return std::filesystem::exists(NGINX_FILE);
}

Nginx::Nginx(std::string folder) : _served(std::move(folder)), _port(freePort()) {}

Nginx::~Nginx() {
    stop();
}

bool Nginx::start(const std::string& rules) {
    stop();
    (void)_own.write("nginx.conf", configuration(_served, _port, rules));
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

void Nginx::stop() {
    if (_process <= 0) return;
    kill(_process, SIGKILL);
    waitpid(_process, nullptr, 0);
    _process = -1;
}

bool Nginx::answers() const {
    const int handle = socket(AF_INET, SOCK_STREAM, 0);
    const sockaddr_in address = loopback(_port);
    const bool connected = connect(handle, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    close(handle);
    return connected;
}

std::string Nginx::url(const std::string& file) const {
    return "http://127.0.0.1:" + std::to_string(_port) + '/' + file;
}

std::vector<Nginx::Request> Nginx::requests() const {
    std::vector<Request> requests;
    std::istringstream lines(textOfFile(_own / "access.log"));
    for (Request request; lines >> request.status >> request.bytes >> request.path;) requests.push_back(request);
    return requests;
}

}  // namespace osgAnalyticBin::test
