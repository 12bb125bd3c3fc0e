/** The library with its module in the same file: nothing is fetched, so pages from disk can use it. */
import { instantiate, type Nusselt } from "./bare.js";
import { compressed } from "./module.js";

export * from "./bare.js";

/** What all browsers with vector instructions in WebAssembly have; TypeScript knows it from version 5.1 on. */
declare const DecompressionStream: new (format: "gzip") => ReadableWritablePair<Uint8Array, Uint8Array>;

let compiled: Promise<WebAssembly.Module> | undefined;

async function compile(): Promise<WebAssembly.Module> {
    const bytes = Uint8Array.from(atob(compressed), letter => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return WebAssembly.compile(await new Response(stream).arrayBuffer());
}

/** A new instance of the module that this file contains, with memory of its own. The first call compiles it. */
export async function load(): Promise<Nusselt> {
    return instantiate(await (compiled ??= compile()));
}
