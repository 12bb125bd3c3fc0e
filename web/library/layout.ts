/// Numbers that scripts and shaders share. Templates name them between @ signs.

/// Texels per row of textures that hold arrays, 2^rowBits.
const rowBits = 10;
export const rowLength = 1 << rowBits;
/// Leaves of hierarchies have fewer triangles than 2^countBits.
const countBits = 3;
export const leafSize = 1 << countBits;
/// Vertices of a polygonal light.
export const lightVertices = 4;
/// Lights of each kind.
export const mostLights = 4;
/// Pixels in a row of a block over which errors are summed up.
export const errorBlock = 16;
/// Whether shaders can calculate with a length or a radiance: up to a quarter of the largest number of single precision, as
/// differences of others may overflow.
export const isInRange = (x: number): boolean => Math.abs(x) <= 8e37;
/// Values of Material::model: two BRDFs; and tubes, which are visible, but reflect nothing and cast no shadow.
export const models = { lambert: 0, frostbite: 1, noSurface: 2 } as const;

/// The values of templates in all shaders.
export const layout: Readonly<Record<string, string>> = {
    row_bits: String(rowBits),
    count_bits: String(countBits),
    light_vertices: String(lightVertices),
    most_lights: String(mostLights),
    error_block: String(errorBlock),
    model_lambert: models.lambert.toFixed(1),
    model_frostbite: models.frostbite.toFixed(1),
    model_no_surface: models.noSurface.toFixed(1),
};
