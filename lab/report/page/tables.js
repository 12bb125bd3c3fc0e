// Tables of measured numbers.

const kLongTable = 30;

/// Columns of numbers are aligned to the right; null does not decide what a column is.
function isNumeric(table, column) {
    const cells = table.rows.map(row => row[column]).filter(cell => cell !== null && cell !== undefined);
    return cells.length > 0 ? cells.every(cell => typeof cell === "number") : table.rows.length > 0;
}

function columnHead(column) {
    return element("span", {}, String(column.name).replaceAll("_", " "),
        column.unit ? element("span", { class: "unit" }, ` [${column.unit}]`) : null);
}

function tableNode(table) {
    const name = String(table.name ?? "").replaceAll("_", " ");
    const numeric = table.columns.map((_, i) => isNumeric(table, i));
    const cellClass = i => numeric[i] ? "numeric" : null;
    const node = scrolling(`Table ${name}`, element("table", { class: "numbers" },
        element("caption", {}, name, table.rows.length > kLongTable ? ` (${table.rows.length} rows)` : null),
        element("thead", {}, element("tr", {},
            table.columns.map((column, i) => element("th", { scope: "col", class: cellClass(i) }, columnHead(column))))),
        element("tbody", {}, table.rows.map(row => element("tr", {}, table.columns.map((_, i) =>
            element("td", { class: cellClass(i) }, numeric[i] ? valueNode(row[i] ?? null) : formatValue(row[i]))))))));
    if (table.rows.length > kLongTable) node.classList.add("long");
    return node;
}
