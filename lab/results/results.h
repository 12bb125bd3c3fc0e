#pragma once
/// What a command of the laboratory measured, in the format from which scripts/fill-docs.py fills the documentation.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace nusselt::lab {

/// Nothing, a truth value, a number or a text.
using Cell = std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string>;

template <class Value>
Cell cell_of(const std::optional<Value>& value) {
    return value ? Cell(*value) : Cell(nullptr);
}

struct Column {
    std::string name;      ///< a word, with underscores
    std::string unit = {}; ///< empty for texts and for numbers without a unit
};

struct ResultTable {
    std::string name;
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows = {}; ///< with a cell for each column
};

struct Results {
    std::string bench; ///< the command or experiment
    /// Other settings on which the numbers depend, with names like those of columns.
    std::vector<std::pair<std::string, Cell>> settings;
    std::vector<ResultTable> tables;
};

/// JSON with a line for each row. It also has the command line and the version of this program, and the machine.
/// Numbers that are not finite become null.
/// \throws std::logic_error if a row has not a cell for each column
std::string to_json(const Results& results);

} // namespace nusselt::lab
