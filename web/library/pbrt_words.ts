/// The words of files in pbrt's format, and the values of parameters. Each error says in which line of which file.

import { isInRange } from "./layout";
import { Vector } from "./vectors";

interface Word {
    readonly text: string;
    readonly line: number;
}

/// Strings keep their quotes; a quote without a second one in its line is a word of its own.
function wordsOf(text: string): Word[] {
    return text.split(/\r\n|\n|\r/).flatMap((row, i) =>
        (row.match(/#.*|"[^"]*"|["[\]]|[^\s"[\]]+/g) ?? []).filter(word => !word.startsWith("#"))
            .map(word => ({ text: word, line: i + 1 })));
}

const isText = (word: string): boolean => /^".*"$/.test(word);

/// A number as C++ reads it: no other base, no infinity, nothing empty.
const isNumber = (word: string): boolean => /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(word);

/// Reads the words of one file.
export class Words {
    private readonly words: Word[];
    private at = 0;
    private directive: Word = { text: "", line: 1 };

    constructor(readonly path: string, text: string) { this.words = wordsOf(text); }

    /// \throws Error that says what is wrong with the directive
    fail(message: string, line = this.directive.line): never {
        throw new Error(`${this.path}:${line}: ${this.directive.text}: ${message}`);
    }

    /// The next directive, null at the end of the file.
    nextDirective(): string | null {
        if (this.at === this.words.length) return null;
        this.directive = this.next();
        return this.directive.text;
    }

    private next(): Word { return this.words[this.at++] ?? { text: "", line: this.words[this.words.length - 1].line }; }

    private failAt({ text, line }: Word, message: string): never {
        this.fail(`${text || "the end of the file"} ${message}`, line);
    }

    /// What stands between quotes.
    text(): string {
        const word = this.next();
        if (!isText(word.text)) this.failAt(word, "is not a text in quotes");
        return word.text.slice(1, -1);
    }

    numberOf(word: Word): number {
        if (!isNumber(word.text)) this.failAt(word, "is not a number");
        const value = Number(word.text);
        if (!isInRange(value)) this.failAt(word, "is too large");
        return value;
    }

    number(): number { return this.numberOf(this.next()); }

    vector(): Vector { return [this.number(), this.number(), this.number()]; }

    /// One value, or several in brackets.
    private values(): Word[] {
        const first = this.next();
        if (first.text === "" || first.text === "]") this.failAt(first, "stands in place of a value");
        if (first.text !== "[") return [first];
        const list: Word[] = [];
        for (let word = this.next(); word.text !== "]"; word = this.next()) {
            if (word.text === "") this.fail("a ] is missing", first.line);
            list.push(word);
        }
        return list;
    }

    /// Reads parameters and hands them to a function, which has to look at all of them.
    withParameters<T>(use: (parameters: Parameters) => T): T {
        const found = new Map<string, Parameter>();
        while (this.words[this.at]?.text.startsWith('"')) {
            const { line } = this.words[this.at];
            const declaration = /^\s*(\S+)\s+(\S+)\s*$/.exec(this.text());
            if (declaration === null) this.fail("a parameter needs a type and a name between its quotes", line);
            const [, type, name] = declaration;
            if (found.has(name)) this.fail(`"${name}" is there twice`, line);
            found.set(name, { type, line, values: this.values() });
        }
        const parameters = new Parameters(found, this);
        const result = use(parameters);
        parameters.finish();
        return result;
    }

    /// A directive whose first word has to be one that the page can stand for.
    only(supported: string): void {
        const type = this.text();
        if (type !== supported) this.fail(`"${type}" is not supported, only "${supported}"`);
    }
}

/// What stands behind the name of a parameter.
interface Parameter {
    readonly type: string;
    readonly line: number;
    readonly values: readonly Word[];
}

/// What numbers have to be.
export interface Range {
    readonly least: number;
    readonly most?: number;
    /// Whether the bounds are excluded.
    readonly isOpen?: true;
}

const anyNumber: Range = { least: -Infinity };

const contains = ({ least, most = Infinity, isOpen }: Range, x: number): boolean =>
    isOpen ? x > least && x < most : x >= least && x <= most;

function describe({ least, most, isOpen }: Range): string {
    const lower = `${isOpen ? "above" : "at least"} ${least}`;
    return most === undefined ? lower : `${lower} and ${isOpen ? "below" : "at most"} ${most}`;
}

/// The parameters of a directive. Each is looked at once; the rest are errors, since the image would lack what they
/// mean.
export class Parameters {
    constructor(private readonly parameters: Map<string, Parameter>, private readonly words: Words) {}

    private take(type: string, name: string): Parameter | null {
        const found = this.parameters.get(name);
        if (found === undefined) return null;
        this.parameters.delete(name);
        if (found.type !== type)
            this.words.fail(`"${found.type} ${name}" is not supported, only "${type} ${name}"`, found.line);
        return found;
    }

    private takeOne(type: string, name: string): Word | null {
        const found = this.take(type, name);
        if (found === null) return null;
        if (found.values.length !== 1)
            this.words.fail(`"${type} ${name}" needs one value, not ${found.values.length}`, found.line);
        return found.values[0];
    }

    text(name: string, standard: string): string {
        const word = this.takeOne("string", name);
        if (word === null) return standard;
        if (!isText(word.text)) this.words.fail(`"string ${name}" needs a text in quotes, not ${word.text}`, word.line);
        return word.text.slice(1, -1);
    }

    /// In quotes or not.
    flag(name: string, standard: boolean): boolean {
        const word = this.takeOne("bool", name);
        if (word === null) return standard;
        const value = word.text.replace(/^"|"$/g, "");
        if (value !== "true" && value !== "false")
            this.words.fail(`"bool ${name}" is true or false, not ${word.text}`, word.line);
        return value === "true";
    }

    private numbers(type: string, name: string, range: Range): readonly number[] | null {
        const found = this.take(type, name);
        if (found === null) return null;
        return found.values.map(word => {
            const value = this.words.numberOf(word);
            const demand = type === "integer" && !Number.isInteger(value) ? "a whole number"
                : contains(range, value) ? null : describe(range);
            if (demand !== null) this.words.fail(`"${type} ${name}" must be ${demand}, not ${value}`, word.line);
            return value;
        });
    }

    /// \param standard null if the number must be there
    number(type: "float" | "integer", name: string, standard: number | null, range: Range = anyNumber): number {
        const values = this.numbers(type, name, range) ?? (standard === null ? [] : [standard]);
        if (values.length !== 1) this.words.fail(`"${type} ${name}" needs one number, not ${values.length}`);
        return values[0];
    }

    vectors(type: string, name: string, range: Range = anyNumber): Vector[] | null {
        const values = this.numbers(type, name, range);
        if (values === null) return null;
        if (values.length === 0 || values.length % 3 !== 0)
            this.words.fail(`"${type} ${name}" needs three numbers for each vector, not ${values.length}`);
        const vector = (i: number): Vector => [values[i], values[i + 1], values[i + 2]];
        return Array.from({ length: values.length / 3 }, (_, i) => vector(3 * i));
    }

    vector(type: "rgb" | "point3", name: string, standard: Vector | null, range: Range = anyNumber): Vector {
        const vectors = this.vectors(type, name, range) ?? (standard === null ? [] : [standard]);
        if (vectors.length !== 1) this.words.fail(`"${type} ${name}" needs one vector, not ${vectors.length}`);
        return vectors[0];
    }

    /// \throws Error for parameters that nobody has looked at
    finish(): void {
        for (const [name, { type, line }] of this.parameters)
            this.words.fail(`the parameter "${type} ${name}" is not supported`, line);
    }
}
