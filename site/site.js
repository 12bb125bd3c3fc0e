// Opens the contents where there is room for them beside the text, and searches sections.
"use strict";

const wide = matchMedia("(min-width: 62rem)");
const contents = document.querySelector("nav details");
const follow = () => { contents.open = wide.matches; };
wide.addEventListener("change", follow);
follow();
document.querySelector("nav [aria-current]")?.scrollIntoView({ block: "nearest" });

const query = document.querySelector("#query");
const found = document.querySelector("#found");
const root = document.body.dataset.root;
const kMostResults = 12;
const kMostOfOnePage = 3;
const kMostWords = 10;

// Sections that have every word, each as the beginning of a word of theirs; first those that have them in their headings, then
// those that have them most often.
function matches(text) {
    // Each word is sought in all sections. The field takes no long text, but scripts put in what they like.
    const words = [...new Set(text.slice(0, query.maxLength).match(/[\p{L}\p{N}_]+/gu))].slice(0, kMostWords);
    if (words.length === 0) return [];
    const patterns = words.map((word) => new RegExp(`(?<![\\p{L}\\p{N}])${word}`, "giu"));
    const count = (pattern, where) => where.match(pattern)?.length ?? 0;
    const score = ([, page, heading, body]) => patterns.reduce((sum, pattern) => {
        const all = 40 * count(pattern, heading) + 20 * count(pattern, page) + Math.min(count(pattern, body), 10);
        return all === 0 ? -Infinity : sum + all;
    }, 0);
    return sections.map((section) => [score(section), section]).filter(([value]) => value > 0)
        .sort(([a], [b]) => b - a).map(([, section]) => section);
}

// The best sections, of different pages.
function best(text) {
    const ofPage = new Map();
    return matches(text).filter(([, page]) => {
        ofPage.set(page, (ofPage.get(page) ?? 0) + 1);
        return ofPage.get(page) <= kMostOfOnePage;
    }).slice(0, kMostResults);
}

function show() {
    found.replaceChildren();
    found.hidden = query.value.trim() === "";
    if (found.hidden) return;
    for (const [address, page, heading] of best(query.value)) {
        const link = document.createElement("a");
        link.href = root + address;
        link.textContent = heading === page ? page : `${page}: ${heading}`;
        const item = document.createElement("li");
        item.append(link);
        found.append(item);
    }
    if (found.childElementCount === 0) say("Nothing found");
}

function say(text) {
    const item = document.createElement("li");
    item.textContent = text;
    found.replaceChildren(item);
    found.hidden = false;
}

// All sections take longer to load than a page, hence not before somebody searches.
let loaded = null;
function load() {
    loaded ??= new Promise((resolve, reject) => {
        const script = document.createElement("script");
        script.src = `${root}sections.js`;
        script.onload = resolve;
        script.onerror = reject;
        document.head.append(script);
    });
    return loaded;
}

query.addEventListener("focus", () => load().catch(() => {})); // typing tells
query.addEventListener("input", () => load().then(show, () => say("The index of the search is missing: sections.js")));
document.addEventListener("keydown", (event) => {
    if (event.key === "Escape") found.hidden = true;
    const isTyping = event.target instanceof HTMLInputElement;
    // Ctrl+/ and the like belong to browsers. Some keyboards need AltGr for a slash.
    const isShortcut = (event.ctrlKey || event.altKey || event.metaKey) && !event.getModifierState("AltGraph");
    if (event.key === "/" && !isTyping && !isShortcut) {
        event.preventDefault();
        query.focus();
    }
});
