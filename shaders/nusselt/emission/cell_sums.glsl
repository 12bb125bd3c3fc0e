#ifndef NUSSELT_EMISSION_CELL_SUMS_GLSL
#define NUSSELT_EMISSION_CELL_SUMS_GLSL
// Follows include/nusselt/emission/cell_sums.h @ db7642934dd0
/// How samples choose one cell of a lattice: a column, then a cell of it, in proportion to weights. Twin of
/// include/nusselt/emission/cell_sums.h. Sums over columns are added up again where they are needed: a thread has one
/// number per cell.

#include "../core/real.glsl"

/// Columns and rows of the lattice. Cell (i, j) has the index j * kNusseltCells + i.
const int kNusseltCells = 8;

/// One step of running sums.
struct SumStep {
    float before, after, total;
};

float sum_step_probability(const SumStep self) {
    return self.total > 0.0 ? (self.after - self.before) / self.total : 0.0;
}
/// What is left of the random number behind a target.
float sum_step_rest(const SumStep self, float target) {
    return below_one((target - self.before) / nusselt_max(self.after - self.before, kNusseltSmallestNormal));
}
/// What sum_step_rest() undoes.
float sum_step_united(const SumStep self, float u) {
    return self.total > 0.0 ? below_one((self.before + u * (self.after - self.before)) / self.total) : 0.0;
}

/// A cell of a lattice, and how likely it is.
struct CellChoice {
    ivec2 at;          ///< column and row
    float probability;
    vec2 u;            ///< random numbers that are left, in [0, 1)^2
    SumStep x, y;      ///< of columns and of cells of the column
};

int cell_choice_index(const CellChoice self) { return self.at.y * kNusseltCells + self.at.x; }

/// Running sums of the weights of cells.
struct CellSums {
    float sum[kNusseltCells * kNusseltCells]; ///< of weights of a column, up to each row
    float total;                              ///< 0 without a cell to choose
};

/// Appends the next cell: all of them have to be added, in the order of their indices.
/// \param weight not negative.
void cell_sums_add(inout CellSums self, int cell, float weight) {
    self.sum[cell] = (cell >= kNusseltCells ? self.sum[cell - kNusseltCells] : 0.0) + weight;
}

/// After the last cell.
void cell_sums_finish(inout CellSums self) {
    self.total = 0.0;
    for (int column = 0; column < kNusseltCells; ++column)
        self.total = self.total + self.sum[kNusseltCells * (kNusseltCells - 1) + column];
    if (!(self.total > 0.0 && is_finite(self.total))) self.total = 0.0;
}

/// Sums over columns up to a column, added up in the same order as for the total.
SumStep cell_sums_column_step(CellSums self, int column) {
    SumStep result = SumStep(0.0, 0.0, self.total);
    for (int i = 0; i <= column; ++i) {
        result.before = result.after;
        result.after = result.after + self.sum[kNusseltCells * (kNusseltCells - 1) + i];
    }
    return result;
}
SumStep cell_sums_cell_step(CellSums self, int column, int row) {
    return SumStep(row > 0 ? self.sum[(row - 1) * kNusseltCells + column] : 0.0, self.sum[row * kNusseltCells + column],
                   self.sum[(kNusseltCells - 1) * kNusseltCells + column]);
}

/// \param u in [0, 1)^2; x chooses the column. Only if the total is positive.
CellChoice cell_sums_choose(CellSums self, vec2 u) {
    const float below = 0.999999940395355224609375;
    vec2 target;
    target.x = nusselt_min(u.x, below) * self.total;
    CellChoice cell;
    cell.x = SumStep(0.0, 0.0, self.total);
    cell.at = ivec2(0);
    // The first running sum above the target, which is below the last one.
    for (int i = 0; i < kNusseltCells; ++i) {
        cell.at.x = i;
        cell.x.before = cell.x.after;
        cell.x.after = cell.x.after + self.sum[kNusseltCells * (kNusseltCells - 1) + i];
        if (cell.x.after > target.x) break;
    }
    target.y = nusselt_min(u.y, below) * self.sum[kNusseltCells * (kNusseltCells - 1) + cell.at.x];
    for (int k = kNusseltCells / 2; k > 0; k /= 2)
        cell.at.y += self.sum[(cell.at.y + k - 1) * kNusseltCells + cell.at.x] <= target.y ? k : 0;
    cell.y = cell_sums_cell_step(self, cell.at.x, cell.at.y);
    cell.probability = sum_step_probability(cell.x) * sum_step_probability(cell.y);
    cell.u = vec2(sum_step_rest(cell.x, target.x), sum_step_rest(cell.y, target.y));
    return cell;
}

/// A cell by its column and row.
CellChoice cell_sums_cell(const CellSums self, ivec2 at) {
    CellChoice cell;
    cell.at = at;
    cell.x = cell_sums_column_step(self, at.x);
    cell.y = cell_sums_cell_step(self, at.x, at.y);
    cell.probability = sum_step_probability(cell.x) * sum_step_probability(cell.y);
    cell.u = vec2(0.0);
    return cell;
}

/// The cell at a point of the lattice.
/// \param at in [0, 1)^2.
CellChoice cell_sums_at(const CellSums self, vec2 at) {
    return cell_sums_cell(self, clamp(ivec2(at * float(kNusseltCells)), ivec2(0), ivec2(kNusseltCells - 1)));
}

/// What cell_sums_choose() undoes.
/// \param u in the cell.
vec2 cell_choice_united(const CellChoice self, vec2 u) {
    return vec2(sum_step_united(self.x, u.x), sum_step_united(self.y, u.y));
}

#endif
