// All images of an experiment as papers show them: below each its insets, and its errors in numbers.

// Apart for people with any kind of colour vision (M. Okabe and K. Ito 2008), without the blue and red of errors.
const kInsetColors = ["#e69f00", "#56b4e9", "#009e73", "#cc79a7", "#f0e442"];

function insetColor(index) {
    return kInsetColors[index % kInsetColors.length];
}

/// The usual spelling, as in relative RMSE.
function metricName(name) {
    return name.replaceAll("_", " ").replace(/\b(rmse|flip|mse|mape|smape|psnr)\b/g, word => word.toUpperCase());
}

class Figure {
    constructor(set, image) {
        this.set = set;
        this.image = image;
        this.canvas = element("canvas", { width: 1, height: 1, role: "img", "aria-label": image.label,
            "data-image": image.index, style: `aspect-ratio: ${image.width} / ${image.height}` });
        this.marks = set.insets.map((inset, i) => element("div", { class: "mark", title: inset.name,
            style: `--color: ${insetColor(i)}; left: ${100 * inset.left}%; top: ${100 * inset.top}%; ` +
                `width: ${100 * (inset.right - inset.left)}%; height: ${100 * (inset.bottom - inset.top)}%` }));
        this.insets = set.insets.map((inset, i) => new Inset(set, image, inset, i));
        this.scale = element("p", { class: "note scale-note", hidden: true });
        this.failure = element("p", { class: "failure", hidden: true });
        this.node = element("figure", { "data-image": image.index },
            element("div", { class: "picture" }, this.canvas, this.marks), this.failure,
            this.insets.length ? element("div", { class: "insets" }, this.insets.map(inset => inset.node)) : null,
            element("figcaption", {}, element("strong", {}, image.name),
                metricsNode(image.description.metrics), this.scale));
        this.isNear = false;
        watchScreen(this.node, () => this.show(true), () => this.show(false));
        set.listeners.push(() => this.update());
        new ResizeObserver(() => this.update()).observe(this.node);
    }

    /// Shown figures keep their pixels in memory.
    async show(isNear) {
        if (isNear === this.isNear) return;
        this.isNear = isNear;
        if (isNear) {
            await this.set.acquire([this.image]);
            this.update();
            return;
        }
        this.set.release([this.image]);
        clearCanvas(this.canvas);
        for (const inset of this.insets) clearCanvas(inset.canvas);
    }

    update() {
        const { image, set } = this;
        this.insets.forEach(inset => inset.resize(this.node.clientWidth));
        if (!this.isNear) return;
        this.failure.hidden = image.failure === null;
        this.failure.textContent = `The image cannot be shown: ${image.failure}`;
        set.paint(this.canvas, image);
        this.canvas.style.imageRendering = this.node.clientWidth >= image.width ? "pixelated" : "auto";
        for (const inset of this.insets) inset.update(this.canvas);
        this.scale.hidden = !(set.showsErrors && image.hasErrors());
        if (!this.scale.hidden) this.scale.textContent = `Errors from −${formatNumber(image.errorScale(), 3)} (blue) to ` +
            `+${formatNumber(image.errorScale(), 3)} (red)`;
    }
}

/// A part of an image, enlarged by a whole factor.
class Inset {
    constructor(set, image, inset, index) {
        this.count = set.insets.length;
        this.left = clamp(Math.round(inset.left * image.width), 0, image.width - 1);
        this.top = clamp(Math.round(inset.top * image.height), 0, image.height - 1);
        this.width = clamp(Math.round(inset.right * image.width) - this.left, 1, image.width - this.left);
        this.height = clamp(Math.round(inset.bottom * image.height) - this.top, 1, image.height - this.top);
        this.canvas = element("canvas", { width: 1, height: 1, role: "img", "data-image": image.index, "data-inset": index,
            "aria-label": `${inset.name} of ${image.label}` });
        this.caption = element("span", {});
        this.name = inset.name;
        this.node = element("div", { class: "inset", style: `--color: ${insetColor(index)}` }, this.canvas, this.caption);
    }

    /// The factor with which all insets of the image fit side by side, but at least 1.
    resize(available) {
        const border = 8, gap = 6;
        const share = (available - gap * (this.count - 1)) / this.count - border;
        const factor = Math.max(1, Math.floor(share / this.width));
        this.canvas.style.width = `${factor * this.width}px`;
        this.canvas.style.aspectRatio = `${this.width} / ${this.height}`;
        this.caption.textContent = factor > 1 ? `${this.name}, ${factor}×` : this.name;
    }

    /// Copies pixels from the painted image.
    update(painted) {
        if (!painted.dataset.painted || this.canvas.dataset.painted === painted.dataset.painted) return;
        this.canvas.dataset.painted = painted.dataset.painted;
        this.canvas.width = this.width;
        this.canvas.height = this.height;
        this.canvas.getContext("2d").drawImage(painted, this.left, this.top, this.width, this.height, 0, 0, this.width,
            this.height);
    }
}

function metricsNode(metrics) {
    const names = Object.keys(metrics ?? {});
    if (names.length === 0) return null;
    return element("dl", { class: "metrics" }, names.map(name => element("div", {},
        element("dt", {}, metricName(name)), element("dd", {}, valueNode(metrics[name])))));
}

function imagesNode(experiment) {
    if (!experiment.images?.length) return null;
    const set = new ImageSet(experiment);
    const viewer = new Viewer(set, experiment.name);
    const figures = set.images.map(image => new Figure(set, image));
    allFigures.push(...figures);
    return element("section", { class: "images" }, element("h4", {}, "Images"), viewer.node,
        element("div", { class: "figures" }, figures.map(figure => figure.node)));
}

/// Figures of the whole page, for printing.
const allFigures = [];

/// Decodes all figures, as printers see more than the screen, and prints the page.
async function printAll() {
    const hidden = allFigures.filter(figure => !figure.isNear);
    await Promise.all(hidden.map(figure => figure.show(true)));
    await new Promise(requestAnimationFrame);
    print();
    for (const figure of hidden) figure.show(false);
}
