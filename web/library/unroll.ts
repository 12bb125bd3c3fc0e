/// Unrolls the loops over vertices and sectors of lights in shaders, those that NUSSELT_UNROLL marks. Compilers that do
/// not do so themselves keep arrays in memory and look up each element; docs/performance.md, entry 126, has numbers.

// Only those that count upwards: with others, too, no array of projected solid angle sampling would be left, and the
// driver on the processor took six times as long to compile.
const loop = /NUSSELT_UNROLL\s+for\s*\(int (\w+) = ([^;]+); \1 < ([^;]+); \+\+\1\)/;

/// The value of a sum or difference of products of integers and constants, null for what is none.
function valueOf(text: string, constants: ReadonlyMap<string, string>): number | null {
    const tokens = text.match(/\w+|\S/g) ?? [];
    let at = 0;
    const atom = (): number => {
        const token = tokens[at++] ?? "";
        if (token === "(") {
            const inner = sum();
            return tokens[at++] === ")" ? inner : NaN;
        }
        const constant = constants.get(token);
        return /^\d+$/.test(token) ? Number(token) : constant === undefined ? NaN : valueOf(constant, constants) ?? NaN;
    };
    const product = (): number => {
        let value = atom();
        while (tokens[at] === "*") { ++at; value *= atom(); }
        return value;
    };
    const sum = (): number => {
        let value = product();
        while (tokens[at] === "+" || tokens[at] === "-") value += tokens[at++] === "+" ? product() : -product();
        return value;
    };
    const value = sum();
    return at === tokens.length && Number.isInteger(value) ? value : null;
}

/// Where a bracket that opens at a place closes, plus one.
function closed(text: string, at: number): number {
    let depth = 0;
    do {
        if ("({".includes(text[at])) ++depth;
        else if (")}".includes(text[at])) --depth;
        ++at;
    } while (depth > 0 && at < text.length);
    return at;
}

/// Where the statement that begins at a place ends.
function endOfStatement(text: string, begin: number): number {
    const at = begin + text.slice(begin).search(/\S/);
    if (text[at] === "{") return closed(text, at);
    const head = /^(?:NUSSELT_UNROLL\s+)?(for|if)\s*(?=\()/.exec(text.slice(at, at + 80));
    if (head === null) return text.indexOf(";", at) + 1;
    const end = endOfStatement(text, closed(text, at + head[0].length));
    const other = head[1] === "if" ? /^\s*else\b/.exec(text.slice(end, end + 200)) : null;
    return other === null ? end : endOfStatement(text, end + other[0].length);
}

/// Takes away `if (a < b)` for numbers, with the statement behind it if it is false: there, indices may be out of
/// bounds.
function withoutConditions(text: string, constants: ReadonlyMap<string, string>): string {
    const condition = /if \(([^()<&|]+)<([^()<&|=]+)\) /g;
    for (let found = condition.exec(text); found !== null; found = condition.exec(text)) {
        const [a, b] = [valueOf(found[1], constants), valueOf(found[2], constants)];
        if (a === null || b === null) continue;
        const body = found.index + found[0].length;
        text = text.slice(0, found.index) + text.slice(a < b ? body : endOfStatement(text, body));
        condition.lastIndex = found.index;
    }
    return text;
}

/// \param text of a complete shader.
/// \returns    the same without comments and marked loops. Loops with other bounds than numbers and constants remain.
export function unrollLoops(text: string): string {
    let rest = text.replace(/\/\/.*$/gm, "");
    const constants = new Map([...rest.matchAll(/const int (\w+) = ([^;]+);/g)]
        .map(([, name, value]) => [name, value]));
    // The first definition counts: the others stand behind #ifndef.
    const capacity = /#define NUSSELT_MAX_VERTICES (\d+)/.exec(rest);
    if (capacity !== null) constants.set("NUSSELT_MAX_VERTICES", capacity[1]);
    let done = "";
    for (let found = loop.exec(rest); found !== null; found = loop.exec(rest)) {
        const [head, name, first, bound] = found;
        const [begin, end] = [valueOf(first, constants), valueOf(bound, constants)];
        const after = found.index + head.length;
        done += rest.slice(0, found.index);
        if (begin === null || end === null) {
            done += head;
            rest = rest.slice(after);
            continue;
        }
        const stop = endOfStatement(rest, after);
        const body = rest.slice(after, stop);
        const variable = new RegExp(`\\b${name}\\b`, "g");
        const parts = Array.from({ length: Math.max(end - begin, 0) }, (_, i) =>
            `{${withoutConditions(body.replace(variable, String(begin + i)), constants)} }`);
        // Loops in the body are unrolled next.
        rest = `{ ${parts.join("\n")} }` + rest.slice(stop);
    }
    return done + rest;
}
