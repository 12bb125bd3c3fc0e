// What the report says about items of papers and expectations, in one place: the summary, the tables of papers and the
// sections of experiments all ask here.

const kStatuses = [
    ["reproduced", "reproduced", "measured here with the scene of the paper"],
    ["own", "own scene", "measured here with a scene of our own"],
    ["partly", "partly", "measured here, but it lacks something, or an expectation does not hold or could not be evaluated"],
    ["not-applicable", "not applicable", "does not concern this library"],
    ["missing", "missing", "nobody has done it yet"],
    ["not-run", "not run", "has an experiment, which is not part of this report"],
];

const kStates = [
    ["holds", "holds", "hold"],
    ["fails", "fails", "fail"],
    ["not_evaluated", "not evaluated", "could not be evaluated"],
];

/// Reads what the report has and fills in what it may leave out.
function readReport(text) {
    const data = JSON.parse(text);
    const list = (owner, name, what) => {
        const value = owner[name] ?? [];
        if (!Array.isArray(value)) throw new Error(`${what} has no list '${name}'`);
        return value;
    };
    if (data === null || typeof data !== "object" || !Array.isArray(data.papers) || !Array.isArray(data.experiments))
        throw new Error("it has no lists 'papers' and 'experiments'");
    const report = {
        title: data.title ?? "Report", generated: data.generated, not_run: list(data, "not_run", "the report"),
        papers: data.papers.map(paper => ({ ...paper, items: list(paper, "items", `paper ${paper.key}`) })),
        experiments: data.experiments.map(experiment => {
            const filled = { ...experiment, settings: experiment.settings ?? {}, machine: experiment.machine ?? {} };
            for (const name of ["tables", "expectations", "images", "insets", "plots", "measured"])
                filled[name] = list(experiment, name, `experiment ${experiment.name}`);
            return filled;
        }),
    };
    for (const experiment of report.experiments) experiment.anchor = makeAnchor("experiment", experiment.name);
    for (const skipped of report.not_run) skipped.anchor = makeAnchor("not-run", skipped.name);
    for (const paper of report.papers) {
        paper.anchor = makeAnchor("paper", paper.key);
        for (const item of paper.items) {
            item.anchor = makeAnchor("item", item.id);
            const names = list(item, "by", `item ${item.id}`);
            item.experiments = report.experiments.filter(experiment => names.includes(experiment.name));
            item.status = statusOf(item);
        }
    }
    return report;
}

/// Expectations of an experiment, and of a quick run of it that came later.
function allExpectations(experiment) {
    return [...experiment.expectations, ...(experiment.later?.expectations ?? [])];
}

/// A reason why an item is missing or not applicable counts more than experiments that name it.
function statusOf(item) {
    if (item.not_applicable) return "not-applicable";
    if (item.missing || !item.by?.length) return "missing";
    if (item.experiments.length === 0) return "not-run";
    if (item.lacks || item.experiments.flatMap(allExpectations).some(expectation => stateOf(expectation) !== "holds"))
        return "partly";
    return item.scene === "own" ? "own" : "reproduced";
}

/// Anything but a known state is one that could not be evaluated, never a success.
function stateOf(expectation) {
    return kStates.some(([state]) => state === expectation.state) ? expectation.state : "not_evaluated";
}

/// How many of the experiments' expectations have each state.
function countStates(experiments) {
    const counts = { holds: 0, fails: 0, not_evaluated: 0 };
    for (const expectation of experiments.flatMap(allExpectations)) ++counts[stateOf(expectation)];
    return counts;
}

/// Pairs of published and measured values of an item, by quantity. What has no counterpart stays alone.
function comparisons(item) {
    const measured = item.experiments.flatMap(experiment =>
        experiment.measured.filter(m => m.item === item.id).map(m => ({ ...m, experiment })));
    const rows = (item.published ?? []).flatMap(published => {
        const partners = measured.filter(m => m.quantity === published.quantity);
        return (partners.length ? partners : [null]).map(m => ({ quantity: published.quantity, published, measured: m }));
    });
    const known = new Set((item.published ?? []).map(published => published.quantity));
    return rows.concat(measured.filter(m => !known.has(m.quantity))
        .map(m => ({ quantity: m.quantity, published: null, measured: m })));
}

/// Measured over published, where both are numbers in the same unit; else null.
function ratioOf({ published, measured }) {
    const isNumber = side => typeof side?.value === "number";
    if (!isNumber(published) || !isNumber(measured) || published.value === 0) return null;
    return (published.unit ?? "") === (measured.unit ?? "") ? measured.value / published.value : null;
}
