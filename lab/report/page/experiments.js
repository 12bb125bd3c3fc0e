// Sections of experiments.

function experimentsNode(report) {
    return element("section", { id: "experiments" }, element("h2", {}, "Experiments"),
        report.experiments.length === 0 ? element("p", {}, "This report has no experiments.") : null,
        report.experiments.map(experiment => experimentNode(experiment, report)));
}

function experimentNode(experiment, report) {
    return element("section", { class: "experiment", id: experiment.anchor, "data-experiment": experiment.name },
        element("h3", {}, experiment.name, element("a", { class: "anchor", href: `#${experiment.anchor}`,
            "aria-label": `Link to ${experiment.name}` }, "#")),
        element("p", { class: "source" }, experiment.source ?? "", backLinks(experiment, report)),
        paragraphs(experiment.description),
        paragraphs(experiment.setting),
        experiment.command ? copyable(experiment.command, "command") : null,
        provenanceNode(experiment),
        experiment.expectations.length ? element("section", {}, element("h4", {}, "Expectations"),
            element("ul", { class: "expectations" }, experiment.expectations.map(expectationNode))) : null,
        experiment.later ? laterNode(experiment.later) : null,
        imagesNode(experiment),
        experiment.plots.length ? element("section", {}, element("h4", {}, "Plots"),
            element("div", { class: "plots" }, experiment.plots.map(plotNode))) : null,
        experiment.tables.length
            ? element("section", {}, element("h4", {}, "Tables"), experiment.tables.map(tableNode)) : null);
}

/// What a quick run found after the full one, whose numbers the section has.
function laterNode({ date, version, expectations }) {
    return element("section", { class: "later" },
        element("h4", {}, `A later quick run, ${formatDate(date)}, version ${version}`),
        element("ul", { class: "expectations" }, expectations.map(expectationNode)));
}

/// Links to the items of papers that the experiment serves.
function backLinks(experiment, report) {
    return report.papers.flatMap(paper => paper.items).filter(item => item.experiments.includes(experiment))
        .map(item => [" ", element("a", { class: "back", href: `#${item.anchor}` }, item.item)]);
}

function expectationNode(expectation) {
    const state = stateOf(expectation);
    const [, name] = kStates.find(([key]) => key === state);
    return element("li", { class: state, "data-state": state }, element("span", { class: `state ${state}` }, name),
        element("span", { class: "text" }, expectation.text ?? "",
            expectation.reason ? element("span", { class: "note" }, ` ${expectation.reason}`) : null));
}

function definitions(pairs) {
    return pairs.filter(([, value]) => value !== undefined && value !== null && value !== "").map(([name, value]) =>
        element("div", {}, element("dt", {}, String(name).replaceAll("_", " ")), element("dd", {}, valueNode(value))));
}

/// Where the numbers come from: what a reader needs to repeat the experiment.
function provenanceNode(experiment) {
    const settings = Object.entries(experiment.settings);
    return element("div", { class: "provenance" },
        element("dl", { class: "facts" }, definitions([
            ["effort", experiment.effort], ["time", formatSeconds(experiment.seconds)], ["date", formatDate(experiment.date)],
            ["version", experiment.version], ...Object.entries(experiment.machine)])),
        settings.length ? element("details", { class: "settings" }, element("summary", {}, plural(settings.length, "setting")),
            element("dl", { class: "facts" }, definitions(settings))) : null);
}

function notRunNode(report) {
    if (report.not_run.length === 0) return null;
    return element("section", { id: "not-run" }, element("h2", {}, "Not run"),
        element("dl", { class: "not-run" }, report.not_run.map(skipped =>
            element("div", { id: skipped.anchor }, element("dt", {}, skipped.name),
                element("dd", {}, skipped.reason ?? "no reason is given")))));
}
