// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "GnuplotRun.h"

#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace osgAnalyticBin::support {

namespace {

/// What a new process does before the program starts in it.
class FileActions final {
public:
    FileActions(const GnuplotRun& run, int input) {
        posix_spawn_file_actions_init(&_actions);
        posix_spawn_file_actions_adddup2(&_actions, input, STDIN_FILENO);
        // The name of that file is one of this program's folder: opened before the folder changes.
        if (!run.messages.empty()) {
            constexpr int kNew = O_WRONLY | O_CREAT | O_TRUNC;
            posix_spawn_file_actions_addopen(&_actions, STDERR_FILENO, run.messages.c_str(), kNew, 0666);
            posix_spawn_file_actions_adddup2(&_actions, STDERR_FILENO, STDOUT_FILENO);
        }
        if (!run.folder.empty()) posix_spawn_file_actions_addchdir_np(&_actions, run.folder.c_str());
    }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;
    ~FileActions() { posix_spawn_file_actions_destroy(&_actions); }

    [[nodiscard]] const posix_spawn_file_actions_t* get() const noexcept { return &_actions; }

private:
    posix_spawn_file_actions_t _actions;
};

std::optional<pid_t> start(const GnuplotRun& run, int input) {
    std::vector<std::string> words{"gnuplot"};
    words.insert(words.end(), run.arguments.begin(), run.arguments.end());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const FileActions actions(run, input);
    pid_t process = 0;
    if (posix_spawnp(&process, "gnuplot", actions.get(), nullptr, arguments.data(), environ) != 0) return std::nullopt;
    return process;
}

// As much as is read: a gnuplot that ends early is told by its exit code.
void writeAll(int output, const std::string& text) {
    const auto before = std::signal(SIGPIPE, SIG_IGN);
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t count = ::write(output, text.data() + done, text.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) break;
        done += static_cast<std::size_t>(count);
    }
    (void)std::signal(SIGPIPE, before);
}

}  // namespace

std::optional<int> runGnuplot(const GnuplotRun& run) {
    int ends[2] = {-1, -1};
    if (::pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
    const std::optional<pid_t> process = start(run, ends[0]);
    ::close(ends[0]);
    if (process) writeAll(ends[1], run.commands);
    ::close(ends[1]);
    if (!process) return std::nullopt;
    int status = 0;
    while (::waitpid(*process, &status, 0) < 0) {
        if (errno != EINTR) return -1;
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string quotedForGnuplot(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace osgAnalyticBin::support
