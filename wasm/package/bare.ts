/**
 * The library over columns of numbers, for whoever brings the module (`nusselt.wasm`). Most programs take `load()` of
 * the main entry, which has it.
 *
 * Lights and directions are in shading space: the shading point is the origin, the normal is +z. Lengths are in metres,
 * densities in 1/sr (times the radius for lines, in m/sr).
 *
 * Arrays are in columns: number `k` of light `i` is at `k * count + i`. Samples, densities and directions come in
 * rounds, one of each light; a round is columns like those of lights and follows the one before.
 */
import { techniques, type TechniqueName } from "./techniques.js";

export { techniques, type TechniqueName };

/** One sample of each light in each round. */
export interface Samples {
    /** Unit directions from the shading point to the light, in columns x, y, z. */
    readonly wi: Float32Array;
    /** Their densities, positive and finite; 0: no sample, directions and points then mean nothing. */
    readonly pdf: Float32Array;
    /** Points on the light relative to the shading point, in columns x, y, z. */
    readonly p: Float32Array;
}

interface Exports {
    readonly memory: WebAssembly.Memory;
    malloc(size: number): number;
    free(address: number): void;
    nusselt_row(technique: number, columns: number): number;
    nusselt_random_numbers(row: number): number;
    nusselt_group_size(row: number): number;
    nusselt_prepare(row: number, lights: number, columns: number, groups: number, prepared: number): void;
    nusselt_sample(row: number, prepared: number, groups: number, rounds: number, u: number, wi: number, pdf: number,
                   p: number): void;
    nusselt_pdf(row: number, prepared: number, groups: number, rounds: number, wi: number, pdf: number): void;
    nusselt_invert(row: number, prepared: number, groups: number, rounds: number, wi: number, u: number): void;
    nusselt_measure(row: number, prepared: number, groups: number, measure: number): void;
}

const LANES = 4;
const BYTES = Float32Array.BYTES_PER_ELEMENT;

/** Columns of `count` numbers in the module's memory, where they begin at multiples of four. */
class Columns {
    readonly address: number;
    private readonly stride: number;

    constructor(private readonly exports: Exports, private readonly count: number, private readonly columns: number) {
        this.stride = Math.ceil(count / LANES) * LANES;
        this.address = allocate(exports, this.stride * columns * BYTES);
    }

    write(values: Float32Array): this {
        const memory = this.memory();
        if (this.stride === this.count) {
            memory.set(values);
        } else {
            memory.fill(0);
            for (let k = 0; k < this.columns; ++k)
                memory.set(values.subarray(k * this.count, (k + 1) * this.count), k * this.stride);
        }
        return this;
    }

    read(values = new Float32Array(this.count * this.columns)): Float32Array {
        const memory = this.memory();
        if (this.stride === this.count) values.set(memory);
        else for (let k = 0; k < this.columns; ++k)
            values.set(memory.subarray(k * this.stride, k * this.stride + this.count), k * this.count);
        return values;
    }

    /** Anew each time: an allocation may have moved the memory. */
    private memory(): Float32Array {
        return new Float32Array(this.exports.memory.buffer, this.address, this.stride * this.columns);
    }
}

/** The module has at most 2 GB. Larger sizes would lose their upper bits in its integers. */
function allocate(exports: Exports, size: number): number {
    const address = size < 2 ** 31 ? exports.malloc(size) : 0;
    if (address === 0) throw new RangeError(`nusselt: no memory for ${size} bytes`);
    return address;
}

/** For programs whose types nobody checks. */
function checkType(values: unknown, what: string): void {
    if (!(values instanceof Float32Array)) throw new TypeError(`nusselt: the ${what} must be a Float32Array`);
}

/** The last five columns of lights are the matrices of lobes. */
function checkLobes(count: number, lights: Float32Array): void {
    const columns = [5, 4, 3, 2, 1].map(fromLast => lights.subarray(lights.length - fromLast * count));
    for (let i = 0; i < count; ++i) {
        const [m00, m02, m11, m20, m22] = columns.map(column => column[i]!) as [number, number, number, number, number];
        const minor = m00 * m22 - m02 * m20; // the products are exact
        if (!(m11 > 0 && m11 < Infinity && minor > 0 && minor < Infinity))
            throw new RangeError(`nusselt: the lobe of light ${i} has m11 = ${m11} and m00 m22 - m02 m20 = ${minor}; ` +
                                 "both must be positive and finite");
    }
}

/** Lights that a technique has prepared. They occupy memory of the module until `free()`. */
export class Lights {
    private readonly groups: number;
    private readonly random: number;
    private prepared: number;

    /** Use `Nusselt.prepare()`. */
    constructor(private readonly exports: Exports, private readonly row: number, readonly count: number,
                lights: Float32Array) {
        this.groups = Math.ceil(count / LANES);
        this.random = exports.nusselt_random_numbers(row);
        this.prepared = allocate(exports, this.groups * exports.nusselt_group_size(row));
        const columns = lights.length / count;
        try {
            this.withColumns([columns], ([light]) =>
                exports.nusselt_prepare(row, light!.write(lights).address, columns, this.groups, this.prepared));
        } catch (error) {
            this.free();
            throw error;
        }
    }

    /**
     * @param u random numbers in [0, 1): for each round one column for lines, two columns for other lights.
     * @param into where to write, in place of new arrays: samples of as many rounds of as many lights
     */
    sample(u: Float32Array, into?: Samples): Samples {
        const rounds = this.roundsOf(u, this.random, "random numbers");
        if (into) {
            this.checkLength("wi", into.wi, 3 * rounds);
            this.checkLength("pdf", into.pdf, rounds);
            this.checkLength("p", into.p, 3 * rounds);
        }
        return this.withColumns([this.random * rounds, 3 * rounds, rounds, 3 * rounds], ([random, wi, pdf, p]) => {
            this.exports.nusselt_sample(this.row, this.prepared, this.groups, rounds, random!.write(u).address,
                                        wi!.address, pdf!.address, p!.address);
            return { wi: wi!.read(into?.wi), pdf: pdf!.read(into?.pdf), p: p!.read(into?.p) };
        });
    }

    /**
     * The densities with which `sample()` returns directions.
     * @param wi unit directions, for each round in columns x, y, z; only those on the light have a meaningful density.
     */
    pdf(wi: Float32Array): Float32Array {
        const rounds = this.roundsOf(wi, 3, "coordinates");
        return this.withColumns([3 * rounds, rounds], ([directions, pdf]) => {
            this.exports.nusselt_pdf(this.row, this.prepared, this.groups, rounds,
                                     directions!.write(wi).address, pdf!.address);
            return pdf!.read();
        });
    }

    /** The random numbers with which `sample()` returns directions, which are those of `pdf()`. */
    invert(wi: Float32Array): Float32Array {
        const rounds = this.roundsOf(wi, 3, "coordinates");
        return this.withColumns([3 * rounds, this.random * rounds], ([directions, random]) => {
            this.exports.nusselt_invert(this.row, this.prepared, this.groups, rounds,
                                        directions!.write(wi).address, random!.address);
            return random!.read();
        });
    }

    /** The area, the solid angle, and so on, of each light: what normalises the density. */
    measure(): Float32Array {
        return this.withColumns([1], ([measure]) => {
            this.exports.nusselt_measure(this.row, this.prepared, this.groups, measure!.address);
            return measure!.read();
        });
    }

    /** Gives the memory back. The lights must not be used any more. */
    free(): void {
        this.exports.free(this.prepared);
        this.prepared = 0;
    }

    private checkLength(name: string, values: Float32Array, columns: number): void {
        checkType(values, name);
        if (values.length !== columns * this.count)
            throw new RangeError(`nusselt: ${name} has ${values.length} numbers in place of ${columns * this.count}`);
    }

    private roundsOf(values: Float32Array, perLight: number, what: string): number {
        checkType(values, what);
        const perRound = perLight * this.count;
        if (values.length === 0 || values.length % perRound !== 0)
            throw new RangeError(`nusselt: ${values.length} ${what} are no multiple of ${perRound}, ` +
                                 `${perLight} for each of ${this.count} lights`);
        return values.length / perRound;
    }

    private withColumns<Result>(counts: readonly number[], use: (columns: readonly Columns[]) => Result): Result {
        if (this.prepared === 0) throw new Error("nusselt: these lights have been freed");
        const columns: Columns[] = [];
        try {
            for (const count of counts) columns.push(new Columns(this.exports, this.count, count));
            return use(columns);
        } finally {
            for (const { address } of columns) this.exports.free(address);
        }
    }
}

/** An instance of the module. */
export class Nusselt {
    /** Use `load()` or `instantiate()`. */
    constructor(private readonly exports: Exports) {}

    /**
     * Prepares lights for sampling. Lights with numbers that are not finite or beyond 8e37, and cylinders with a negative
     * radius, are empty: their measure is 0, and so are all densities.
     * @param count how many
     * @param lights the columns of `count` lights (docs/wasm.md)
     * @throws RangeError for another number of columns than the technique takes, and for matrices of lobes without a positive
     *         determinant and a positive m11
     */
    prepare(technique: TechniqueName, count: number, lights: Float32Array): Lights {
        checkType(lights, "columns of lights");
        const index = indexOf(technique);
        const row = this.exports.nusselt_row(index, lights.length / count);
        if (!Number.isInteger(count) || count < 1 || lights.length % count !== 0 || row < 0)
            throw new RangeError(`nusselt: ${technique} takes no ${count} lights from ${lights.length} numbers`);
        if (techniques[index]!.light.endsWith("_on_lobe")) checkLobes(count, lights);
        return new Lights(this.exports, row, count, lights);
    }
}

function indexOf(technique: TechniqueName): number {
    const index = techniques.findIndex(({ name }) => name === technique);
    if (index < 0)
        throw new RangeError(`nusselt: no technique ${technique}; there are ${techniques.map(t => t.name).join(", ")}`);
    return index;
}

/** @param source the bytes of `nusselt.wasm`, or the module that they have become */
export async function instantiate(source: BufferSource | WebAssembly.Module): Promise<Nusselt> {
    const module = source instanceof WebAssembly.Module ? source : await WebAssembly.compile(source);
    // The C library tells whoever listens about memory that grows. Here, nobody keeps views of it.
    const imports: WebAssembly.Imports = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ??= {})[name] = () => {};
    const { exports } = await WebAssembly.instantiate(module, imports);
    (exports._initialize as () => void)();
    return new Nusselt(exports as unknown as Exports);
}
