/// The techniques that the page compares.

import { LightKind } from "./light_uniforms";

/// A technique of include/nusselt/techniques.json for one kind of light, by its name.
export type LightTechnique = string;

/// How the specular component is sampled, in addition.
export interface Lobe {
    readonly technique: LightTechnique;
    /// What it is prepared for, in terms of `light`, `lobe` and `glossy`.
    readonly arguments: string;
}

/// Techniques for the specular component, and the template of web/shaders that combines them with one for the diffuse
/// component: "two_lobes" takes both samples from lobes, "light_and_lobe" does without the integrals of lobes.
export interface Lobes {
    readonly template: "two_lobes" | "light_and_lobe";
    /// Lights of kinds without one have samples for the whole BRDF.
    readonly kinds: Readonly<Partial<Record<LightKind, Lobe>>>;
}

export interface Technique {
    readonly name: string;
    readonly label: string;
    /// What it is and where it comes from.
    readonly source: string;
    /// How the light of each kind is sampled; null for the closed form without samples.
    readonly lights: Readonly<Record<LightKind, LightTechnique>> | null;
    /// For glossy surfaces.
    readonly lobes?: Lobes;
    /// Whether the mean of many frames differs from the reference.
    readonly isBiased?: boolean;
    /// Whether its loops remain: unrolled, they take minutes to compile without a GPU.
    readonly keepsLoops?: boolean;
}

const area = { polygon: "PolygonArea", line: "LineArea", cylinder: "CylinderArea" };
const solidAngle = { polygon: "PolygonSolidAngle", line: "LineSolidAngle", cylinder: "CylinderSolidAngle" };
const clippedSolidAngle = {
    polygon: "PolygonClippedSolidAngle", line: "LineClippedSolidAngle", cylinder: "CylinderSolidAngle",
};
const projected = {
    polygon: "PolygonProjectedSolidAngle", line: "LineProjectedSolidAngle", cylinder: "CylinderProjectedSolidAngle",
};
const biased = { ...projected, polygon: "PolygonProjectedSolidAngleBiased" };

const lobe = (technique: LightTechnique): Lobe => ({ technique, arguments: "light, lobe" });
const tubes = { line: lobe("LineLtc"), cylinder: lobe("CylinderLtc") };
const twoLobes = (kinds: Lobes["kinds"]): Lobes => ({ template: "two_lobes", kinds });
const ltc = twoLobes({ polygon: lobe("PolygonLtc"), ...tubes });
const clippedLtc = twoLobes({ ...tubes, polygon: lobe("PolygonClippedLtc"), line: lobe("LineClippedLtc") });
const biasedLtc = twoLobes({ polygon: lobe("PolygonLtcBiased"), ...tubes });

/// \param prepare makes a distribution of visible normals
const visibleNormals = (prepare: string): Lobes => ({
    template: "light_and_lobe",
    kinds: { polygon: { technique: "PolygonBrdf", arguments: `light, ${prepare}(glossy.wo, glossy.alpha)` } },
});

export const techniques: readonly Technique[] = [
    { name: "projected", label: "Projected solid angle", lights: projected,
        source: "Density in proportion to solid angle times cosine: Peters 2021, with changes" },
    { name: "projected_ltc", label: "Projected solid angle + LTC", lights: projected, lobes: ltc,
        source: "One sample for the diffuse part, one for the specular part: Peters 2021; lobes: Heitz et al. 2016" },
    { name: "clipped_ltc", label: "Projected solid angle + LTC above the horizon", lights: projected, lobes: clippedLtc,
        source: "Lobes without the part of the light below the surface, where their samples would be lost" },
    { name: "projected_ggx", label: "Projected solid angle + GGX", lights: projected,
        lobes: visibleNormals("ggx_visible_normals_prepare"),
        source: "Samples of visible normals instead of lobes, for polygons: Dupuy and Benyoub 2023" },
    { name: "projected_ggx_bounded", label: "Projected solid angle + bounded GGX", lights: projected,
        lobes: visibleNormals("ggx_bounded_visible_normals_prepare"),
        source: "Without normals that reflect below the surface: Eto and Tokuyoshi 2023" },
    { name: "biased", label: "Projected solid angle, biased", lights: biased, isBiased: true,
        source: "No iteration and fast arctangents, for polygons: Peters 2021, Sec. 6.4" },
    { name: "biased_ltc", label: "Projected solid angle + LTC, biased", lights: biased, lobes: biasedLtc,
        isBiased: true,
        source: "No iteration and fast arctangents for both parts of the BRDF, for polygons: Peters 2021, Sec. 6.4" },
    { name: "solid_angle", label: "Solid angle", lights: solidAngle, source: "Peters 2021, Sec. 5" },
    { name: "clipped_solid_angle", label: "Solid angle above the horizon", lights: clippedSolidAngle,
        source: "Solid angle sampling without the part of the light below the surface" },
    { name: "area", label: "Area", lights: area, source: "Uniform on the light: Turk 1992" },
    { name: "ltc_analytic", label: "LTC in closed form, no shadows", lights: null, isBiased: true,
        keepsLoops: true, source: "Heitz et al. 2016; tubes: Heitz and Hill 2017" },
    { name: "arvo", label: "Solid angle by Arvo", source: "Arvo 1995, for polygons", isBiased: true,
        lights: { ...solidAngle, polygon: "PolygonSolidAngleArvo" } },
    { name: "projected_arvo", label: "Projected solid angle by Arvo", source: "Arvo 2001, for polygons", isBiased: true,
        lights: { ...projected, polygon: "PolygonProjectedSolidAngleArvo" } },
    { name: "bisection", label: "Projected solid angle by bisection", isBiased: true,
        source: "Six bisections in place of the iteration of Arvo 2001, for polygons",
        lights: { ...projected, polygon: "PolygonProjectedSolidAngleBisection" } },
    { name: "subdivision", label: "Subdivision by Ureña", source: "Ureña 2000, for polygons", isBiased: true,
        keepsLoops: true, lights: { ...projected, polygon: "PolygonSubdivisionUrena" } },
    { name: "peters", label: "Projected solid angle by Peters", source: "Peters 2021 as published",
        lights: { ...projected, polygon: "PolygonProjectedSolidAnglePeters", line: "LineProjectedSolidAnglePeters" } },
    { name: "peters_solid_angle", label: "Solid angle by Peters", source: "Peters 2021, Sec. 5, as published",
        lights: { ...solidAngle, polygon: "PolygonSolidAnglePeters", line: "LineSolidAnglePeters" } },
    { name: "warp", label: "Solid angle above the horizon, bilinear warp by Hart",
        source: "Hart et al. 2020: a bilinear fit of the cosine",
        lights: { ...clippedSolidAngle, polygon: "PolygonClippedBilinearWarpHart",
            line: "LineClippedLinearWarpHart" } },
    { name: "quadratic_warp", label: "Solid angle above the horizon, biquadratic warp by Hart",
        source: "Hart et al. 2020: a biquadratic fit of the cosine",
        lights: { ...clippedSolidAngle, polygon: "PolygonClippedBiquadraticWarpHart",
            line: "LineClippedQuadraticWarpHart" } },
    { name: "unclipped_warp", label: "Solid angle, bilinear warp by Hart", source: "Hart et al. 2020, without clipping",
        lights: { ...solidAngle, polygon: "PolygonBilinearWarpHart", line: "LineLinearWarpHart" } },
    { name: "unclipped_quadratic_warp", label: "Solid angle, biquadratic warp by Hart",
        source: "Hart et al. 2020, without clipping",
        lights: { ...solidAngle, polygon: "PolygonBiquadraticWarpHart", line: "LineQuadraticWarpHart" } },
    { name: "rejection", label: "Rejection, line by Li", source: "Tubes: Gamito 2016; lines: Li et al. 2018",
        lights: { ...projected, line: "LineProjectedSolidAngleLi", cylinder: "CylinderProjectedRejectionGamito" } },
];

/// Whether heuristics apply that need to know integrals.
export const knowsIntegrals = (technique: Technique): boolean => technique.lobes?.template === "two_lobes";

/// \throws Error for a name that is none of theirs
export function techniqueOf(name: string): Technique {
    const technique = techniques.find(row => row.name === name);
    if (technique === undefined) throw new Error(`there is no technique ${name}`);
    return technique;
}

export interface Heuristic {
    readonly name: string;
    readonly label: string;
    /// Of shaders/nusselt/estimate/mis.glsl.
    readonly constant: string;
    readonly needsIntegrals: boolean;
}

export const heuristics: readonly Heuristic[] = [
    { name: "clamped_optimal", label: "Clamped optimal", constant: "kNusseltMisClampedOptimal", needsIntegrals: true },
    { name: "optimal", label: "Optimal", constant: "kNusseltMisOptimal", needsIntegrals: true },
    { name: "balance", label: "Balance", constant: "kNusseltMisBalance", needsIntegrals: false },
    { name: "power", label: "Power", constant: "kNusseltMisPower", needsIntegrals: false },
    { name: "weighted_balance", label: "Weighted balance", constant: "kNusseltMisWeightedBalance",
        needsIntegrals: true },
    { name: "one_sample", label: "One sample of either", constant: "kNusseltMisOneSample", needsIntegrals: true },
    { name: "separate", label: "Separate", constant: "kNusseltMisSeparate", needsIntegrals: true },
];

export const samplers = [
    { name: "sobol", label: "Sobol’ points", constant: "kNusseltSamplerSobol" },
    { name: "independent", label: "Independent", constant: "kNusseltSamplerIndependent" },
] as const;
