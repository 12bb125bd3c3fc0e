/// The fragment shader that shades what the camera sees by one technique.

import { LightKind } from "./light_uniforms";
import { Sources, Values, assembleShader, fillTemplate } from "./shaders";
import { LightTechnique, LobeTechnique, Technique, functionsOf } from "./techniques";

const shapes: Record<LightKind, string> = { polygon: "ConvexPolygon", line: "LineSegment", cylinder: "Cylinder" };

function valuesOf(kind: LightKind, technique: LightTechnique): Values {
    const functions = functionsOf(technique);
    return {
        kind, Shape: shapes[kind], file: `nusselt/${technique.file}.glsl`, Technique: technique.struct, technique: functions,
        prepare: technique.prepare ?? `${functions}_prepare`,
        u: kind === "line" ? "u.x" : "u",
    };
}

function lobeValues(lobe: LobeTechnique): Values {
    const functions = functionsOf(lobe);
    return {
        lobe_file: `nusselt/${lobe.file}.glsl`, Lobe: lobe.struct, lobe: functions, lobe_prepare: lobe.prepare,
        lobe_sample: lobe.sample ?? `${functions}_sample`, lobe_integral: lobe.integral,
    };
}

/// The code for the lights of one kind, with #include lines: a function reflect_KIND().
export function reflectionCode(sources: Sources, kind: LightKind, technique: Technique): string {
    const template = (name: string) => sources.get(name) ?? "";
    if (technique.lights === null) return template(`analytic_${kind}.glsl`);
    const values = valuesOf(kind, technique.lights[kind]);
    const lobe = technique.lobes?.[kind];
    return lobe === undefined ? fillTemplate(template("single.glsl"), values)
                              : fillTemplate(template(lobe.integral === "0.0" ? "pair.glsl" : "lobes.glsl"), { ...values, ...lobeValues(lobe) });
}

/// \param sources those of web/shaders by their names, and of shaders/nusselt with "nusselt/" before.
/// \param sampler a constant of shaders/nusselt/random/light_random.glsl, such as "kNusseltSamplerSobol".
/// \param kinds   of lights in the scene.
export function makeImageShader(sources: Sources, technique: Technique, sampler: string, kinds: readonly LightKind[]): string {
    const loops = kinds.map(kind =>
        `    for (int i = 0; i < ${kind}_count; ++i) reflected += reflect_${kind}(surface, reflection, i);\n`);
    // Analytic integrals clip polygons twice.
    const capacity = technique.lights === null ? "#define NUSSELT_MAX_VERTICES 5\n" : "";
    const main = fillTemplate(sources.get("image.frag") ?? "", {
        includes: kinds.map(kind => reflectionCode(sources, kind, technique)).join("\n"),
        loops: loops.join(""),
        uses_lobes: String(technique.lights === null || technique.lobes !== undefined),
    });
    return assembleShader(sources, capacity + main, { sampler });
}
