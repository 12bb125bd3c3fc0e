#include "lab/errors/curve_table.h"

#include <cmath>

namespace nusselt::lab {

std::vector<Column> curve_columns(std::vector<Column> names) {
    names.insert(names.end(),
                 {{"count"}, {"seeds"}, {"variance"}, {"error"}, {"seconds", "s"}, {"variance_error"}});
    return names;
}

void append_curve(const std::vector<Cell>& names, const NoiseCurve& curve, double mean, ResultTable& table) {
    for (const CurvePoint& p : curve) {
        std::vector<Cell>& row = table.rows.emplace_back(names);
        row.insert(row.end(),
                   {p.count, p.seeds, p.variance, std::sqrt(p.variance) / mean, p.seconds, p.variance_error});
    }
}

} // namespace nusselt::lab
