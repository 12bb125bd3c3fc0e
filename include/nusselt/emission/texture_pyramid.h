#pragma once
/// The mip pyramid of a texture that samples descend, from a lattice of cells to single texels.

#include <nusselt/emission/texture.h>

NUSSELT_NAMESPACE_BEGIN

/// The grids of a pyramid: each has half the columns and rows of the one before, but none fewer than the lattice.
///
/// The finest grid has the smallest powers of two that are at least as large as the texture and the lattice. Where the
/// texture is as large, its elements are the texels; otherwise they are smaller, and the radiance may vary in them.
struct PyramidShape {
    static constexpr int kMostLevels = 16;

    int cells;               ///< columns and rows of the lattice, a power of two
    int width_log2;          ///< of the finest grid
    int height_log2;         ///< of the finest grid
    int levels;              ///< number of grids; the last one is the lattice
    int size;                ///< number of elements of all grids together
    int offset[kMostLevels]; ///< index of the first element of each grid

    /// \param cells columns and rows of the lattice, a power of two.
    /// \param width, height of the texture, at most 2^14.
    NUSSELT_HD PyramidShape(int lattice_cells, int width, int height) noexcept
        : cells(lattice_cells), width_log2(0), height_log2(0), levels(0), size(0), offset{} {
        while ((1 << width_log2) < width || (1 << width_log2) < cells) ++width_log2;
        while ((1 << height_log2) < height || (1 << height_log2) < cells) ++height_log2;
        do {
            offset[levels] = size;
            size += width_of(levels) * height_of(levels);
            ++levels;
        } while (width_of(levels - 1) > cells || height_of(levels - 1) > cells);
    }

    /// Columns of a grid.
    NUSSELT_HD int width_of(int level) const noexcept { return halved(width_log2, level); }
    /// Rows of a grid.
    NUSSELT_HD int height_of(int level) const noexcept { return halved(height_log2, level); }
    /// Columns of the grid before that make one column of a grid: 1 or 2.
    NUSSELT_HD int columns_of(int level) const noexcept {
        return width_of(level - 1) > width_of(level) ? 2 : 1;
    }
    /// Rows of the grid before that make one row of a grid: 1 or 2.
    NUSSELT_HD int rows_of(int level) const noexcept {
        return height_of(level - 1) > height_of(level) ? 2 : 1;
    }
    NUSSELT_HD int index(int level, int i, int j) const noexcept {
        return offset[level] + j * width_of(level) + i;
    }

private:
    NUSSELT_HD int halved(int log2, int level) const noexcept {
        const int result = log2 > level ? 1 << (log2 - level) : 1;
        return result > cells ? result : cells;
    }
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
