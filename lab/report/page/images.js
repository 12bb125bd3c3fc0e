// The images of an experiment and how they are shown. Decoded pixels take 12 bytes each, so that they are kept only for
// images near the part of the page that is on the screen.

const kLargestZoom = 64;
const kLargestExposure = 10; // [stops]

class StoredImage {
    constructor(description, index) {
        this.description = description;
        this.index = index;
        this.label = String(description.label ?? `image ${index + 1}`);
        this.width = description.width;
        this.height = description.height;
        this.isReference = description.role === "reference";
        /// The label, and the role where the label does not say it.
        this.name = this.isReference && !/reference/i.test(this.label) ? `${this.label} (reference)` : this.label;
        this.reference = null;  // a StoredImage; null also where there is none of the same size
        this.pixels = null;     // null while they are not decoded
        this.failure = null;    // why they cannot be
        this.scale = null;      // of errors; null while it follows from the errors
        this.users = 0;
        this.forget();
    }

    forget() {
        this.pixels = this.errors = this.percentile = this.loading = null;
    }

    /// Decodes the image unless that has been done, and the reference.
    load() {
        this.loading ??= this.decode();
        return this.loading;
    }

    async decode() {
        try {
            const decoder = kDecoders[this.description.encoding];
            if (!decoder) throw new Error(`unknown encoding ${this.description.encoding}`);
            if (!(this.width > 0 && this.height > 0)) throw new Error("it has no size");
            this.pixels = decoder(await bytesOf(this.description.data), this.width, this.height);
            if (this.users === 0) this.forget(); // nobody waits for it any longer
            if (this.reference) await this.reference.load();
        } catch (error) {
            this.failure = String(error.message || error);
        }
    }

    hasErrors() {
        return this.pixels !== null && this.reference !== null && this.reference.pixels !== null;
    }

    signedErrors() {
        this.errors ??= signedErrors(this.pixels, this.reference.pixels);
        return this.errors;
    }

    /// Where the scale comes from unless somebody chose it.
    errorPercentile() {
        this.percentile ??= errorPercentile(this.signedErrors());
        return this.percentile;
    }

    errorScale() {
        return this.scale ?? this.errorPercentile();
    }

    /// The index of the pixel at a place in shares of the width and height.
    pixelAt(place) {
        return { x: clamp(Math.floor(place.x * this.width), 0, this.width - 1),
                 y: clamp(Math.floor(place.y * this.height), 0, this.height - 1) };
    }
}

function clamp(value, low, high) {
    return Math.max(low, Math.min(high, value));
}

/// Pictures in false colours, of the role "picture", belong to none. A variant belongs to the reference of its size before it, or to the first one after it.
function findReferences(images) {
    for (const image of images) {
        if (image.isReference || image.description.role === "picture") continue;
        const fits = images.filter(other => other.isReference && other.width === image.width &&
            other.height === image.height);
        image.reference = fits.filter(other => other.index < image.index).pop() ?? fits[0] ?? null;
    }
}

/// All images of an experiment with what their viewer, figures and insets have in common. Whatever changes it calls
/// changed(), and all that listen draw themselves again before the next frame.
class ImageSet {
    constructor(experiment) {
        this.images = experiment.images.map((description, index) => new StoredImage(description, index));
        findReferences(this.images);
        this.insets = experiment.insets ?? [];
        const variant = this.images.find(image => !image.isReference) ?? this.images[0];
        this.left = variant.index;
        this.right = (variant.reference ?? this.images.find(image => image !== variant) ?? variant).index;
        this.mode = "flip";
        this.showsRight = false;                // in the mode flip
        this.wipe = 0.5;                        // share of the width left of the divider
        this.exposure = 0;                      // [stops]
        this.showsErrors = false;
        this.zoom = 1;                          // relative to an image that fills its frame
        this.center = { x: 0.5, y: 0.5 };       // what is in the middle of frames, in shares of width and height
        this.pointer = null;                    // likewise, or null
        this.listeners = [];
        this.isScheduled = false;
    }

    changed() {
        if (this.isScheduled) return;
        this.isScheduled = true;
        requestAnimationFrame(() => {
            this.isScheduled = false;
            for (const listener of this.listeners) listener();
        });
    }

    set(values) {
        Object.assign(this, values);
        this.wipe = clamp(this.wipe, 0, 1);
        this.exposure = clamp(this.exposure, -kLargestExposure, kLargestExposure);
        this.zoom = clamp(this.zoom, 1, kLargestZoom);
        // Half a frame is 0.5 / zoom of the image; the image is never moved away from the frame.
        for (const axis of ["x", "y"])
            this.center[axis] = clamp(this.center[axis], 0.5 / this.zoom, 1 - 0.5 / this.zoom);
        this.changed();
    }

    /// Zooms while a place of the image, in shares of its width and height, stays where it is in frames.
    zoomBy(factor, fixed = this.center) {
        const zoom = clamp(this.zoom * factor, 1, kLargestZoom);
        const share = this.zoom / zoom;
        this.set({ zoom, center: { x: fixed.x + (this.center.x - fixed.x) * share,
                                   y: fixed.y + (this.center.y - fixed.y) * share } });
    }

    /// The images of the viewer, from left to right.
    shown() {
        if (this.mode === "all") return this.images;
        return this.left === this.right ? [this.images[this.left]] : [this.images[this.left], this.images[this.right]];
    }

    /// Decodes images for as long as somebody needs them.
    async acquire(images) {
        for (const image of images) this.count(image, 1);
        await Promise.all(images.map(image => image.load()));
        this.changed();
    }

    release(images) {
        for (const image of images) this.count(image, -1);
    }

    count(image, change) {
        for (const used of image.reference ? [image, image.reference] : [image]) {
            used.users += change;
            if (used.users === 0) used.forget();
        }
    }

    /// Draws an image, or its errors, on a canvas of its size. Does nothing where this would change nothing.
    paint(canvas, image) {
        if (!image.pixels) return;
        const errors = this.showsErrors && image.hasErrors();
        const key = errors ? `error ${image.index} ${image.errorScale()}` : `color ${image.index} ${this.exposure}`;
        if (canvas.dataset.painted === key) return;
        canvas.dataset.painted = key;
        if (canvas.width !== image.width) canvas.width = image.width;
        if (canvas.height !== image.height) canvas.height = image.height;
        const context = canvas.getContext("2d");
        if (errors) paintErrors(context, image.signedErrors(), image.errorScale());
        else paintColors(context, image.pixels, this.exposure);
    }
}

/// Gives the memory of a canvas back. The style keeps its place on the page.
function clearCanvas(canvas) {
    canvas.width = canvas.height = 1;
    delete canvas.dataset.painted;
}

/// Calls onNear and onFar as an element comes near the screen and leaves again.
function watchScreen(node, onNear, onFar) {
    let isNear = false;
    new IntersectionObserver(entries => {
        const now = entries[entries.length - 1].isIntersecting;
        if (now === isNear) return;
        isNear = now;
        if (isNear) onNear();
        else onFar();
    }, { rootMargin: "100% 0px" }).observe(node);
}
