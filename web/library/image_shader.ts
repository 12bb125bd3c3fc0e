/// The fragment shader that shades what the camera sees by one technique.

import { LightKind } from "./light_uniforms";
import { Sources, Values, assembleShader, fillTemplate } from "./shaders";
import { LightTechnique, Lobe, Technique } from "./techniques";

const shapes: Record<LightKind, string> = { polygon: "ConvexPolygon", line: "LineSegment", cylinder: "Cylinder" };

/// How GLSL names a technique, see docs/techniques/README.md.
interface RegistryRow {
    /// In shaders/nusselt, without its ending.
    readonly file: string;
    readonly struct: string;
    readonly functions?: string;
    readonly prepare?: string;
    readonly queries?: string;
}

/// Names of a technique, with the rules of the registry for those that it leaves out.
function namesOf(sources: Sources, technique: LightTechnique): Required<RegistryRow> {
    const registry = JSON.parse(sources.get("techniques.json") ?? "{}") as Record<string, RegistryRow>;
    const row = registry[technique];
    if (row === undefined) throw new Error(`the registry has no technique ${technique}`);
    const functions = row.functions ?? row.file.slice(row.file.lastIndexOf("/") + 1);
    return { prepare: `${functions}_prepare`, queries: functions, functions, ...row };
}

function lightValues(sources: Sources, kind: LightKind, technique: LightTechnique): Values {
    const { file, struct, functions, prepare, queries } = namesOf(sources, technique);
    return {
        kind, Shape: shapes[kind], file: `nusselt/${file}.glsl`, Technique: struct, technique: functions,
        prepare, queries, u: kind === "line" ? "x" : "xy",
    };
}

function lobeValues(sources: Sources, lobe: Lobe): Values {
    const { file, struct, functions, prepare, queries } = namesOf(sources, lobe.technique);
    return {
        lobe_file: `nusselt/${file}.glsl`, Lobe: struct, lobe: functions, lobe_queries: queries,
        lobe_prepare: `${prepare}(${lobe.arguments})`,
    };
}

/// The code for the lights of one kind, with #include lines: a function reflect_KIND().
export function reflectionCode(sources: Sources, kind: LightKind, technique: Technique): string {
    const filled = (name: string, values: Values) => fillTemplate(sources.get(`${name}.glsl`) ?? "", values);
    if (technique.lights === null) return filled(`analytic_${kind}`, {});
    const values = lightValues(sources, kind, technique.lights[kind]);
    const lobe = technique.lobes?.kinds[kind];
    return technique.lobes === undefined || lobe === undefined
        ? filled("one_technique", values)
        : filled(technique.lobes.template, { ...values, ...lobeValues(sources, lobe) });
}

/// \param sources those of web/shaders by their names, of shaders/nusselt with "nusselt/" before, and
/// "techniques.json":
///                what the registry says about GLSL.
/// \param sampler a constant of shaders/nusselt/random/light_random.glsl, such as "kNusseltSamplerSobol".
/// \param kinds   of lights in the scene.
export function makeImageShader(sources: Sources, technique: Technique, sampler: string,
    kinds: readonly LightKind[]): string {
    const loops = kinds.map(kind =>
        `    for (int i = 0; i < ${kind}_count; ++i) reflected += reflect_${kind}(surface, reflection, i);\n`);
    const isAnalytic = technique.lights === null;
    // Analytic integrals clip polygons twice.
    const capacity = isAnalytic ? "#define NUSSELT_MAX_VERTICES 5\n" : "";
    const main = fillTemplate(sources.get("image.frag") ?? "", {
        includes: kinds.map(kind => reflectionCode(sources, kind, technique)).join("\n"),
        loops: loops.join(""),
        reflection_of: isAnalytic || technique.lobes !== undefined ? "brdf_and_lobe_of" : "brdf_of",
        rejected: isAnalytic || kinds.length === 0 ? "0.0" : "rejected_samples",
    });
    return assembleShader(sources, capacity + main, { sampler });
}

/// The number of a constant of the library.
/// \param path of its file, such as "nusselt/estimate/mis.glsl"
/// \throws Error where there is none
export function constantOf(sources: Sources, path: string, name: string): number {
    const found = new RegExp(`const int ${name} = (\\d+);`).exec(sources.get(path) ?? "");
    if (found === null) throw new Error(`${path} has no constant ${name}`);
    return Number(found[1]);
}
