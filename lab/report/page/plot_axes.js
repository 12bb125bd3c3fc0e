// Axes of plots.

/// The range and the ticks of an axis, from all numbers that it has to show. A logarithmic axis shows positive numbers
/// only.
function makeAxis(scale, numbers) {
    const isLog = scale === "log";
    const shown = numbers.filter(x => typeof x === "number" && Number.isFinite(x) && (!isLog || x > 0));
    let low = shown.reduce((a, b) => Math.min(a, b), Infinity);
    let high = shown.reduce((a, b) => Math.max(a, b), -Infinity);
    if (shown.length === 0) [low, high] = isLog ? [1, 10] : [0, 1];
    [low, high] = isLog ? logRange(low, high) : linearRange(low, high);
    const transformed = x => isLog ? Math.log(x) : x;
    return {
        isLog, low, high,
        shows: x => typeof x === "number" && Number.isFinite(x) && (!isLog || x > 0),
        /// Where a number is, from 0 to 1.
        share: x => (transformed(x) - transformed(low)) / (transformed(high) - transformed(low)),
        ...(isLog ? logTicks(low, high) : linearTicks(low, high)),
    };
}

function logRange(low, high) {
    const factor = Math.max((high / low) ** 0.04, high < 2 * low ? Math.SQRT2 : 1);
    return [low / factor, high * factor];
}

function linearRange(low, high) {
    if (low === high) return low === 0 ? [-1, 1] : [low - Math.abs(low) / 2, high + Math.abs(high) / 2];
    const margin = 0.04 * (high - low);
    // An axis that nearly reaches 0 includes it: heights can then be compared.
    const includesZero = low > 0 && low < 0.3 * high;
    return [low === 0 || includesZero ? 0 : low - margin, high + margin];
}

/// Powers of ten, with 2 and 5 times them where these are few, and without some where they are many.
function logTicks(low, high) {
    const first = Math.ceil(Math.log10(low) - 1e-9), last = Math.floor(Math.log10(high) + 1e-9);
    const stride = Math.max(1, Math.ceil((last - first + 1) / 7));
    const ticks = [], minor = [];
    for (let e = first - 1; e <= last; ++e)
        for (let digit = 1; digit < 10; ++digit) {
            const x = Number(`${digit}e${e}`);
            if (x < low || x > high) continue;
            const isLabelled = digit === 1 ? (e - first) % stride === 0 : last - first < 2 && (digit === 2 || digit === 5);
            if (isLabelled) ticks.push(x);
            else if (stride === 1) minor.push(x);
        }
    return { ticks, minor };
}

function linearTicks(low, high) {
    const rough = (high - low) / 6;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find(digit => digit * power >= rough);
    const ticks = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
        ticks.push(Number((i * step).toPrecision(12)));
    return { ticks, minor: [] };
}

/// Short texts of ticks: 0.01, 100 and 20000, but powers for sizes far from 1.
function tickText(x) {
    const size = Math.abs(x);
    if (size !== 0 && (size < 1e-3 || size >= 1e5)) return minus(x.toExponential().replace("e+", "e"));
    return minus(String(x));
}
