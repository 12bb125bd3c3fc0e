#include "progress.h"

#include "print_message.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace nusselt::app {

namespace {

constexpr int kBarWidth = 40;
constexpr std::chrono::milliseconds kRedrawInterval{100};
/// Shorter work finishes before anyone can read the time left.
constexpr double kFirstReport = 0.5;

int whole_tenths(double fraction) { return static_cast<int>(fraction * 10 + 1e-9); }

std::string duration_text(double seconds) {
    const auto whole = static_cast<long long>(seconds + 0.5);
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

} // namespace

Progress::Progress(double begin)
    : begin_fraction_(begin),
      is_terminal_(isatty(fileno(stderr)) != 0),
      printed_tenths_(whole_tenths(begin)) {}

void Progress::update(double fraction) {
    const auto now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - begin_).count();
    const double done = fraction - begin_fraction_;
    if (elapsed < kFirstReport || done <= 0) return;
    const double seconds_left = elapsed * (1 - fraction) / done;
    if (is_terminal_) {
        if (now - last_drawn_ < kRedrawInterval) return;
        last_drawn_ = now;
        draw_bar(fraction, seconds_left);
        return;
    }
    const int tenths = whole_tenths(fraction);
    if (tenths <= printed_tenths_) return;
    printed_tenths_ = tenths;
    print_message("{} % done, {} left\n", 10 * tenths, duration_text(seconds_left));
}

void Progress::draw_bar(double fraction, double seconds_left) {
    const int filled = static_cast<int>(fraction * kBarWidth);
    print_message("\r[{:<{}}] {:3.0f} %  {} left  \033[K", std::string(static_cast<std::size_t>(filled), '='),
                  kBarWidth, 100 * fraction, duration_text(seconds_left));
    std::fflush(stderr);
    has_bar_ = true;
}

void Progress::finish() {
    if (has_bar_) print_message("\r\033[K");
    has_bar_ = false;
}

} // namespace nusselt::app
