#include "python/loops/loop.h"

#include "base/threads.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>

namespace nusselt::python {

namespace {

/// Elements of a block: the columns of its operands stay in the first level of caches.
constexpr std::ptrdiff_t kBlock = 256;
/// Blocks of a task for one thread.
constexpr std::ptrdiff_t kBlocksPerTask = 32;
constexpr std::size_t kMostOperands = kMostInputs + kMostOutputs;

/// For each operand, inputs first, [numbers].
using Offsets = std::array<std::ptrdiff_t, kMostOperands>;

struct Axis {
    std::ptrdiff_t extent;
    Offsets strides;
};

/// The strides of all operands along an axis of a loop.
template <class Scalar>
Offsets strides_along(const Loop<Scalar>& loop, std::size_t axis) {
    Offsets strides = {};
    std::size_t k = 0;
    for (const auto& input : loop.inputs) strides[k++] = input.strides[axis];
    for (const auto& output : loop.outputs) strides[k++] = output.strides[axis];
    return strides;
}

/// The axes of a loop along which the light changes, or the others. Neighbours that are one axis in all operands become one.
template <class Scalar>
std::vector<Axis> axes_of(const Loop<Scalar>& loop, bool along_lights) {
    std::vector<Axis> axes;
    for (std::size_t i = 0; i < loop.shape.size(); ++i) {
        if (loop.shape[i] == 1 || (loop.light_strides[i] != 0) != along_lights) continue;
        const Axis axis = {loop.shape[i], strides_along(loop, i)};
        const auto continues = [&](const Axis& outer) {
            for (std::size_t k = 0; k < kMostOperands; ++k)
                if (outer.strides[k] != axis.strides[k] * axis.extent) return false;
            return true;
        };
        if (!axes.empty() && continues(axes.back()))
            axes.back() = {axes.back().extent * axis.extent, axis.strides};
        else
            axes.push_back(axis);
    }
    return axes;
}

std::ptrdiff_t size_of(const std::vector<Axis>& axes) {
    std::ptrdiff_t size = 1;
    for (const Axis& axis : axes) size *= axis.extent;
    return size;
}

Offsets moved(Offsets offsets, std::ptrdiff_t steps, const Offsets& strides) {
    for (std::size_t k = 0; k < kMostOperands; ++k) offsets[k] += steps * strides[k];
    return offsets;
}

/// The offsets of an element, counted with the last axis as the fastest one.
Offsets offsets_of(const std::vector<Axis>& axes, std::ptrdiff_t element, Offsets offsets) {
    for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) {
        offsets = moved(offsets, element % axis->extent, axis->strides);
        element /= axis->extent;
    }
    return offsets;
}

/// Copies n elements of some numbers each into columns.
template <class Scalar>
void gather(const Scalar* from, std::ptrdiff_t stride, std::ptrdiff_t component, int size, std::ptrdiff_t n,
            Scalar* to) {
    // Dense pairs and triples are what most arrays have; with constant strides, compilers make vector code of them.
    if (component == 1 && stride == 3 && size == 3) {
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            to[i] = from[3 * i];
            to[kBlock + i] = from[3 * i + 1];
            to[2 * kBlock + i] = from[3 * i + 2];
        }
    } else if (component == 1 && stride == 2 && size == 2) {
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            to[i] = from[2 * i];
            to[kBlock + i] = from[2 * i + 1];
        }
    } else {
        for (int c = 0; c < size; ++c, from += component, to += kBlock)
            for (std::ptrdiff_t i = 0; i < n; ++i) to[i] = from[stride * i];
    }
}

template <class Scalar>
void scatter(const Scalar* from, Scalar* to, std::ptrdiff_t stride, std::ptrdiff_t component, int size,
             std::ptrdiff_t n) {
    if (component == 1 && stride == 3 && size == 3) {
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            to[3 * i] = from[i];
            to[3 * i + 1] = from[kBlock + i];
            to[3 * i + 2] = from[2 * kBlock + i];
        }
    } else if (component == 1 && stride == 2 && size == 2) {
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            to[2 * i] = from[i];
            to[2 * i + 1] = from[kBlock + i];
        }
    } else if (stride == 1) {
        for (int c = 0; c < size; ++c, to += component, from += kBlock)
            std::memcpy(to, from, static_cast<std::size_t>(n) * sizeof(Scalar));
    } else {
        for (int c = 0; c < size; ++c, to += component, from += kBlock)
            for (std::ptrdiff_t i = 0; i < n; ++i) to[stride * i] = from[i];
    }
}

/// Elements in equal steps.
struct Run {
    Offsets begin;
    const Offsets* strides;
    std::ptrdiff_t count;
};

/// Works on blocks of one loop. Each thread has its own.
template <class Scalar>
class Worker {
public:
    /// \param step see Block::step
    Worker(Kernel<Scalar> kernel, int lanes, const Loop<Scalar>& loop, std::size_t step)
        : kernel_(kernel), lanes_(lanes), step_(step), loop_(loop), columns_(column_bytes(loop)) {
        runs_.reserve(kBlock);
    }

    /// Elements begin <= i < end of some axes. \param state of the first of them
    void work(const std::vector<Axis>& axes, std::ptrdiff_t begin, std::ptrdiff_t end, const Offsets& base,
              const char* state) {
        static const Offsets kNone = {};
        const std::ptrdiff_t row = axes.empty() ? 1 : axes.back().extent;
        const Offsets& strides = axes.empty() ? kNone : axes.back().strides;
        while (begin < end) {
            const std::ptrdiff_t count = std::min(kBlock, end - begin);
            runs_.clear();
            for (std::ptrdiff_t i = 0; i < count;) {
                const std::ptrdiff_t length = std::min(row - (begin + i) % row, count - i);
                runs_.push_back({offsets_of(axes, begin + i, base), &strides, length});
                i += length;
            }
            call(count, state);
            begin += count;
            state += step_ * static_cast<std::size_t>(packs(count));
        }
    }

private:
    static std::size_t column_bytes(const Loop<Scalar>& loop) {
        int numbers = 0;
        for (const auto& input : loop.inputs) numbers += input.size;
        for (const auto& output : loop.outputs) numbers += output.size;
        return static_cast<std::size_t>(numbers) * kBlock * sizeof(Scalar);
    }
    int packs(std::ptrdiff_t count) const { return static_cast<int>((count - 1) / lanes_ + 1); }

    /// Whether the numbers of an operand are columns as they are.
    bool has_columns(std::size_t k, std::ptrdiff_t count) const {
        return runs_.size() == 1 && (*runs_[0].strides)[k] == 1 && count % lanes_ == 0;
    }

    void call(std::ptrdiff_t count, const char* state) {
        Block<Scalar> block;
        block.state = state;
        block.step = step_;
        block.packs = packs(count);
        block.columns = loop_.inputs.empty() ? 0 : loop_.inputs[0].size;
        Scalar* columns = reinterpret_cast<Scalar*>(columns_.get());
        std::size_t k = 0;
        for (std::size_t i = 0; i < loop_.inputs.size(); ++i, ++k) {
            const auto& input = loop_.inputs[i];
            if (has_columns(k, count)) {
                block.inputs[i] = {input.data + runs_[0].begin[k], static_cast<std::size_t>(input.component)};
            } else {
                block.inputs[i] = {columns, kBlock};
                read(input, k, count, columns);
            }
            columns += input.size * kBlock;
        }
        const std::size_t first_output = k;
        Scalar* const output_columns = columns;
        for (std::size_t i = 0; i < loop_.outputs.size(); ++i, ++k) {
            const auto& output = loop_.outputs[i];
            if (has_columns(k, count))
                block.outputs[i] = {output.data + runs_[0].begin[k],
                                    static_cast<std::size_t>(output.component)};
            else
                block.outputs[i] = {columns, kBlock};
            columns += output.size * kBlock;
        }
        kernel_(block);
        columns = output_columns;
        k = first_output;
        for (const auto& output : loop_.outputs) {
            if (!has_columns(k, count)) write(output, k, columns);
            columns += output.size * kBlock;
            ++k;
        }
    }

    void read(const Operand<const Scalar>& input, std::size_t k, std::ptrdiff_t count,
              Scalar* columns) const {
        std::ptrdiff_t done = 0;
        for (const Run& run : runs_) {
            gather(input.data + run.begin[k], (*run.strides)[k], input.component, input.size, run.count,
                   columns + done);
            done += run.count;
        }
        // Lanes without an element repeat one.
        for (int c = 0; c < input.size; ++c)
            std::fill(columns + c * kBlock + count, columns + c * kBlock + packs(count) * lanes_,
                      columns[c * kBlock]);
    }
    void write(const Operand<Scalar>& output, std::size_t k, const Scalar* columns) const {
        for (const Run& run : runs_) {
            scatter(columns, output.data + run.begin[k], (*run.strides)[k], output.component, output.size,
                    run.count);
            columns += run.count;
        }
    }

    Kernel<Scalar> kernel_;
    int lanes_;
    std::size_t step_;
    const Loop<Scalar>& loop_;
    PackMemory columns_;
    std::vector<Run> runs_;
};

/// Calls a function with the numbers below `count`, from so many threads.
template <class Function>
void for_each_task(std::ptrdiff_t count, int threads, const Function& function) {
    if (threads == 1 || count == 1) {
        for (std::ptrdiff_t i = 0; i < count; ++i) function(i);
        return;
    }
    // Starting threads takes long: each number is tried once.
    static std::atomic<int> started = 1;
    if (threads > started) {
        base::check_threads(threads);
        started = threads;
    }
    tbb::task_arena(threads).execute([&] { tbb::parallel_for(std::ptrdiff_t(0), count, function); });
}

/// Splits outer times inner elements into tasks of a part of the inner ones and, where these are few, of several outer ones.
struct Tasks {
    std::ptrdiff_t outer, inner;
    std::ptrdiff_t inner_per_task, outer_per_task;

    Tasks(std::ptrdiff_t outer_count, std::ptrdiff_t inner_count)
        : outer(outer_count),
          inner(inner_count),
          inner_per_task(std::min(inner_count, kBlock * kBlocksPerTask)),
          outer_per_task(std::max<std::ptrdiff_t>(kBlock * kBlocksPerTask / inner_per_task, 1)) {}

    std::ptrdiff_t inner_tasks() const { return (inner - 1) / inner_per_task + 1; }
    std::ptrdiff_t count() const { return inner_tasks() * ((outer - 1) / outer_per_task + 1); }

    /// Calls function(outer, begin, end) for all that belongs to a task.
    template <class Function>
    void for_each(std::ptrdiff_t task, const Function& function) const {
        const std::ptrdiff_t begin = task % inner_tasks() * inner_per_task;
        const std::ptrdiff_t end = std::min(begin + inner_per_task, inner);
        const std::ptrdiff_t first = task / inner_tasks() * outer_per_task;
        for (std::ptrdiff_t i = first; i < std::min(first + outer_per_task, outer); ++i)
            function(i, begin, end);
    }
};

} // namespace

template <class Scalar>
void run(Kernel<Scalar> kernel, int lanes, const State& state, const Loop<Scalar>& loop, int threads) {
    for (const std::ptrdiff_t extent : loop.shape)
        if (extent == 0) return;
    const std::vector<Axis> lights = axes_of(loop, true);
    const std::vector<Axis> rounds = axes_of(loop, false);
    const std::ptrdiff_t round_count = size_of(rounds);
    // Lanes are samples of a light, or lights.
    if (state.groups == nullptr || (state.alone != nullptr && round_count >= lanes)) {
        const Tasks tasks(size_of(lights), round_count);
        for_each_task(tasks.count(), threads, [&](std::ptrdiff_t task) {
            Worker<Scalar> worker(kernel, lanes, loop, 0);
            tasks.for_each(task, [&](std::ptrdiff_t light, std::ptrdiff_t begin, std::ptrdiff_t end) {
                worker.work(rounds, begin, end, offsets_of(lights, light, {}),
                            state.alone + static_cast<std::size_t>(light) * state.bytes);
            });
        });
    } else {
        const Tasks tasks(round_count, size_of(lights));
        for_each_task(tasks.count(), threads, [&](std::ptrdiff_t task) {
            Worker<Scalar> worker(kernel, lanes, loop, state.bytes);
            tasks.for_each(task, [&](std::ptrdiff_t round, std::ptrdiff_t begin, std::ptrdiff_t end) {
                worker.work(lights, begin, end, offsets_of(rounds, round, {}),
                            state.groups + static_cast<std::size_t>(begin / lanes) * state.bytes);
            });
        });
    }
}

template void run(Kernel<float>, int, const State&, const Loop<float>&, int);
template void run(Kernel<double>, int, const State&, const Loop<double>&, int);

} // namespace nusselt::python
