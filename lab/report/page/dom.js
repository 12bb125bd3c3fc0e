// Elements from texts. No text of the report is ever parsed as HTML.

/// An element with attributes and children. Attributes that are functions listen to the event of their name, those
/// that are null or false are left out, and children that are null are, too.
function element(name, attributes = {}, ...children) {
    return fill(document.createElement(name), attributes, children);
}

function svgElement(name, attributes = {}, ...children) {
    return fill(document.createElementNS("http://www.w3.org/2000/svg", name), attributes, children);
}

function fill(node, attributes, children) {
    for (const [name, value] of Object.entries(attributes)) {
        if (typeof value === "function") node.addEventListener(name, value);
        else if (value !== null && value !== undefined && value !== false)
            node.setAttribute(name, value === true ? "" : String(value));
    }
    node.append(...children.flat(Infinity).filter(child => child !== null && child !== undefined && child !== ""));
    return node;
}

function button(text, attributes, onClick) {
    return element("button", { type: "button", ...attributes, click: onClick }, text);
}

/// A drop-down list with a visible label. Options are pairs of value and text.
function select(label, options, onChange, attributes = {}) {
    const list = element("select", { ...attributes, change: () => onChange(list.value) },
        options.map(([value, text]) => element("option", { value }, text)));
    return { node: element("label", { class: "field" }, element("span", {}, label), list), list };
}

/// A slider with a visible label and the text that it stands for.
function slider(label, range, onInput, attributes = {}) {
    const input = element("input", { type: "range", ...range, ...attributes, input: () => onInput(Number(input.value)) });
    const output = element("output", {});
    return {
        node: element("label", { class: "field" }, element("span", {}, label), input, output),
        show(value, text) {
            input.value = value;
            output.textContent = text;
            input.setAttribute("aria-valuetext", text);
        },
    };
}

/// Exactly one of several options, which are pairs of value and text. The keyboard works as for all radio buttons.
function choice(label, name, options, onChange) {
    const inputs = options.map(([value]) => element("input",
        { type: "radio", name, value, change: () => onChange(value) }));
    return {
        node: element("fieldset", { class: "choice" }, element("legend", {}, label),
            options.map(([, text], i) => element("label", {}, inputs[i], element("span", {}, text)))),
        show(value) {
            for (const input of inputs) input.checked = input.value === value;
        },
    };
}

/// Texts keep their paragraphs.
function paragraphs(text) {
    return String(text ?? "").split(/\n\s*\n/).filter(part => part.trim()).map(part => element("p", {}, part));
}

/// Identifiers of elements from any texts; equal texts get different ones.
const usedAnchors = new Set();
function makeAnchor(prefix, text) {
    const stem = `${prefix}-${String(text).replace(/[^\w.-]+/g, "_")}`;
    let anchor = stem;
    for (let i = 2; usedAnchors.has(anchor); ++i) anchor = `${stem}-${i}`;
    usedAnchors.add(anchor);
    return anchor;
}

/// A table that scrolls sideways where the page is too narrow, also by the keyboard.
function scrolling(label, table) {
    return element("div", { class: "scrolling", role: "region", "aria-label": label, tabindex: 0 }, table);
}

/// Copies a text, or selects it where the browser does not let pages copy.
async function copyText(source, message) {
    try {
        await navigator.clipboard.writeText(source.textContent);
        message.textContent = "Copied";
    } catch {
        getSelection().selectAllChildren(source);
        message.textContent = document.execCommand("copy") ? "Copied" : "Selected; press Ctrl+C to copy";
    }
}

/// A command or program text with a button that copies it.
function copyable(text, what) {
    const code = element("code", {}, text);
    const message = element("span", { class: "copied", role: "status" });
    return element("div", { class: "command" }, element("pre", { tabindex: 0, "aria-label": what }, code),
        button("Copy", { class: "copy", "aria-label": `Copy ${what}` }, () => copyText(code, message)), message);
}
