/// Puts shaders together from the files of shaders/nusselt and others that include them.

import { layout } from "./layout";

/// Texts of files by their paths, such as "nusselt/core/real.glsl".
export type Sources = ReadonlyMap<string, string>;

/// Texts that take the place of "@name@" in templates.
export type Values = Readonly<Record<string, string>>;

export function fillTemplate(text: string, values: Values): string {
    return text.replace(/@(\w+)@/g, (_, name: string) => {
        const value = values[name];
        if (value === undefined) throw new Error(`no value for @${name}@`);
        return value;
    });
}

function resolve(folder: string[], path: string): string {
    const parts = path.startsWith(".") ? [...folder] : [];
    for (const part of path.split("/")) {
        if (part === "..") parts.pop();
        else if (part !== ".") parts.push(part);
    }
    return parts.join("/");
}

/// The text with the files that it includes in place of its #include lines, each file once. Paths that begin with a
/// dot are relative to the file that has them, others to the root of the sources.
function flatten(sources: Sources, path: string, text: string, seen: Set<string>): string {
    const folder = path.split("/").slice(0, -1);
    return text.replace(/^#include "(.+)"\n/gm, (_, name: string) => {
        const included = resolve(folder, name);
        if (seen.has(included)) return "";
        seen.add(included);
        const found = sources.get(included);
        if (found === undefined) throw new Error(`${path || "a shader"} includes ${name}, which is missing`);
        return flatten(sources, included, found, seen);
    });
}

/// A part of a shader with all that it includes.
/// \param text   of its main file.
/// \param values of the templates in all of its files.
export function assemblePart(sources: Sources, text: string, values: Values = {}): string {
    return fillTemplate(flatten(sources, "", text, new Set()), { ...layout, ...values });
}

/// A complete shader for WebGL 2; parameters as above.
export function assembleShader(sources: Sources, text: string, values: Values = {}): string {
    return "#version 300 es\n" + assemblePart(sources, text, values);
}
