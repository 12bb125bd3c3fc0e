// The controls above the images of a viewer.

class ViewerControls {
    constructor(set, title, viewer) {
        this.set = set;
        const names = set.images.map(image => [image.index, image.name]);
        this.mode = choice("Compare by", makeAnchor("mode", title), kModes, mode => set.set({ mode }));
        this.content = choice("Show", makeAnchor("content", title), [["color", "Colours"], ["error", "Errors"]],
            value => set.set({ showsErrors: value === "error" }));
        this.left = select("Left", names, index => set.set({ left: Number(index) }));
        this.right = select("Right", names, index => set.set({ right: Number(index) }));
        this.flip = button("Flip", { class: "flip", title: "Show the other image in the same place (F)" }, () => viewer.flip());
        this.swap = button("Swap", { class: "swap", title: "Exchange the left and the right image" },
            () => set.set({ left: set.right, right: set.left }));
        this.exposure = slider("Exposure", { min: -kLargestExposure, max: kLargestExposure, step: 0.25 },
            stops => set.set({ exposure: stops }), { class: "exposure" });
        this.zoomText = element("output", { class: "zoom-text" });
        // Below the image, which must not move as errors are shown.
        this.scales = element("div", { class: "scales" });
        this.scaleRows = new Map();
        this.viewer = viewer;
        const hasErrors = set.images.some(image => image.reference);
        this.node = element("div", { class: "controls" },
            set.images.length > 1 ? this.mode.node : null,
            hasErrors ? this.content.node : null,
            set.images.length > 1
                ? element("div", { class: "row" }, this.left.node, this.right.node, this.swap, this.flip) : null,
            element("div", { class: "row" }, this.exposure.node,
                button("0", { class: "exposure-reset", "aria-label": "Exposure 0" }, () => set.set({ exposure: 0 })),
                this.zoomNode()));
    }

    zoomNode() {
        const { viewer } = this;
        return element("div", { class: "zoom", role: "group", "aria-label": "Zoom" },
            button("−", { class: "zoom-out", "aria-label": "Zoom out" }, () => viewer.set.zoomBy(0.5)),
            this.zoomText,
            button("+", { class: "zoom-in", "aria-label": "Zoom in" }, () => viewer.set.zoomBy(2)),
            button("Fit", { class: "zoom-fit", title: "The whole image (0)" }, () => viewer.set.set({ zoom: 1 })),
            button("1:1", { class: "zoom-one", title: "One pixel for one (1)" },
                () => viewer.set.zoomBy(1 / viewer.magnification())));
    }

    update() {
        const { set } = this;
        this.mode.show(set.mode);
        this.content.show(set.showsErrors ? "error" : "color");
        this.left.list.value = set.left;
        this.right.list.value = set.right;
        this.left.list.disabled = this.right.list.disabled = set.mode === "all";
        this.swap.disabled = set.mode === "all";
        this.exposure.show(set.exposure, `${set.exposure > 0 ? "+" : ""}${minus(String(set.exposure))} stops`);
        this.zoomText.textContent = `${Math.round(100 * this.viewer.magnification())} %`;
        this.updateScales();
    }

    /// A row for the scale of each comparison that is shown.
    updateScales() {
        const compared = this.set.showsErrors ? this.set.shown().filter(image => image.hasErrors()) : [];
        const rows = compared.map(image => this.scaleRow(image));
        // Children that stay where they are keep the focus.
        const nodes = rows.map(row => row.node);
        if (nodes.length !== this.scales.children.length || nodes.some((node, i) => node !== this.scales.children[i]))
            this.scales.replaceChildren(...nodes);
        rows.forEach((row, i) => row.update(compared[i]));
    }

    scaleRow(image) {
        if (!this.scaleRows.has(image)) this.scaleRows.set(image, new ScaleRow(this.set, image));
        return this.scaleRows.get(image);
    }
}

/// The scale of the errors of one image: what is shown as fully red or blue.
class ScaleRow {
    constructor(set, image) {
        // The slider has stops relative to the percentile.
        this.slider = slider(`Scale of ${image.label}`, { min: -8, max: 8, step: 0.125 },
            stops => { image.scale = image.errorPercentile() * 2 ** stops; set.changed(); }, { class: "error-scale" });
        this.bar = element("span", { class: "error-bar" });
        this.note = element("span", { class: "note" });
        this.node = element("div", { class: "row scale", "data-image": image.index }, this.slider.node, this.bar, this.note,
            button("Same scale for all", { class: "same-scale" }, () => {
                const scale = image.errorScale();
                for (const other of set.images) other.scale = scale;
                set.changed();
            }),
            button("99 %", { class: "own-scale", title: "Each image its own scale again, by its 99th percentile" }, () => {
                for (const other of set.images) other.scale = null;
                set.changed();
            }));
    }

    update(image) {
        const scale = image.errorScale();
        const percentile = image.errorPercentile();
        this.slider.show(Math.log2(scale / percentile), `±${formatNumber(scale, 3)}`);
        this.bar.textContent = `−${formatNumber(scale, 3)} dark · 0 · bright +${formatNumber(scale, 3)}`;
        this.note.textContent = `99 % of errors are below ${formatNumber(percentile, 3)}`;
    }
}
