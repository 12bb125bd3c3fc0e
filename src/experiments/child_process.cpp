#include "experiments/child_process.h"

#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace nusselt::experiments {

namespace {

[[noreturn]] void fail(const std::string& program, const std::string& what) {
    throw std::runtime_error("cannot run " + program + ": " + what);
}

/// A file descriptor.
class Descriptor {
public:
    explicit Descriptor(int value) : value_(value) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(); }
    int value() const { return value_; }
    void close() {
        if (value_ >= 0) ::close(std::exchange(value_, -1));
    }

private:
    int value_;
};

std::string read_all(int descriptor) {
    std::string text;
    char buffer[4096];
    for (;;) {
        const ssize_t count = ::read(descriptor, buffer, sizeof buffer);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return text;
        text.append(buffer, static_cast<std::size_t>(count));
    }
}

pid_t spawn(const std::vector<std::string>& command, int output, int unused) {
    std::vector<char*> arguments;
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_addclose(&actions, output);
    posix_spawn_file_actions_addclose(&actions, unused);
    pid_t child = 0;
    const int error = posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) fail(command[0], std::strerror(error));
    return child;
}

} // namespace

ChildResult run_child(const std::vector<std::string>& command) {
    int ends[2];
    if (::pipe(ends) != 0) fail(command[0], std::strerror(errno));
    Descriptor reader(ends[0]);
    Descriptor writer(ends[1]);
    const pid_t child = spawn(command, writer.value(), reader.value());
    writer.close();

    ChildResult result;
    result.output = read_all(reader.value());
    int status = 0;
    rusage usage{};
    while (::wait4(child, &status, 0, &usage) < 0)
        if (errno != EINTR) fail(command[0], std::strerror(errno));
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail(command[0], "it failed");
    result.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    return result;
}

} // namespace nusselt::experiments
