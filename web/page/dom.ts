/// Elements of the page.

type Attribute = string | number | boolean | null | ((event: Event) => void);

/// An element with attributes and children. Functions listen to the event of their name; null and false are left out.
export function element<K extends keyof HTMLElementTagNameMap>(
    name: K, attributes: Record<string, Attribute> = {}, ...children: (Node | string)[]): HTMLElementTagNameMap[K] {
    const node = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) {
        if (typeof value === "function") node.addEventListener(key, value);
        else if (value !== null && value !== false) node.setAttribute(key, value === true ? "" : String(value));
    }
    node.append(...children);
    return node;
}

export function button(text: string, attributes: Record<string, Attribute>, onClick: () => void): HTMLButtonElement {
    return element("button", { type: "button", ...attributes, click: onClick }, text);
}

/// A control that shows a value.
export interface Control<T> {
    readonly node: HTMLElement;
    show(value: T): void;
}

export interface Option {
    readonly value: string;
    readonly text: string;
}

/// A drop-down list with a visible label.
export function select(label: string, id: string, options: readonly Option[],
    onChange: (value: string) => void): Control<string> & {
    readonly list: HTMLSelectElement;
} {
    const list: HTMLSelectElement = element("select", { id, change: () => onChange(list.value) },
        ...options.map(({ value, text }) => element("option", { value }, text)));
    return {
        list,
        node: element("label", { class: "field" }, element("span", {}, label), list),
        show(value) { list.value = value; },
    };
}

export interface Range {
    readonly min: number;
    readonly max: number;
    readonly step: number;
}

/// A slider with a visible label and the text that its value stands for.
export function slider(label: string, id: string, range: Range, textOf: (value: number) => string,
                       onInput: (value: number) => void): Control<number> {
    const input: HTMLInputElement = element("input", { type: "range", id, ...range,
        input: () => onInput(Number(input.value)) });
    const output = element("output", { for: id });
    return {
        node: element("label", { class: "field" }, element("span", {}, label), input, output),
        show(value) {
            input.value = String(value);
            output.textContent = textOf(value);
            input.setAttribute("aria-valuetext", textOf(value));
        },
    };
}

export function checkbox(label: string, id: string, onChange: (value: boolean) => void): Control<boolean> {
    const input: HTMLInputElement = element("input", { type: "checkbox", id, change: () => onChange(input.checked) });
    return {
        node: element("label", { class: "field check" }, input, element("span", {}, label)),
        show(value) { input.checked = value; },
    };
}

/// Copies a text; where the browser does not let pages copy, shows it to be copied by hand.
export async function copyText(text: string, message: HTMLElement, what: string): Promise<void> {
    try {
        await navigator.clipboard.writeText(text);
        message.textContent = `Copied ${what}`;
    } catch {
        const area = element("textarea", { readonly: true, rows: 12, "aria-label": what }, text);
        const dialog: HTMLDialogElement = element("dialog", { class: "copy-dialog", "aria-label": `Copy ${what}` },
            element("p", {}, "The browser does not let this page copy. Copy the selected text yourself:"), area,
            button("Close", {}, () => dialog.close()));
        // Also after Escape.
        dialog.addEventListener("close", () => dialog.remove());
        document.body.append(dialog);
        dialog.showModal();
        area.select();
    }
}
