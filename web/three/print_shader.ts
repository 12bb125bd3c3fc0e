/// Run by Node.js while the module is built: reads all sources as JSON from its input, and writes the part of the
/// fragment shader that three.js materials get.

import { reflectionCode } from "../library/image_shader";
import { assemblePart, fillTemplate } from "../library/shaders";
import { techniqueOf } from "../library/techniques";

declare const process: { readonly stdin: AsyncIterable<Uint8Array>; readonly stdout: { write(text: string): void } };
declare const Buffer: { concat(parts: Uint8Array[]): Uint8Array };

async function main(): Promise<void> {
    const parts: Uint8Array[] = [];
    for await (const part of process.stdin) parts.push(part);
    const sources = new Map(Object.entries(JSON.parse(new TextDecoder().decode(Buffer.concat(parts))) as Record<string, string>));
    const technique = techniqueOf("projected_ltc");
    const includes = (["polygon", "line"] as const).map(kind => reflectionCode(sources, kind, technique)).join("\n");
    const text = assemblePart(sources, fillTemplate(sources.get("area_lights.glsl") ?? "", { includes }),
        { sampler: "kNusseltSamplerSobol" });
    // Comments would be a third of the module.
    process.stdout.write(text.replace(/\/\/.*$/gm, "").replace(/[ \t]+$/gm, "").replace(/\n{2,}/g, "\n"));
}

void main();
