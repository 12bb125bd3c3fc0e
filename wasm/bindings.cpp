#include "wasm/bindings.h"

#include "wasm/techniques.h"

#include <iterator>

using nusselt::columns::kRows;

int nusselt_row(int technique, int columns) noexcept {
    for (int row = 0; row < static_cast<int>(std::size(kRows)); ++row)
        if (kRows[row].technique == technique && kRows[row].takes(columns)) return row;
    return -1;
}
const char* nusselt_light(int row) noexcept { return kRows[row].light; }
int nusselt_random_numbers(int row) noexcept { return kRows[row].random; }
int nusselt_group_size(int row) noexcept { return kRows[row].group_size; }

void nusselt_prepare(int row, const float* lights, int columns, int groups, void* prepared) noexcept {
    kRows[row].prepare(lights, columns, groups, prepared);
}
void nusselt_sample(int row, const void* prepared, int groups, int rounds, const float* u, float* wi,
                    float* pdf, float* p) noexcept {
    kRows[row].sample(prepared, groups, rounds, u, wi, pdf, p);
}
void nusselt_pdf(int row, const void* prepared, int groups, int rounds, const float* wi,
                 float* pdf) noexcept {
    kRows[row].pdf(prepared, groups, rounds, wi, pdf);
}
void nusselt_invert(int row, const void* prepared, int groups, int rounds, const float* wi,
                    float* u) noexcept {
    kRows[row].invert(prepared, groups, rounds, wi, u);
}
void nusselt_measure(int row, const void* prepared, int groups, float* measure) noexcept {
    kRows[row].measure(prepared, groups, measure);
}
