// Linear pixels from PNG files, and colours of the screen from linear pixels. Pixels are RGB floats, row by row from the
// top. No colour management may change bytes: the files have no gAMA or iCCP chunks, and canvases are in sRGB.

/// Pixels that are not finite.
const kPink = [255, 20, 147];

async function bytesOf(data) {
    const image = new Image();
    image.src = data;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = image.naturalWidth;
    canvas.height = image.naturalHeight;
    // Without the hint, bytes could take the way through the memory of a GPU.
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    return context.getImageData(0, 0, canvas.width, canvas.height);
}

const kDecoders = {
    /// The upper half of the picture has mantissas m, the lower half the exponent e of all three channels, in each of
    /// them: a value is (m + 0.5) 2^(e - 136). All of e = 0 is black. e = 255 is not finite, whatever m.
    rgbe_stacked(bytes, width, height) {
        if (bytes.width !== width || bytes.height !== 2 * height)
            throw new Error(`the picture has ${bytes.width} x ${bytes.height} pixels, not ${width} x ${2 * height}`);
        const scales = Float64Array.from({ length: 256 }, (_, e) => 2 ** (e - 136));
        scales[0] = 0;
        scales[255] = NaN;
        const pixels = new Float32Array(3 * width * height);
        const exponents = 4 * width * height;
        for (let i = 0, j = 0; j < exponents; i += 3, j += 4) {
            const scale = scales[bytes.data[exponents + j]];
            for (let channel = 0; channel < 3; ++channel)
                pixels[i + channel] = (bytes.data[j + channel] + 0.5) * scale;
        }
        return pixels;
    },
    srgb(bytes, width, height) {
        if (bytes.width !== width || bytes.height !== height)
            throw new Error(`the picture has ${bytes.width} x ${bytes.height} pixels, not ${width} x ${height}`);
        const linear = Float32Array.from({ length: 256 }, (_, byte) => fromSrgb(byte / 255));
        const pixels = new Float32Array(3 * width * height);
        for (let i = 0, j = 0; i < pixels.length; i += 3, j += 4)
            for (let channel = 0; channel < 3; ++channel) pixels[i + channel] = linear[bytes.data[j + channel]];
        return pixels;
    },
};

function fromSrgb(x) {
    return x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
}

function toSrgb(x) {
    return x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
}

/// Bytes of the screen for values from 0 to 1. The transfer function rises by 0.05 of a byte from an entry to the next
/// where it is steepest; thus, bytes that were decoded become the same bytes again.
const kTransferSize = 65535;
let transferTable = null;
function transferBytes() {
    transferTable ??= Uint8Array.from({ length: kTransferSize + 1 }, (_, i) => Math.round(255 * toSrgb(i / kTransferSize)));
    return transferTable;
}

/// Draws pixels at an exposure [stops], clamped to [0, 1].
function paintColors(context, pixels, stops) {
    const table = transferBytes();
    const gain = kTransferSize * 2 ** stops;
    const image = context.createImageData(context.canvas.width, context.canvas.height);
    for (let i = 0, j = 0; i < pixels.length; i += 3, j += 4) {
        const finite = Number.isFinite(pixels[i]) && Number.isFinite(pixels[i + 1]) && Number.isFinite(pixels[i + 2]);
        for (let channel = 0; channel < 3; ++channel)
            image.data[j + channel] = finite
                ? table[Math.max(0, Math.min(kTransferSize, Math.round(gain * pixels[i + channel])))]
                : kPink[channel];
        image.data[j + 3] = 255;
    }
    context.putImageData(image, 0, 0);
}

/// Differences in luminance (of Rec. 709) between pixels and reference, one number for each pixel.
function signedErrors(pixels, reference) {
    const errors = new Float32Array(pixels.length / 3);
    for (let i = 0, j = 0; i < errors.length; ++i, j += 3)
        errors[i] = 0.2126 * (pixels[j] - reference[j]) + 0.7152 * (pixels[j + 1] - reference[j + 1]) +
            0.0722 * (pixels[j + 2] - reference[j + 2]);
    return errors;
}

/// The number that 99 % of the absolute errors do not exceed, those that are not finite aside. Where nearly all errors
/// are 0, it is the largest, and 1 where all are: it is always positive.
function errorPercentile(errors) {
    const sorted = errors.filter(Number.isFinite).map(Math.abs).sort();
    if (sorted.length === 0) return 1;
    return sorted[Math.ceil(0.99 * sorted.length) - 1] || sorted[sorted.length - 1] || 1;
}

/// The ends of the colours of errors, which white separates.
const kTooDark = [0, 68, 170];
const kTooBright = [178, 0, 24];

/// Draws errors: blue where pixels are darker than the reference by `scale` or more, red where they are brighter.
function paintErrors(context, errors, scale) {
    const image = context.createImageData(context.canvas.width, context.canvas.height);
    for (let i = 0, j = 0; i < errors.length; ++i, j += 4) {
        const share = Math.min(1, Math.abs(errors[i]) / scale);
        const end = errors[i] < 0 ? kTooDark : kTooBright;
        const finite = Number.isFinite(share);
        for (let channel = 0; channel < 3; ++channel)
            image.data[j + channel] = finite ? Math.round(255 + share * (end[channel] - 255)) : kPink[channel];
        image.data[j + 3] = 255;
    }
    context.putImageData(image, 0, 0);
}
