#pragma once
/// Progress of a long computation on standard error.

#include <chrono>

namespace nusselt::app {

/// Shows a bar with the time left on a terminal, and a line for every tenth elsewhere. Not thread-safe.
class Progress {
public:
    /// \param begin share of the work that is done already, in [0, 1]
    explicit Progress(double begin = 0);
    /// \param fraction of the work that is done, in [0, 1]; may shrink by rounding, never printed twice
    void update(double fraction);
    /// Ends the line of the bar, if there is one.
    void finish();

private:
    using Clock = std::chrono::steady_clock;

    void draw_bar(double fraction, double seconds_left);

    double begin_fraction_;
    Clock::time_point begin_ = Clock::now();
    Clock::time_point last_drawn_{};
    bool is_terminal_;
    bool has_bar_ = false;
    int printed_tenths_;
};

} // namespace nusselt::app
