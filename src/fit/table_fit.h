#pragma once
/// Fits of whole tables.

#include "fit/lobe_fit.h"

#include <filesystem>

namespace nusselt::fit {

/// Numbers of samples along the axes of a table, at least 2 each. They include both ends of roughness in [0, 1],
/// inclination in [0, pi / 2] and f0 in [0, 1], with equal steps.
struct TableSize {
    int roughness, inclination, f0;
};

/// A table that is filled column by column. The result does not depend on the number of threads nor on how often the
/// work was interrupted.
class TableFit {
public:
    TableFit(const Brdf& brdf, const TableSize& size);

    /// Continues where the file says that an earlier run got to. Does nothing if there is no such file.
    /// \throws std::runtime_error naming the file if it is not a checkpoint, damaged or of another table
    void resume(const std::filesystem::path& checkpoint);
    /// Writes a checkpoint. \throws std::runtime_error as base::write_atomically
    void save(const std::filesystem::path& checkpoint) const;

    /// Columns, of a roughness and f0 each.
    int columns() const { return size_.roughness * size_.f0; }
    int finished_columns() const { return finished_; }
    /// Fits at most this many more, in parallel on the threads of the current TBB arena.
    void run(int more_columns);

    const TableSize& size() const { return size_; }
    /// \param roughness, inclination, f0 indices; the column must be finished.
    const FittedLobe& entry(int roughness, int inclination, int f0) const {
        return entries_[static_cast<std::size_t>((roughness * size_.f0 + f0) * size_.inclination +
                                                 inclination)];
    }

private:
    const Brdf* brdf_;
    TableSize size_;
    int finished_ = 0;
    std::vector<FittedLobe> entries_; ///< column by column
};

} // namespace nusselt::fit
