#pragma once
/// The mip pyramid of a texture that samples descend, from a lattice of cells to single texels.

#include <nusselt/emission/texture.h>

NUSSELT_NAMESPACE_BEGIN

/// The grids of a pyramid: each has half the columns and rows of the one before, but none fewer than the lattice.
///
/// The finest grid has the smallest powers of two that are at least as large as the texture and the lattice. Where the
/// texture is as large, its elements are the texels; otherwise they are smaller, and the radiance may vary in them. The parts
/// of an element are next to each other, so that a step of a descent reads one line of the cache.
struct PyramidShape {
    static constexpr int kMostLevels = 16;

    int cells_log2;          ///< of columns and rows of the lattice
    int width_log2;          ///< of the finest grid
    int height_log2;         ///< of the finest grid
    int levels;              ///< number of grids; the last one is the lattice
    int size;                ///< number of elements of all grids together
    int offset[kMostLevels]; ///< index of the first element of each grid

    /// \param lattice_cells columns and rows of the lattice, a power of two.
    /// \param width, height of the texture, at most 2^14.
    NUSSELT_HD PyramidShape(int lattice_cells, int width, int height) noexcept
        : cells_log2(0), levels(0), size(0), offset{} {
        while ((1 << cells_log2) < lattice_cells) ++cells_log2;
        width_log2 = height_log2 = cells_log2;
        while ((1 << width_log2) < width) ++width_log2;
        while ((1 << height_log2) < height) ++height_log2;
        levels = 1 + larger(width_log2, height_log2) - cells_log2;
        for (int level = 0; level < levels; ++level) {
            offset[level] = size;
            size += width_of(level) * height_of(level);
        }
    }

    /// Columns of a grid.
    NUSSELT_HD int width_of(int level) const noexcept { return 1 << larger(width_log2 - level, cells_log2); }
    /// Rows of a grid.
    NUSSELT_HD int height_of(int level) const noexcept {
        return 1 << larger(height_log2 - level, cells_log2);
    }
    /// Columns of the grid before that make one column of a grid: 1 or 2.
    NUSSELT_HD int columns_of(int level) const noexcept { return width_log2 - level >= cells_log2 ? 2 : 1; }
    /// Rows of the grid before that make one row of a grid: 1 or 2.
    NUSSELT_HD int rows_of(int level) const noexcept { return height_log2 - level >= cells_log2 ? 2 : 1; }
    /// Where an element is in arrays of all elements.
    NUSSELT_HD int index(int level, int i, int j) const noexcept {
        if (level + 1 == levels) return offset[level] + (j << cells_log2) + i;
        const int columns_log2 = columns_of(level + 1) - 1;
        const int rows_log2 = rows_of(level + 1) - 1;
        const int element = (j >> rows_log2) * width_of(level + 1) + (i >> columns_log2);
        const int part = ((j & rows_log2) << columns_log2) + (i & columns_log2);
        return offset[level] + (element << (columns_log2 + rows_log2)) + part;
    }

private:
    NUSSELT_HD static constexpr int larger(int a, int b) noexcept { return a > b ? a : b; }
};

/// Weights of a pyramid: the mean over each element of what the light emits there, averaged over channels. Elements of
/// which only a part belongs to the light count the rest as dark.
template <class T>
struct TexturePyramid {
    PyramidShape shape;
    const T* weight; ///< shape.size numbers, owned by the caller

    NUSSELT_HD T at(int level, int i, int j) const noexcept { return weight[shape.index(level, i, j)]; }
};

/// Fills all grids but the finest one with means of the finer one.
template <class T>
NUSSELT_HD inline void fill_pyramid(const PyramidShape& shape, T* weight) noexcept {
    for (int level = 1; level < shape.levels; ++level) {
        const int columns = shape.columns_of(level);
        const int rows = shape.rows_of(level);
        const T share = T(1) / static_cast<T>(columns * rows);
        for (int j = 0; j < shape.height_of(level); ++j) {
            for (int i = 0; i < shape.width_of(level); ++i) {
                T sum = T(0);
                for (int row = 0; row < rows; ++row)
                    for (int column = 0; column < columns; ++column)
                        sum += weight[shape.index(level - 1, columns * i + column, rows * j + row)];
                weight[shape.index(level, i, j)] = share * sum;
            }
        }
    }
}

NUSSELT_NAMESPACE_END
