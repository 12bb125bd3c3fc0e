#pragma once
/// Lights that are prepared for a technique, in packs.

#include "python/kernels/kernel.h"

#include <cstddef>
#include <memory>
#include <new>

namespace nusselt::python {

/// Memory for packs.
class PackMemory {
public:
    explicit PackMemory(std::size_t bytes)
        : memory_(bytes == 0 ? nullptr : ::operator new(bytes, std::align_val_t(kAlignment))) {}
    char* get() const { return static_cast<char*>(memory_.get()); }

private:
    static constexpr std::size_t kAlignment = 64;
    struct Free {
        void operator()(void* memory) const { ::operator delete(memory, std::align_val_t(kAlignment)); }
    };
    std::unique_ptr<void, Free> memory_;
};

/// What a kernel needs beside numbers, for a sequence of lights.
struct State {
    std::size_t count = 1;
    std::size_t bytes = 0;       ///< of a pack of lights
    const char* alone = nullptr; ///< for each light a pack with that light in all lanes; null for many lights
    const char* groups = nullptr; ///< a light per lane; null for one light
};

template <class Scalar>
class Lights {
public:
    /// \param row     whose takes() accepts this number of columns
    /// \param numbers count * columns of them, light by light
    Lights(const TechniqueRow<Scalar>& row, const Scalar* numbers, int columns, std::size_t count);

    const TechniqueRow<Scalar>& row() const { return row_; }
    State state() const { return {count_, row_.bytes, alone_.get(), groups_.get()}; }

private:
    const TechniqueRow<Scalar>& row_;
    std::size_t count_;
    PackMemory alone_, groups_;
};

extern template class Lights<float>;
extern template class Lights<double>;

} // namespace nusselt::python
