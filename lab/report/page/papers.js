// The papers and what became of each of their figures, tables and statements.

function papersNode(report) {
    return element("section", { id: "papers" }, element("h2", {}, "Papers"),
        report.papers.map(paper => paperNode(paper, report)));
}

function paperNode(paper, report) {
    const source = [paper.authors, paper.year, paper.venue].filter(part => part !== undefined && part !== "").join(", ");
    return element("section", { class: "paper", id: paper.anchor },
        element("h3", {}, paper.title ?? paper.key), element("p", { class: "source" }, source),
        element("table", { class: "items" },
            element("thead", {}, element("tr", {},
                ["Item", "What it shows", "Status", "Published and measured", "Experiments"]
                    .map(text => element("th", { scope: "col" }, text)))),
            element("tbody", {}, paper.items.map(item => itemRow(item, report)))));
}

function itemRow(item, report) {
    const [, status, meaning] = kStatuses.find(([name]) => name === item.status);
    const reason = item.not_applicable || item.missing || item.why;
    return element("tr", { id: item.anchor, "data-item": item.id, "data-status": item.status },
        element("th", { scope: "row" }, element("strong", {}, item.item), element("span", { class: "kind" }, item.kind ?? "")),
        element("td", {}, item.shows ?? ""),
        element("td", {}, element("span", { class: `badge ${item.status}`, title: meaning }, status),
            reason ? element("p", { class: "note" }, reason) : null,
            item.lacks ? element("p", { class: "note" }, `Lacks: ${item.lacks}`) : null),
        element("td", { class: "compared" }, comparisonNode(item)),
        element("td", { class: "links" }, linksNode(item, report)));
}

function comparisonNode(item) {
    const rows = comparisons(item);
    if (rows.length === 0) return element("span", { class: "note" }, "no numbers");
    return element("table", { class: "comparison" },
        element("thead", {}, element("tr", {}, ["", "published", "measured", "ratio"]
            .map(text => element("th", { scope: "col" }, text)))),
        element("tbody", {}, rows.map(row => comparisonRow(row, item))));
}

function comparisonRow(row, item) {
    const several = item.experiments.length > 1 && row.measured;
    const cell = side => side ? valueNode(side.value, side.unit) : element("span", { class: "note" }, "none");
    return element("tr", {},
        element("th", { scope: "row" }, row.quantity,
            several ? element("span", { class: "note" }, ` in ${row.measured.experiment.name}`) : null),
        element("td", {}, cell(row.published)), element("td", {}, cell(row.measured)),
        element("td", {}, formatNumber(ratioOf(row), 3)));
}

/// Experiments of an item with what became of their expectations; those that did not run, too.
function linksNode(item, report) {
    const names = item.by ?? [];
    if (names.length === 0) return element("span", { class: "note" }, "no experiment");
    return element("ul", {}, names.map(name => {
        const experiment = report.experiments.find(e => e.name === name);
        const skipped = report.not_run.find(e => e.name === name);
        const target = experiment ?? skipped;
        return element("li", {}, target ? element("a", { href: `#${target.anchor}` }, name) : name,
            experiment ? statesNode([experiment]) : element("span", { class: "note" }, " not run"));
    }));
}

/// Counts of expectations in words; those of states that do not occur are left out.
function statesNode(experiments) {
    const counts = countStates(experiments);
    return element("span", { class: "states" }, kStates.filter(([state]) => counts[state] > 0).map(([state, one, many]) =>
        element("span", { class: `state ${state}` }, `${counts[state]} ${counts[state] === 1 ? one : many}`)));
}
