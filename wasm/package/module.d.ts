/** `nusselt.wasm`, compressed by gzip, in base64. */
export const compressed: string;
