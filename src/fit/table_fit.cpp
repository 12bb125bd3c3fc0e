#include "fit/table_fit.h"

#include "base/atomic_file.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace nusselt::fit {

namespace {

/// First line of a checkpoint: a fit that gives other numbers gets another version, so that none mixes them.
std::string title_of(const Brdf& brdf, const TableSize& size) {
    return fmt::format("nusselt ltc fit, version 1, {}, {}x{}x{}", brdf.name, size.roughness,
                       size.inclination, size.f0);
}

static_assert(sizeof(FittedLobe) == 6 * sizeof(double), "checkpoints store it as it is");

bool is_plausible(const FittedLobe& entry) {
    return entry.lobe.width_x > 0 && entry.lobe.width_y > 0 && entry.lobe.peak >= 0 && entry.lobe.tilt >= 0 &&
           std::isfinite(entry.lobe.width_x + entry.lobe.width_y + entry.lobe.peak + entry.lobe.tilt) &&
           entry.albedo >= 0 && entry.albedo < 2 && entry.error >= 0 && entry.error < 3;
}

} // namespace

TableFit::TableFit(const Brdf& brdf, const TableSize& size)
    : brdf_(&brdf),
      size_(size),
      entries_(static_cast<std::size_t>(columns()) * static_cast<std::size_t>(size.inclination)) {}

void TableFit::resume(const std::filesystem::path& checkpoint) {
    if (!std::filesystem::exists(checkpoint)) return;
    std::ifstream file(checkpoint, std::ios::binary);
    std::string title;
    std::getline(file, title);
    if (title != title_of(*brdf_, size_))
        throw std::runtime_error(
            fmt::format("{}: the file is not a checkpoint of '{}'; choose another file or remove it",
                        checkpoint.string(), title_of(*brdf_, size_)));
    int finished = 0;
    file >> finished;
    file.get();
    std::vector<FittedLobe> entries(
        static_cast<std::size_t>(std::clamp(finished, 0, columns()) * size_.inclination));
    const auto bytes = static_cast<std::streamsize>(entries.size() * sizeof(FittedLobe));
    file.read(reinterpret_cast<char*>(entries.data()), bytes);
    if (!file || finished < 0 || finished > columns() || file.peek() != std::ifstream::traits_type::eof() ||
        !std::all_of(entries.begin(), entries.end(), is_plausible))
        throw std::runtime_error(
            fmt::format("{}: the checkpoint is damaged; remove it to start again", checkpoint.string()));
    std::copy(entries.begin(), entries.end(), entries_.begin());
    finished_ = finished;
}

void TableFit::save(const std::filesystem::path& checkpoint) const {
    base::write_atomically(checkpoint, [&](std::ofstream& file) {
        const auto count = static_cast<std::size_t>(finished_ * size_.inclination);
        file << title_of(*brdf_, size_) << '\n' << finished_ << '\n';
        file.write(reinterpret_cast<const char*>(entries_.data()),
                   static_cast<std::streamsize>(count * sizeof(FittedLobe)));
    });
}

void TableFit::run(int more_columns) {
    const int end = std::min(finished_ + more_columns, columns());
    tbb::parallel_for(finished_, end, [&](int column) {
        const double roughness = static_cast<double>(column / size_.f0) / (size_.roughness - 1);
        const double f0 = static_cast<double>(column % size_.f0) / (size_.f0 - 1);
        const std::vector<FittedLobe> lobes = fit_column(*brdf_, roughness, f0, size_.inclination);
        std::copy(lobes.begin(), lobes.end(),
                  entries_.begin() + static_cast<std::ptrdiff_t>(column) * size_.inclination);
    });
    finished_ = end;
}

} // namespace nusselt::fit
