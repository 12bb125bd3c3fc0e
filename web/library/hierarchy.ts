/// A hierarchy of boxes around triangles, in the layout of web/shaders/shadows.glsl.

import { leafSize } from "./layout";

export interface Hierarchy {
    /// Two texels for each node.
    readonly nodes: Float32Array;
    readonly nodeCount: number;
    /// The triangles of the leaves, by their place among those that came in.
    readonly order: number[];
}

interface Box {
    lower: number[];
    upper: number[];
}

const emptyBox = (): Box => ({ lower: [Infinity, Infinity, Infinity], upper: [-Infinity, -Infinity, -Infinity] });

function extend(box: Box, other: Box): void {
    for (let k = 0; k < 3; ++k) {
        box.lower[k] = Math.min(box.lower[k], other.lower[k]);
        box.upper[k] = Math.max(box.upper[k], other.upper[k]);
    }
}

function area(box: Box): number {
    const [x, y, z] = box.upper.map((upper, k) => upper - box.lower[k]);
    return x * y + y * z + z * x;
}

// Fetching a node and testing its box takes as long as testing 0.7 triangles.
const costOfNode = 0.7;

/// The cheapest division of triangles into two parts by the surface area heuristic, with all places along all axes
/// tried.
/// \returns null where a leaf is cheaper
function split(items: number[], boxes: readonly Box[], whole: Box): [number[], number[]] | null {
    let best = items.length >= leafSize ? Infinity : items.length * area(whole);
    let parts: [number[], number[]] | null = null;
    for (let axis = 0; axis < 3; ++axis) {
        const center = (i: number) => boxes[i].lower[axis] + boxes[i].upper[axis];
        const sorted = [...items].sort((a, b) => center(a) - center(b));
        const costs = new Float64Array(sorted.length);
        const low = emptyBox();
        for (let i = 1; i < sorted.length; ++i) {
            extend(low, boxes[sorted[i - 1]]);
            costs[i] = i * area(low);
        }
        const high = emptyBox();
        for (let i = sorted.length - 1; i > 0; --i) {
            extend(high, boxes[sorted[i]]);
            const cost = 2 * costOfNode * area(whole) + costs[i] + (sorted.length - i) * area(high);
            if (cost < best) {
                best = cost;
                parts = [sorted.slice(0, i), sorted.slice(i)];
            }
        }
    }
    return parts;
}

/// Nodes with more triangles try fewer places: sorting takes long.
const mostSorted = 256;
const binCount = 32;

/// The same division, with the places between bins of equal width tried only.
/// \returns null where the centres of all triangles are in one place
function splitBins(items: number[], boxes: readonly Box[], whole: Box): [number[], number[]] | null {
    let best = Infinity;
    let parts: [number[], number[]] | null = null;
    for (let axis = 0; axis < 3; ++axis) {
        const center = (i: number) => boxes[i].lower[axis] + boxes[i].upper[axis];
        const begin = 2 * whole.lower[axis];
        const width = 2 * whole.upper[axis] - begin;
        const binOf = (i: number) => width > 0 ? Math.min(Math.floor(binCount * ((center(i) - begin) / width)), binCount - 1) : 0;
        const bins = Array.from({ length: binCount }, () => ({ count: 0, box: emptyBox() }));
        for (const i of items) {
            const bin = bins[binOf(i)];
            ++bin.count;
            extend(bin.box, boxes[i]);
        }
        const sideCosts = (order: typeof bins) => {
            const sum = { count: 0, box: emptyBox() };
            return order.map(({ count, box }) => {
                sum.count += count;
                extend(sum.box, box);
                return sum.count === 0 || sum.count === items.length ? Infinity : sum.count * area(sum.box);
            });
        };
        const low = sideCosts(bins);
        const high = sideCosts([...bins].reverse()).reverse();
        for (let place = 1; place < binCount; ++place) {
            const cost = low[place - 1] + high[place];
            if (cost >= best) continue;
            best = cost;
            parts = [items.filter(i => binOf(i) < place), items.filter(i => binOf(i) >= place)];
        }
    }
    return parts;
}

/// Halves of triangles that no plane divides, null for others.
function halves(items: number[], boxes: readonly Box[]): [number[], number[]] | null {
    const center = (i: number, axis: number) => boxes[i].lower[axis] + boxes[i].upper[axis];
    const isTogether = items.every(i => [0, 1, 2].every(axis => center(i, axis) === center(items[0], axis)));
    if (items.length < leafSize || !isTogether) return null;
    return [items.slice(0, items.length / 2), items.slice(items.length / 2)];
}

/// \param corners nine numbers for each triangle.
export function makeHierarchy(corners: ArrayLike<number>): Hierarchy {
    const boxes: Box[] = [];
    for (let i = 0; i < corners.length; i += 9) {
        const box = emptyBox();
        for (let j = 0; j < 9; ++j) {
            const k = j % 3;
            box.lower[k] = Math.min(box.lower[k], Math.fround(corners[i + j]));
            box.upper[k] = Math.max(box.upper[k], Math.fround(corners[i + j]));
        }
        boxes.push(box);
    }
    const nodes: number[] = [];
    const order: number[] = [];
    const append = (items: number[]): void => {
        const whole = emptyBox();
        for (const i of items) extend(whole, boxes[i]);
        const begin = nodes.length;
        nodes.push(...whole.lower, 0, ...whole.upper, -1);
        const parts = halves(items, boxes) ?? (items.length > mostSorted ? splitBins(items, boxes, whole) : null) ?? split(items, boxes, whole);
        if (parts === null) {
            nodes[begin + 7] = leafSize * order.length + items.length;
            order.push(...items);
        } else {
            for (const part of parts) append(part);
        }
        nodes[begin + 3] = nodes.length / 8;
    };
    if (boxes.length > 0) append([...boxes.keys()]);
    return { nodes: Float32Array.from(nodes), nodeCount: nodes.length / 8, order };
}
