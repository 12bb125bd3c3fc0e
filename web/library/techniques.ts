/// The techniques that the page compares, by the names of shaders/nusselt.

import { LightKind } from "./light_uniforms";

/// A technique for one kind of light.
export interface LightTechnique {
    /// In shaders/nusselt, without its ending.
    readonly file: string;
    readonly struct: string;
    /// What functions begin with, where it is not the name of the struct.
    readonly functions?: string;
    readonly prepare?: string;
}

/// How the specular component is sampled, in addition.
export interface LobeTechnique extends LightTechnique {
    /// The call that prepares it, for `light` and `glossy`.
    readonly prepare: string;
    /// Its integral over the light, for `specular`; "0.0" where it is unknown.
    readonly integral: string;
    readonly sample?: string;
}

export interface Technique {
    readonly name: string;
    readonly label: string;
    /// What it is and where it comes from.
    readonly source: string;
    /// How the light of each kind is sampled; null for the closed form without samples.
    readonly lights: Readonly<Record<LightKind, LightTechnique>> | null;
    /// For glossy surfaces; lights of kinds without one have samples for the whole BRDF.
    readonly lobes?: Readonly<Partial<Record<LightKind, LobeTechnique>>>;
    /// Whether the mean of many frames differs from the reference.
    readonly isBiased?: boolean;
    /// Whether heuristics apply that need to know integrals.
    readonly knowsIntegrals?: boolean;
}

const snakeCase = (name: string): string => name.replace(/\B([A-Z])/g, "_$1").toLowerCase();

export const functionsOf = (technique: LightTechnique): string => technique.functions ?? snakeCase(technique.struct);

const sampling = (struct: string, others: Partial<LightTechnique> = {}): LightTechnique =>
    ({ file: `sampling/${snakeCase(struct)}`, struct, ...others });
const related = (struct: string, others: Partial<LightTechnique> = {}): LightTechnique =>
    ({ file: `related/${snakeCase(struct)}`, struct, ...others });

const area = { polygon: sampling("PolygonArea"), line: sampling("LineArea"), cylinder: sampling("CylinderArea") };
const solidAngle = {
    polygon: sampling("PolygonSolidAngle"), line: sampling("LineSolidAngle"), cylinder: sampling("CylinderSolidAngle"),
};
const clippedLine = sampling("LineSolidAngle", { prepare: "line_clipped_solid_angle_prepare" });
const clippedSolidAngle = {
    polygon: sampling("PolygonSolidAngle", {
        file: "sampling/polygon_clipped_solid_angle", functions: "polygon_clipped_solid_angle",
    }),
    line: clippedLine,
    cylinder: sampling("CylinderSolidAngle"),
};
const projected = {
    polygon: sampling("PolygonProjectedSolidAngle"), line: sampling("LineProjectedSolidAngle"),
    cylinder: sampling("CylinderProjectedSolidAngle"),
};
const biased = { ...projected, polygon: sampling("PolygonProjectedSolidAngleBiased") };

const lobe = (kind: LightKind, struct: string, others: Partial<LobeTechnique> = {}): LobeTechnique => {
    const functions = `${kind}_ltc`;
    return {
        file: `sampling/${functions}`, struct, functions, prepare: `${functions}_prepare(light, lobe)`,
        integral: `${functions}_measure(specular)`, ...others,
    };
};
const lobesOfTubes = { line: lobe("line", "LineLtc"), cylinder: lobe("cylinder", "CylinderLtc") };
const lobes = { polygon: lobe("polygon", "PolygonLtc"), ...lobesOfTubes };
const biasedLobes = {
    polygon: lobe("polygon", "PolygonLtc", {
        file: "sampling/polygon_ltc_biased", prepare: "polygon_ltc_biased_prepare(light, lobe)",
        sample: "polygon_ltc_biased_sample",
    }),
    ...lobesOfTubes,
};
const visibleNormals = (prepare: string) => ({
    polygon: lobe("polygon", "PolygonBrdf", {
        file: "sampling/polygon_brdf", functions: "polygon_brdf", integral: "0.0",
        prepare: `polygon_brdf_prepare(light, ${prepare}(glossy.wo, glossy.alpha))`,
    }),
});

export const techniques: readonly Technique[] = [
    { name: "projected", label: "Projected solid angle", lights: projected,
        source: "Density in proportion to solid angle times cosine: Peters 2021, with changes" },
    { name: "projected_ltc", label: "Projected solid angle + LTC", lights: projected, lobes, knowsIntegrals: true,
        source: "One sample for the diffuse part, one for the specular part: Peters 2021; lobes: Heitz et al. 2016" },
    { name: "projected_ggx", label: "Projected solid angle + GGX", lights: projected,
        lobes: visibleNormals("ggx_visible_normals_prepare"),
        source: "Samples of visible normals instead of lobes, for polygons: Dupuy and Benyoub 2023" },
    { name: "projected_ggx_bounded", label: "Projected solid angle + bounded GGX", lights: projected,
        lobes: visibleNormals("ggx_bounded_visible_normals_prepare"),
        source: "Without normals that reflect below the surface: Eto and Tokuyoshi 2023" },
    { name: "biased", label: "Projected solid angle, biased", lights: biased, isBiased: true,
        source: "No iteration and fast arctangents, for polygons: Peters 2021, Sec. 6.4" },
    { name: "biased_ltc", label: "Projected solid angle + LTC, biased", lights: biased, lobes: biasedLobes, isBiased: true,
        knowsIntegrals: true, source: "The same for both parts" },
    { name: "solid_angle", label: "Solid angle", lights: solidAngle, source: "Peters 2021, Sec. 5" },
    { name: "clipped_solid_angle", label: "Solid angle above the horizon", lights: clippedSolidAngle,
        source: "The same without the part of the light below the surface" },
    { name: "area", label: "Area", lights: area, source: "Uniform on the light: Turk 1992" },
    { name: "ltc_analytic", label: "LTC in closed form, no shadows", lights: null, isBiased: true,
        source: "Heitz et al. 2016; tubes: Heitz and Hill 2017" },
    { name: "arvo", label: "Solid angle by Arvo", source: "Arvo 1995, for polygons", isBiased: true,
        lights: { ...solidAngle, polygon: related("PolygonSolidAngleArvo") } },
    { name: "projected_arvo", label: "Projected solid angle by Arvo", source: "Arvo 2001, for polygons", isBiased: true,
        lights: { ...projected, polygon: related("PolygonProjectedSolidAngleArvo") } },
    { name: "subdivision", label: "Subdivision by Ureña", source: "Ureña 2000, for polygons", isBiased: true,
        lights: { ...projected, polygon: related("PolygonSubdivisionUrena") } },
    { name: "peters", label: "Projected solid angle by Peters", source: "Peters 2021 as published",
        lights: { ...projected, polygon: related("PolygonProjectedSolidAnglePeters"), line: related("LineProjectedSolidAnglePeters") } },
    { name: "warp", label: "Solid angle, warped by Hart", source: "Hart et al. 2020: a bilinear fit of the cosine",
        lights: { ...clippedSolidAngle,
            polygon: { file: "related/polygon_warp_hart", struct: "PolygonBilinearWarpHart",
                functions: "polygon_bilinear_warp_hart", prepare: "polygon_clipped_bilinear_warp_hart_prepare" },
            line: { file: "related/line_warp_hart", struct: "LineLinearWarpHart", functions: "line_linear_warp_hart",
                prepare: "line_clipped_linear_warp_hart_prepare" } } },
    { name: "rejection", label: "Rejection, line by Li", source: "Tubes: Gamito 2016; lines: Li et al. 2018",
        lights: { ...projected, line: related("LineProjectedSolidAngleLi"),
            cylinder: related("CylinderProjectedRejectionGamito") } },
];

/// \throws Error for a name that is none of theirs
export function techniqueOf(name: string): Technique {
    const technique = techniques.find(row => row.name === name);
    if (technique === undefined) throw new Error(`there is no technique ${name}`);
    return technique;
}

/// kNusseltMis* of shaders/nusselt/estimate/mis.glsl by their numbers.
export interface Heuristic {
    readonly name: string;
    readonly label: string;
    readonly number: number;
    readonly needsIntegrals: boolean;
}

export const heuristics: readonly Heuristic[] = [
    { name: "clamped_optimal", label: "Clamped optimal", number: 3, needsIntegrals: true },
    { name: "optimal", label: "Optimal", number: 4, needsIntegrals: true },
    { name: "balance", label: "Balance", number: 0, needsIntegrals: false },
    { name: "power", label: "Power", number: 1, needsIntegrals: false },
    { name: "weighted_balance", label: "Weighted balance", number: 2, needsIntegrals: true },
    { name: "one_sample", label: "One sample of either", number: 5, needsIntegrals: true },
    { name: "separate", label: "Separate", number: 6, needsIntegrals: true },
];

export const samplers = [
    { name: "sobol", label: "Sobol’ points", constant: "kNusseltSamplerSobol" },
    { name: "independent", label: "Independent", constant: "kNusseltSamplerIndependent" },
] as const;
