#pragma once
/// The tables of linearly transformed cosines in data/, read as users read them.

#include "common/source_folder.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <nusselt/ltc/table.h>
#include <nusselt/ltc/table_file.h>

namespace nusselt_test {

/// A table that ships with the library.
class ShippedTable {
public:
    /// \param name of a file of data/
    explicit ShippedTable(const char* name) {
        const auto path = std::filesystem::path(nusselt_test::kSourceFolder) / "data" / name;
        std::ifstream stream(path, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
        const auto file = nusselt::open_ltc_table(bytes.data(), bytes.size());
        if (file.problem != nullptr) throw std::runtime_error(file.problem);
        entries_.resize(file.entries());
        file.decode(entries_.data());
        view_ = {entries_.data(), file.roughnesses, file.inclinations, file.f0s};
    }
    const nusselt::LtcTableView& view() const { return view_; }

private:
    std::vector<float> entries_;
    nusselt::LtcTableView view_{};
};

} // namespace nusselt_test
