// Typesets formulas by KaTeX. Input: a JSON array of { tex, display }; output: one of HTML.
"use strict";

const katex = require(process.argv[2]);
const formulas = JSON.parse(require("fs").readFileSync(0, "utf8"));
console.log(JSON.stringify(formulas.map(({ tex, display }) => katex.renderToString(tex, { displayMode: display, strict: "error" }))));
