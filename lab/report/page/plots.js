// Plots of series, drawn as SVG.

const kPlot = { width: 640, height: 400, left: 92, right: 16, top: 14, bottom: 52 };
const kMarkers = [
    "M-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0z", "M-3.6 -3.6h7.2v7.2h-7.2z", "M0 -4.8L4.6 3.4H-4.6z", "M0 -5L4.6 0L0 5L-4.6 0z",
    "M0 4.8L4.6 -3.4H-4.6z",
];
const kDashes = ["", "7 3", "2 3", "9 3 2 3"];
const kSeriesColors = 8; // as many as the style sheet has

/// What makes a series different from others: the colour first, then marker and dashes as well, also for prints in grey.
function seriesStyle(index) {
    return { color: `var(--series-${index % kSeriesColors})`, marker: kMarkers[index % kMarkers.length],
             dashes: kDashes[Math.floor(index / kSeriesColors) % kDashes.length] };
}

function plotNode(plot) {
    const title = plot.title ?? "";
    let drawn;
    try {
        drawn = plot.svg ? givenPlot(plot.svg) : [drawPlot(plot), legendNode(plot.series ?? [])];
    } catch (error) {
        drawn = element("p", { class: "failure" }, `This plot cannot be drawn: ${error.message}`);
    }
    return element("figure", { class: "plot" }, element("figcaption", {}, title), drawn);
}

function drawPlot(plot) {
    const series = plot.series ?? [];
    const of = (...names) => series.flatMap(s => names.flatMap(name => s[name] ?? []));
    const x = makeAxis(plot.x_scale, of("x")), y = makeAxis(plot.y_scale, of("y", "low", "high"));
    const box = { width: kPlot.width - kPlot.left - kPlot.right, height: kPlot.height - kPlot.top - kPlot.bottom };
    const at = {
        x: value => round(kPlot.left + box.width * x.share(value)),
        y: value => round(kPlot.top + box.height * (1 - y.share(value))),
    };
    const names = series.map(s => s.label).join(", ");
    return svgElement("svg", { viewBox: `0 0 ${kPlot.width} ${kPlot.height}`, role: "img",
        "aria-label": `${plot.title}: ${plot.y_label} over ${plot.x_label} for ${names}` },
        gridNodes(x, y, at), series.map((s, i) => bandNode(s, i, x, y, at)),
        svgElement("rect", { class: "border", x: kPlot.left, y: kPlot.top, ...box }),
        series.map((s, i) => curveNode(s, i, x, y, at)),
        svgElement("text", { class: "label", x: kPlot.left + box.width / 2, y: kPlot.height - 10, "text-anchor": "middle" },
            plot.x_label ?? ""),
        svgElement("text", { class: "label", "text-anchor": "middle",
            transform: `translate(16 ${kPlot.top + box.height / 2}) rotate(-90)` }, plot.y_label ?? ""));
}

function round(value) {
    return Math.round(10 * value) / 10;
}

function gridNodes(x, y, at) {
    const bottom = kPlot.height - kPlot.bottom, right = kPlot.width - kPlot.right;
    const vertical = (value, name) =>
        svgElement("line", { class: name, x1: at.x(value), x2: at.x(value), y1: kPlot.top, y2: bottom });
    const horizontal = (value, name) =>
        svgElement("line", { class: name, x1: kPlot.left, x2: right, y1: at.y(value), y2: at.y(value) });
    return [
        x.minor.map(value => vertical(value, "minor")), y.minor.map(value => horizontal(value, "minor")),
        x.ticks.map(value => [vertical(value, "major"),
            svgElement("text", { x: at.x(value), y: bottom + 18, "text-anchor": "middle" }, tickText(value))]),
        y.ticks.map(value => [horizontal(value, "major"),
            svgElement("text", { x: kPlot.left - 7, y: at.y(value) + 4.5, "text-anchor": "end" }, tickText(value))]),
    ].flat(2);
}

/// Runs of points that the axes can show, as lists of indices. Others interrupt the curve.
function runsOf(count, isShown) {
    const runs = [[]];
    for (let i = 0; i < count; ++i)
        if (isShown(i)) runs[runs.length - 1].push(i);
        else if (runs[runs.length - 1].length) runs.push([]);
    return runs.filter(run => run.length);
}

/// The band between low and high.
function bandNode(series, index, x, y, at) {
    const { low, high } = series;
    if (!low || !high) return null;
    // A logarithmic axis has no place for 0: the band goes to its end.
    const isBelow = value => typeof value === "number" && y.isLog && value <= 0;
    const runs = runsOf(series.x.length,
        i => x.shows(series.x[i]) && y.shows(high[i]) && (y.shows(low[i]) || isBelow(low[i])));
    const lowAt = i => at.y(y.shows(low[i]) ? low[i] : y.low);
    const path = run => "M" + [...run.map(i => `${at.x(series.x[i])} ${at.y(high[i])}`),
        ...[...run].reverse().map(i => `${at.x(series.x[i])} ${lowAt(i)}`)].join("L") + "Z";
    return svgElement("path", { class: "band", d: runs.map(path).join(""), style: `--color: ${seriesStyle(index).color}` });
}

function curveNode(series, index, x, y, at) {
    const { color, marker, dashes } = seriesStyle(index);
    const runs = runsOf(series.x.length, i => x.shows(series.x[i]) && y.shows(series.y[i]));
    const point = i => `${at.x(series.x[i])} ${at.y(series.y[i])}`;
    return svgElement("g", { class: "series", style: `--color: ${color}` },
        svgElement("path", { class: "curve", d: runs.map(run => "M" + run.map(point).join("L")).join(""),
            "stroke-dasharray": dashes || null }),
        runs.flat().map(i => svgElement("path", { class: "point", d: marker, transform: `translate(${point(i)})` },
            svgElement("title", {}, pointText(series, i)))));
}

function pointText(series, i) {
    const band = series.low && series.high ? ` (${formatValue(series.low[i])} to ${formatValue(series.high[i])})` : "";
    return `${series.label}: ${formatValue(series.x[i])}, ${formatValue(series.y[i])}${band}`;
}

function legendNode(series) {
    return element("ul", { class: "legend" }, series.map((s, i) => {
        const { color, marker, dashes } = seriesStyle(i);
        return element("li", {}, svgElement("svg", { viewBox: "0 0 34 12", width: 34, height: 12, "aria-hidden": "true",
            style: `--color: ${color}` },
            svgElement("path", { class: "curve", d: "M1 6H33", "stroke-dasharray": dashes || null }),
            svgElement("path", { class: "point", d: marker, transform: "translate(17 6)" })), s.label ?? "");
    }));
}

// What a drawing may consist of. Anything that could run, load or restyle the page is left out.
const kSvgElements = new Set(("svg g defs title desc path rect line polyline polygon circle ellipse text tspan clipPath " +
    "linearGradient radialGradient stop marker use").split(" "));

function givenPlot(text) {
    const root = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
    if (root.localName !== "svg" || root.querySelector("parsererror")) throw new Error("it is no SVG");
    return element("div", { class: "given", role: "region", tabindex: 0, "aria-label": "Plot" }, harmlessCopy(root));
}

function harmlessCopy(node) {
    if (node.nodeType === Node.TEXT_NODE) return document.createTextNode(node.data);
    if (node.nodeType !== Node.ELEMENT_NODE || !kSvgElements.has(node.localName)) return null;
    const copy = svgElement(node.localName);
    for (const { name, value } of node.attributes) {
        const isLink = name === "href" || name === "xlink:href";
        if (name.startsWith("on") || name.startsWith("xmlns") || (isLink && !value.startsWith("#"))) continue;
        copy.setAttribute(isLink ? "href" : name, value);
    }
    for (const child of node.childNodes) copy.append(harmlessCopy(child) ?? "");
    return copy;
}
