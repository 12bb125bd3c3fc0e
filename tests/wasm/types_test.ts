/** Compiled, never run: each line after `@ts-expect-error` must be an error. */
import { load, techniques, type Lights, type Nusselt, type Samples, type TechniqueName } from "nusselt";

const nusselt: Nusselt = await load();
const name: TechniqueName = techniques[0].name;
const lights: Lights = nusselt.prepare(name, 1, new Float32Array(12));
const samples: Samples = lights.sample(new Float32Array(2));
const density: number | undefined = lights.pdf(samples.wi)[0];
const inverse: Float32Array = lights.invert(samples.wi);
const measure: Float32Array = lights.measure();
console.log(density, inverse, measure, lights.count, lights.sample(inverse, samples).p);

// @ts-expect-error no such technique
nusselt.prepare("PolygonAera", 1, new Float32Array(12));
// @ts-expect-error doubles
lights.sample(new Float64Array(2));
// @ts-expect-error the number of lights is missing
nusselt.prepare("PolygonArea", new Float32Array(12));
// @ts-expect-error results are not to be replaced
samples.wi = new Float32Array(3);
// @ts-expect-error load() is asynchronous
load().prepare("PolygonArea", 1, new Float32Array(12));
