// The viewer: compares images of an experiment at full size. Frames show the same part of each image.

const kModes = [["flip", "Flip"], ["wipe", "Wipe"], ["pair", "Side by side"], ["all", "All images"]];

const kViewerKeys = [
    ["F or space", "flip between the left and the right image"],
    ["W", "wipe; the arrow keys move its divider where it has the focus"],
    ["S, A", "side by side; all images"],
    ["E", "errors or colours"],
    ["[ and ]", "half a stop darker or brighter"],
    ["+, −, 0, 1", "zoom in, zoom out, whole image, one pixel for one"],
    ["arrows", "move the image"],
    ["Shift and arrows", "move the cross that reads pixels"],
];

/// A frame with canvases on top of each other, one for each image.
class Frame {
    constructor(viewer, images) {
        this.set = viewer.set;
        this.images = images;
        this.canvases = images.map(image => element("canvas",
            { width: 1, height: 1, role: "img", "aria-label": image.label, "data-image": image.index }));
        this.marks = this.set.insets.map((inset, i) => element("div",
            { class: "mark", style: `--color: ${insetColor(i)}`, title: inset.name }));
        this.cross = element("div", { class: "cross", hidden: true });
        this.names = images.map(image => element("span", { class: "name" }, image.name));
        this.divider = element("div", { class: "divider", role: "slider", tabindex: 0, "aria-label": "Divider of the wipe",
            "aria-valuemin": 0, "aria-valuemax": 100, "aria-orientation": "horizontal" });
        this.failure = element("p", { class: "failure", hidden: true });
        this.node = element("div", { class: "frame", tabindex: 0, role: "group",
            "aria-label": `Image: ${images.map(image => image.label).join(", ")}. Keys are listed below.` },
            this.canvases, this.marks, this.cross, this.divider,
            element("div", { class: "names", "aria-live": "polite" }, this.names), this.failure);
        listenToFrame(this);
    }

    /// The size of the frame [CSS pixels].
    size() {
        return { width: this.node.clientWidth, height: this.node.clientHeight };
    }

    update() {
        const { set, images } = this;
        const isWipe = set.mode === "wipe" && images.length === 2;
        this.node.classList.toggle("zoomed", set.zoom > 1);
        this.canvases.forEach((canvas, i) => {
            set.paint(canvas, images[i]);
            place(canvas, set, this.size(), images[i], { left: 0, top: 0, right: 1, bottom: 1 });
            // Enlarged pixels are squares; reduced images are filtered.
            canvas.style.imageRendering = this.size().width * set.zoom >= images[i].width ? "pixelated" : "auto";
            canvas.hidden = set.mode === "flip" && images.length === 2 && i !== Number(set.showsRight);
        });
        this.names.forEach((name, i) => { name.hidden = this.canvases[i].hidden; });
        if (images.length === 2) this.clip(isWipe);
        this.divider.hidden = !isWipe;
        this.divider.style.left = `${100 * set.wipe}%`;
        this.divider.setAttribute("aria-valuenow", Math.round(100 * set.wipe));
        this.marks.forEach((mark, i) => place(mark, set, this.size(), images[0], set.insets[i]));
        this.cross.hidden = set.pointer === null;
        if (set.pointer) this.placeCross();
        const failed = images.filter((image, i) => image.failure && !this.canvases[i].hidden);
        this.failure.hidden = failed.length === 0;
        this.failure.textContent = failed.map(image => `${image.label} cannot be shown: ${image.failure}`).join(". ");
    }

    /// The right canvas is above the left one; only what is right of the divider stays of it.
    clip(isWipe) {
        const [left, right] = this.canvases;
        const shown = this.set.wipe * this.size().width - parseFloat(right.style.left);
        right.style.clipPath = isWipe ? `inset(0 0 0 ${shown}px)` : "";
        left.style.clipPath = "";
    }

    placeCross() {
        const image = this.images[0];
        const { x, y } = image.pixelAt(this.set.pointer);
        place(this.cross, this.set, this.size(), image, { left: x / image.width, top: y / image.height,
            right: (x + 1) / image.width, bottom: (y + 1) / image.height });
    }

    /// What is at a position of the frame [CSS pixels], in shares of the image.
    placeAt(x, y) {
        const { width } = this.size();
        const { zoom, center } = this.set;
        const height = width * this.images[0].height / this.images[0].width;
        return { x: center.x + (x / width - 0.5) / zoom,
                 y: center.y + (y - this.size().height / 2) / (height * zoom) };
    }
}

/// Puts an element over a part of the image in a frame. Images keep their own shape.
function place(node, set, size, image, part) {
    const width = size.width * set.zoom;
    const height = width * image.height / image.width;
    node.style.left = `${size.width / 2 + (part.left - set.center.x) * width}px`;
    node.style.top = `${size.height / 2 + (part.top - set.center.y) * height}px`;
    node.style.width = `${(part.right - part.left) * width}px`;
    node.style.height = `${(part.bottom - part.top) * height}px`;
}

class Viewer {
    constructor(set, title) {
        this.set = set;
        this.frames = [];
        this.isNear = false;
        this.acquired = [];
        this.layout = "";
        this.controls = new ViewerControls(set, title, this);
        this.stage = element("div", { class: "stage" });
        this.values = element("div", { class: "values" });
        this.node = element("div", { class: "viewer", role: "group", "aria-label": `Compare images of ${title}`,
            keydown: event => onViewerKey(this, event) },
            this.controls.node, this.stage, this.controls.scales, this.values, keysNode());
        set.listeners.push(() => this.update());
        new ResizeObserver(() => set.changed()).observe(this.stage);
        watchScreen(this.node, () => { this.isNear = true; set.changed(); }, () => { this.isNear = false; set.changed(); });
        this.update();
    }

    update() {
        this.makeFrames();
        this.acquireImages();
        const image = this.set.images[this.set.left];
        if (this.set.mode === "flip" || this.set.mode === "wipe") {
            // Whole factors, so that pixels of the image are squares of equal size.
            const factor = Math.max(1, Math.floor(Math.min(this.stage.clientWidth, 800) / image.width));
            this.frames[0].node.style.width = `${factor * image.width}px`;
        }
        for (const frame of this.frames) frame.update();
        this.controls.update();
        this.showValues();
    }

    /// New frames where the mode or the choice of images is new.
    makeFrames() {
        const shown = this.set.shown();
        const layout = `${this.set.mode} ${shown.map(image => image.index)}`;
        if (layout === this.layout) return;
        const isStacked = this.set.mode === "flip" || this.set.mode === "wipe";
        const hadFocus = this.stage.contains(document.activeElement);
        this.layout = layout;
        this.frames = isStacked ? [new Frame(this, shown)] : shown.map(image => new Frame(this, [image]));
        this.stage.className = `stage ${this.set.mode}`;
        this.stage.replaceChildren(...this.frames.map(frame => frame.node));
        for (const { node, images } of this.frames) node.style.aspectRatio = `${images[0].width} / ${images[0].height}`;
        if (hadFocus) this.frames[0].node.focus({ preventScroll: true });
    }

    acquireImages() {
        const needed = this.isNear ? this.set.shown() : [];
        if (needed.length === this.acquired.length && needed.every((image, i) => image === this.acquired[i])) return;
        const before = this.acquired;
        this.acquired = needed;
        this.set.acquire(needed);
        this.set.release(before);
        if (!this.isNear) for (const frame of this.frames) frame.canvases.forEach(clearCanvas);
    }

    /// The factor from pixels of the image to those of the page.
    magnification() {
        const frame = this.frames[0];
        return frame.size().width * this.set.zoom / frame.images[0].width;
    }

    flip() {
        if (this.set.mode !== "flip") this.set.set({ mode: "flip" });
        else this.set.set({ showsRight: !this.set.showsRight });
    }

    showValues() {
        const { pointer, showsErrors } = this.set;
        if (!pointer) {
            this.values.replaceChildren(
                element("p", {}, "Point at the image, or use Shift and the arrow keys, to read pixels."));
            return;
        }
        const { x, y } = this.set.images[this.set.left].pixelAt(pointer);
        const rows = this.set.shown().filter(image => image.pixels).map(image => pixelRow(image, pointer, showsErrors));
        this.values.replaceChildren(element("table", { class: "pixels" },
            element("caption", {}, `Pixel ${x}, ${y} from the top left; linear values`),
            element("thead", {}, element("tr", {}, ["image", "red", "green", "blue"].concat(showsErrors ? "error" : [])
                .map(text => element("th", { scope: "col" }, text)))),
            element("tbody", {}, rows)));
    }
}

/// A row with the values of the pixel at a place in shares of the image.
function pixelRow(image, place, showsErrors) {
    const { x, y } = image.pixelAt(place);
    const index = y * image.width + x;
    const cells = [...image.pixels.subarray(3 * index, 3 * index + 3)];
    if (showsErrors) cells.push(image.hasErrors() ? image.signedErrors()[index] : null);
    return element("tr", { "data-image": image.index }, element("th", { scope: "row" }, image.name),
        cells.map(value => element("td", {}, Number.isNaN(value) ? "not finite" : formatNumber(value))));
}

function keysNode() {
    return element("details", { class: "keys" }, element("summary", {}, "Keys and gestures"),
        element("dl", {}, kViewerKeys.map(([keys, meaning]) => [element("dt", {}, keys), element("dd", {}, meaning)])),
        element("p", {}, "Keys work while the focus is in the viewer. Drag the image to move it. Turn the wheel with Ctrl, " +
            "or after a click on the image, to zoom; on a touch screen, use two fingers."));
}
