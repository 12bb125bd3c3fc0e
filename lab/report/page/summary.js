// The summary at the top of the page and the list of contents.

function summaryNode(report) {
    const items = report.papers.flatMap(paper => paper.items);
    const counts = kStatuses.map(([status, name, meaning]) =>
        ({ kind: status, name, meaning, count: items.filter(item => item.status === status).length }));
    const states = countStates(report.experiments);
    return element("section", { id: "summary" },
        element("h2", { class: "hidden" }, "Summary"),
        element("div", { class: "counts" },
            countsNode(`${plural(items.length, "figure, table or statement", "figures, tables and statements")} of ` +
                plural(report.papers.length, "paper"), counts.filter(({ kind, count }) => kind !== "not-run" || count > 0)),
            countsNode(plural(Object.values(states).reduce((a, b) => a + b, 0), "expectation"), kStates.map(([state, , many]) =>
                ({ kind: state, name: many, meaning: null, count: states[state] })))),
        originNode(report));
}

/// A bar whose parts are as long as the counts, above the counts in words.
function countsNode(title, parts) {
    return element("section", { class: "count" }, element("h3", {}, title),
        element("div", { class: "bar", "aria-hidden": "true" }, parts.filter(part => part.count > 0).map(part =>
            element("span", { class: part.kind, style: `flex-grow: ${part.count}` }))),
        element("dl", {}, parts.map(part => element("div",
            { class: part.kind, "data-count": part.kind, title: part.meaning }, element("dt", {}, part.name), element("dd", {}, String(part.count))))));
}

function distinct(texts) {
    return [...new Set(texts.filter(text => text))];
}

/// The machines and versions that took part.
function originNode(report) {
    const machines = distinct(report.experiments.map(experiment => machineText(experiment.machine)));
    const versions = distinct(report.experiments.map(experiment => experiment.version));
    const seconds = report.experiments.reduce((sum, experiment) => sum + (experiment.seconds ?? 0), 0);
    const fact = (one, values) => values.length ? element("div", {}, element("dt", {}, values.length === 1 ? one : `${one}s`),
        element("dd", {}, values.map(value => element("p", {}, value)))) : null;
    return element("dl", { class: "origin" }, fact("Machine", machines), fact("Version", versions),
        report.experiments.length
            ? fact("Time", [`${formatSeconds(seconds)} for ${plural(report.experiments.length, "experiment")}`]) : null,
        report.not_run.length ? element("div", {}, element("dt", {}, "Not run"), element("dd", {},
            element("a", { href: "#not-run" }, plural(report.not_run.length, "experiment")))) : null);
}

function machineText({ processor, cores, instruction_set: isa, ...others }) {
    const rest = Object.entries(others).filter(([, value]) => typeof value === "string").map(([, value]) => value);
    return [processor, cores ? plural(cores, "core") : null, isa, ...rest].filter(part => part).join(", ");
}

function contentsNode(report) {
    const links = entries => element("ul", {}, entries.map(([anchor, text, mark]) =>
        element("li", {}, element("a", { href: `#${anchor}` }, text), mark)));
    // Only what asks for attention is marked.
    const markOf = experiment => {
        const counts = countStates([experiment]);
        if (counts.fails) return element("span", { class: "state fails", title: "expectations fail" }, String(counts.fails));
        if (counts.not_evaluated) return element("span", { class: "state not_evaluated",
            title: "expectations could not be evaluated" }, String(counts.not_evaluated));
        return null;
    };
    return element("nav", { class: "contents", "aria-label": "Contents" },
        element("details", { open: matchMedia("(min-width: 72rem)").matches }, element("summary", {}, "Contents"),
            element("a", { href: "#papers", class: "part" }, "Papers"),
            links(report.papers.map(paper => [paper.anchor, paper.title ?? paper.key])),
            element("a", { href: "#experiments", class: "part" }, "Experiments"),
            links(report.experiments.map(experiment => [experiment.anchor, experiment.name, markOf(experiment)])),
            report.not_run.length ? element("a", { href: "#not-run", class: "part" }, "Not run") : null));
}
