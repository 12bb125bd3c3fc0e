// Texts for numbers. What is no number, such as null for values that are not finite, never looks like one.

const kMissing = "–";

/// Four significant digits, as far as they say something: 1200, 0.9307, 1.235e-5. Whole numbers below a million are exact.
function formatNumber(value, digits = 4) {
    if (typeof value !== "number" || !Number.isFinite(value)) return kMissing;
    if (Number.isInteger(value) && Math.abs(value) < 1e6) return minus(String(value));
    const size = Math.abs(value);
    if (size < 1e-3 || size >= 1e6)
        return minus(value.toExponential(digits - 1).replace(/\.?0+e/, "e").replace("e+", "e"));
    const text = value.toPrecision(digits);
    // 12345.6 would become 1.235e+4, with fewer digits than it has before the point.
    return minus(text.includes("e") ? String(Math.round(value)) : text);
}

function minus(text) {
    return text.replace(/^-/, "−");
}

/// Any cell of a table or value of a paper.
function formatValue(value) {
    if (value === null || value === undefined) return kMissing;
    if (typeof value === "number") return formatNumber(value);
    if (typeof value === "boolean") return value ? "yes" : "no";
    if (typeof value === "object") return JSON.stringify(value);
    return String(value);
}

function withUnit(value, unit) {
    const text = formatValue(value);
    return unit && text !== kMissing ? `${text} ${unit}` : text;
}

/// A cell that shows few digits and, where the pointer rests, all of them.
function valueNode(value, unit) {
    const isNumber = typeof value === "number";
    const title = isNumber ? String(value) : value === null ? "not a finite number" : null;
    return element("span", { class: isNumber || value === null ? "number" : null, title }, withUnit(value, unit));
}

function formatSeconds(seconds) {
    if (typeof seconds !== "number") return kMissing;
    if (seconds < 100) return `${formatNumber(seconds, 3)} s`;
    const minutes = Math.round(seconds / 60);
    return minutes < 100 ? `${minutes} min` : `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}

/// The day and minute of an ISO date as it was written; no time zone is guessed.
function formatDate(text) {
    return String(text ?? kMissing).replace(/^(\d{4}-\d\d-\d\d)T(\d\d:\d\d).*$/, "$1 $2");
}

function plural(count, one, many = `${one}s`) {
    return `${count} ${count === 1 ? one : many}`;
}
