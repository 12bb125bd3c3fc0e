#include "lab/timing/child_process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace nusselt::lab {

namespace {

[[noreturn]] void fail(const std::string& program, const std::string& what) {
    throw std::runtime_error("cannot run " + program + ": " + what);
}

/// Owns a file descriptor.
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

constexpr int kNotStarted = 127; ///< exit code, as in shells

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

/// Does not use posix_spawn(): its child starts in the memory of this process, all of which would count as the
/// child's.
pid_t start(const std::vector<std::string>& command, int output) {
    std::vector<char*> arguments;
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    const pid_t child = ::fork();
    if (child < 0) fail(command[0], std::strerror(errno));
    if (child == 0) {
        // Other threads may have held locks, so the child only makes system calls. Its exec closes both ends of the
        // pipe.
        if (::dup2(output, STDOUT_FILENO) >= 0) ::execv(arguments[0], arguments.data());
        ::_exit(kNotStarted);
    }
    return child;
}

} // namespace

ChildResult run_child(const std::vector<std::string>& command) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) fail(command[0], std::strerror(errno));
    Descriptor reader(ends[0]);
    Descriptor writer(ends[1]);
    const pid_t child = start(command, writer.value());
    writer.close();

    ChildResult result;
    result.output = read_all(reader.value());
    int status = 0;
    rusage usage{};
    while (::wait4(child, &status, 0, &usage) < 0)
        if (errno != EINTR) fail(command[0], std::strerror(errno));
    if (WIFEXITED(status) && WEXITSTATUS(status) == kNotStarted) fail(command[0], "it does not start");
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail(command[0], "it failed");
    result.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    return result;
}

} // namespace nusselt::lab
