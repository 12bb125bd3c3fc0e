#include "follow.h"

#include "apps/common/interrupt.h"
#include "base/stopwatch.h"
#include "base/words.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

namespace nusselt::app {

namespace {

/// Between two questions to the engine [s].
constexpr double kInquiryInterval = 5;
/// Of a script whose exit code nobody can tell.
constexpr int kUnknownCode = 255;
/// At the start, an engine that does not answer is asked so often.
constexpr int kMostInquiries = 5;
/// So many times in a row the engine must not have the job: it may hand it on between two questions.
constexpr int kMostAbsences = 3;

/// A script of a job's folder that runs, with all that it starts, in a group of processes of its own.
class Script {
public:
    /// \param log for what it prints
    Script(const std::filesystem::path& script, const std::filesystem::path& log) {
        const std::string script_text = script.string();
        const std::string log_text = log.string();
        pid_ = ::fork();
        if (pid_ < 0) throw std::runtime_error("cannot start a process; close other programs");
        if (pid_ == 0) {
            ::setpgid(0, 0);
            const int file = ::open(log_text.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
            const int nothing = ::open("/dev/null", O_RDONLY);
            ::dup2(nothing, STDIN_FILENO);
            ::dup2(file, STDOUT_FILENO);
            ::dup2(file, STDERR_FILENO);
            // Folders may forbid to execute files.
            ::execl("/bin/sh", "sh", script_text.c_str(), nullptr);
            ::_exit(127);
        }
        ::setpgid(pid_, pid_); // whoever is first
    }
    Script(const Script&) = delete;
    Script& operator=(const Script&) = delete;
    ~Script() { wait(); }

    /// The exit code, if it has ended.
    std::optional<int> exit_code() {
        if (!code_) ask(WNOHANG);
        return code_;
    }
    int wait() {
        while (!code_) ask(0);
        return *code_;
    }
    /// Asks all its processes to end.
    void stop() {
        if (!code_) ::kill(-pid_, SIGTERM);
    }

private:
    void ask(int options) {
        int status = 0;
        const pid_t found = ::waitpid(pid_, &status, options);
        if (found == pid_) set_code(status);
        if (found < 0 && errno != EINTR) code_ = kUnknownCode;
    }
    void set_code(int status) { code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

    pid_t pid_;
    std::optional<int> code_;
};

struct Result {
    int exit_code;
    std::string message;
};

/// What the gathering step has left, if it is over.
std::optional<Result> result_of(const Job& job) {
    std::ifstream stream(job.folder / "result.txt");
    Result result{};
    if (!(stream >> result.exit_code)) return std::nullopt;
    stream.ignore();
    std::getline(stream, result.message);
    return result;
}

/// The text of a log in one line.
std::string text_of(const std::filesystem::path& log) {
    std::ifstream stream(log);
    std::string text;
    for (std::string word; stream >> word;) text += (text.empty() ? "" : " ") + word;
    return text;
}

/// Why start.sh has failed.
std::string reason_of(int exit_code, const Job& job, const std::filesystem::path& log) {
    const bool is_signal = exit_code > 128 && exit_code <= 128 + SIGRTMAX; // GNU parallel also ends with 255
    if (is_signal)
        return fmt::format(
            "signal {} ended '{}'; run the same command again, which does only what is missing",
            exit_code - 128, (job.folder / "start.sh").string());
    const std::string text = text_of(log);
    return text.empty() ? fmt::format("'{}' ended with code {}; start it by hand to see more",
                                      (job.folder / "start.sh").string(), exit_code)
                        : text;
}

/// As missing.sh counts them.
std::size_t tasks_left(const Job& job) {
    std::size_t left = 0;
    for (std::size_t i = 0; i < job.tasks.size(); ++i) {
        std::error_code error;
        const bool is_done = std::filesystem::exists(task_file(job.folder, "done", i + 1, ""), error) &&
                             std::filesystem::file_size(job.tasks[i].output, error) > 0 && !error;
        left += is_done ? 0 : 1;
    }
    return left;
}

enum class Presence { there, gone, unknown };

Presence presence(const Job& job) {
    const int code = Script(job.folder / "alive.sh", "/dev/null").wait();
    return code == 0 ? Presence::there : code == 1 ? Presence::gone : Presence::unknown;
}

/// Whether the engine has the job. Who takes no answer for a no gives the same tasks to it twice.
/// \throws std::runtime_error if it does not answer
bool has_job_already(const Job& job) {
    for (int inquiry = 0; inquiry < kMostInquiries && !interrupted; ++inquiry) {
        const Presence found = presence(job);
        if (found != Presence::unknown) return found == Presence::there;
        std::this_thread::sleep_for(std::chrono::seconds(1));
    }
    throw std::runtime_error("the engine does not answer, and may have the job already; try again later");
}

/// Asks the engine now and then.
class Inquiry {
public:
    Inquiry(const Job& job, const std::function<void(const std::string&)>& notify)
        : job_(job), notify_(notify) {}

    /// \throws std::runtime_error if the engine has lost the job
    void ask() {
        if (since_.seconds() < kInquiryInterval) return;
        since_ = base::Stopwatch();
        const Presence found = presence(job_);
        if (found == Presence::unknown && !has_told_) {
            notify_("the engine does not answer; waiting for what tasks write");
            has_told_ = true;
        }
        absences_ = found == Presence::gone ? absences_ + 1 : 0;
        if (absences_ >= kMostAbsences && !result_of(job_))
            throw std::runtime_error(fmt::format("the engine no longer has the job, and there is no result; "
                                                 "see {}, then run the same command again, which "
                                                 "does only what is missing",
                                                 (job_.folder / "logs").string()));
    }

private:
    const Job& job_;
    const std::function<void(const std::string&)>& notify_;
    base::Stopwatch since_;
    int absences_ = 0;
    bool has_told_ = false;
};

/// The result as the exit code of the command. \throws std::runtime_error if it is none
int report(const Result& result) {
    if (result.exit_code == 0) return 0;
    // Programs begin their messages with their name.
    const std::string kError = " error: ";
    const std::size_t begin = result.message.find(kError);
    throw std::runtime_error(begin == std::string::npos || result.message.find(' ') != begin
                                 ? result.message
                                 : result.message.substr(begin + kError.size()));
}

} // namespace

double done_fraction(const Job& job) {
    std::error_code error;
    std::size_t done = 0;
    for (std::filesystem::directory_iterator entry(job.folder / "done", error), end; !error && entry != end;
         entry.increment(error))
        ++done;
    return std::min(1.0, static_cast<double>(done) / static_cast<double>(job.tasks.size()));
}

int run_job(const Job& job, const std::function<void(double)>& progress,
            const std::function<void(const std::string&)>& notify) {
    const InterruptGuard guard("\nstopping; a second Ctrl-C ends the program at once\n");
    // Services may ignore it, and pass that on; then nobody hears of exit codes.
    std::signal(SIGCHLD, SIG_DFL);
    const base::Stopwatch stopwatch;
    std::optional<Script> starter;
    const std::filesystem::path start_log = job.folder / "logs/start.txt";
    if (has_job_already(job)) {
        notify("the engine has the job already; following it");
    } else {
        std::error_code ignored;
        std::filesystem::remove(job.folder / "result.txt", ignored);
        notify(fmt::format("{} of {} tasks are left to do; they write to {}", tasks_left(job),
                           job.tasks.size(), base::shell_word((job.folder / "logs").string())));
        starter.emplace(job.folder / "start.sh", start_log);
    }
    Inquiry inquiry(job, notify);
    while (!interrupted) {
        if (const auto result = result_of(job); result && (!starter || starter->exit_code()))
            return report(*result);
        progress(done_fraction(job));
        if (starter && starter->exit_code()) {
            if (*starter->exit_code() != 0 && !result_of(job))
                throw std::runtime_error(fmt::format("the job cannot be started: {}",
                                                     reason_of(*starter->exit_code(), job, start_log)));
            starter.reset();
        }
        if (!starter) inquiry.ask();
        // Short jobs end soon; long ones must not keep a shared folder busy.
        const double pause = std::clamp(stopwatch.seconds() / 20, 0.1, 2.0);
        std::this_thread::sleep_for(std::chrono::duration<double>(pause));
    }
    if (starter) {
        starter->stop();
        starter->wait();
        notify("stopped; run the same command again to continue");
    } else {
        notify("the engine goes on with the job; run the same command again to follow it");
    }
    return interrupted_exit_code();
}

} // namespace nusselt::app
