#pragma once
/// Work without the lock of Python.

#include <pybind11/pybind11.h>

#include <unistd.h>

namespace nusselt::python {

/// Gives the lock back while it exists. When Python has ended in the meantime, the thread waits for the end of the process:
/// Python 3.11 would unwind its stack, through destructors that may not throw, which aborts the process.
class WithoutGil {
public:
    WithoutGil() : state_(PyEval_SaveThread()) {}
    WithoutGil(const WithoutGil&) = delete;
    WithoutGil& operator=(const WithoutGil&) = delete;
    ~WithoutGil() {
        try {
            PyEval_RestoreThread(state_);
        } catch (...) { // by which glibc ends threads
            for (;;) ::pause();
        }
    }

private:
    PyThreadState* state_;
};

} // namespace nusselt::python
