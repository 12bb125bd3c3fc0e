/// Programs, textures and framebuffers of WebGL 2.

import { rowLength } from "./layout";

export { rowLength };

export type Gl = WebGL2RenderingContext;

/// A compiled program and its uniforms by name.
export interface Program {
    readonly program: WebGLProgram;
    readonly uniforms: ReadonlyMap<string, Uniform>;
}

export interface Uniform {
    readonly location: WebGLUniformLocation;
    readonly type: number;
}

/// A program whose compilation has begun.
export interface PendingProgram {
    /// Whether finishing it will not wait. Always true where the browser cannot tell.
    isReady(): boolean;
    /// The program, the same at each call. \throws Error with the messages of the compiler
    finish(): Program;
}

function beginShader(gl: Gl, type: number, text: string): WebGLShader {
    const shader = gl.createShader(type);
    if (shader === null) throw new Error("the graphics context is lost");
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    return shader;
}

/// Names of array elements end with "[0]" in WebGL, which is left out here.
function uniformsOf(gl: Gl, program: WebGLProgram): Map<string, Uniform> {
    const uniforms = new Map<string, Uniform>();
    const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) as number;
    for (let i = 0; i < count; ++i) {
        const active = gl.getActiveUniform(program, i);
        const location = active && gl.getUniformLocation(program, active.name);
        if (active && location) uniforms.set(active.name.replace("[0]", ""), { location, type: active.type });
    }
    return uniforms;
}

export function beginProgram(gl: Gl, vertex: string, fragment: string): PendingProgram {
    const parallel = gl.getExtension("KHR_parallel_shader_compile");
    const program = gl.createProgram();
    if (program === null) throw new Error("the graphics context is lost");
    const shaders = [beginShader(gl, gl.VERTEX_SHADER, vertex), beginShader(gl, gl.FRAGMENT_SHADER, fragment)];
    for (const shader of shaders) gl.attachShader(program, shader);
    gl.linkProgram(program);
    let finished: Program | null = null;
    return {
        isReady: () => finished !== null || parallel === null ||
            Boolean(gl.getProgramParameter(program, parallel.COMPLETION_STATUS_KHR)),
        finish() {
            if (finished !== null) return finished;
            if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
                const logs = shaders.map(shader => gl.getShaderInfoLog(shader) ?? "");
                throw new Error([...logs, gl.getProgramInfoLog(program) ?? ""].filter(Boolean).join("\n"));
            }
            for (const shader of shaders) gl.deleteShader(shader);
            return finished = { program, uniforms: uniformsOf(gl, program) };
        },
    };
}

/// A format of textures without filters.
export interface TextureFormat {
    readonly internal: number;
    readonly format: number;
    readonly type: number;
}

export const formats = {
    rgba32f: { internal: 0x8814, format: 0x1908, type: 0x1406 },
    rgba16f: { internal: 0x881a, format: 0x1908, type: 0x140b },
    rg16f: { internal: 0x822f, format: 0x8227, type: 0x140b },
    r32i: { internal: 0x8235, format: 0x8d94, type: 0x1404 },
} as const;

export function makeTexture(gl: Gl, format: TextureFormat, width: number, height: number,
                            data: ArrayBufferView | null = null): WebGLTexture {
    const texture = gl.createTexture();
    if (texture === null) throw new Error("the graphics context is lost");
    gl.bindTexture(gl.TEXTURE_2D, texture);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
        gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
    gl.texImage2D(gl.TEXTURE_2D, 0, format.internal, width, height, 0, format.format, format.type, data);
    return texture;
}

/// An array of texels with four floats. Its length grows to whole rows.
export function makeArrayTexture(gl: Gl, values: Float32Array): WebGLTexture {
    const rows = Math.max(1, Math.ceil(values.length / (4 * rowLength)));
    const padded = new Float32Array(4 * rowLength * rows);
    padded.set(values);
    return makeTexture(gl, formats.rgba32f, rowLength, rows, padded);
}

/// A texture to draw into.
export interface Target {
    readonly texture: WebGLTexture;
    readonly framebuffer: WebGLFramebuffer;
    readonly width: number;
    readonly height: number;
    /// By which nearer fragments hide others; null where none do.
    readonly depth: WebGLRenderbuffer | null;
}

/// \throws Error where the device has no memory for it
export function makeTarget(gl: Gl, format: TextureFormat, width: number, height: number): Target {
    const texture = makeTexture(gl, format, width, height);
    const framebuffer = gl.createFramebuffer();
    if (framebuffer === null) throw new Error("the graphics context is lost");
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    requireComplete(gl, width, height);
    return { texture, framebuffer, width, height, depth: null };
}

/// A target in which nearer fragments hide others.
/// \throws Error where the device has no memory for it
export function makeDepthTarget(gl: Gl, format: TextureFormat, width: number, height: number): Target {
    const target = makeTarget(gl, format, width, height);
    const depth = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
    requireComplete(gl, width, height);
    return { ...target, depth };
}

function requireComplete(gl: Gl, width: number, height: number): void {
    // A lost context is reported by its event.
    const isComplete = gl.checkFramebufferStatus(gl.FRAMEBUFFER) === gl.FRAMEBUFFER_COMPLETE
        && gl.getError() === gl.NO_ERROR;
    if (!isComplete && !gl.isContextLost())
        throw new Error(`The device has no memory for ${width} × ${height} pixels: choose a smaller size.`);
}

export function deleteTarget(gl: Gl, target: Target): void {
    gl.deleteRenderbuffer(target.depth);
    gl.deleteFramebuffer(target.framebuffer);
    gl.deleteTexture(target.texture);
}

/// Reads four floats per pixel without making the page wait: the device writes them when it gets there.
export async function readTarget(gl: Gl, target: Target): Promise<Float32Array> {
    const values = new Float32Array(4 * target.width * target.height);
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, buffer);
    gl.bufferData(gl.PIXEL_PACK_BUFFER, values.byteLength, gl.STREAM_READ);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
    gl.readPixels(0, 0, target.width, target.height, gl.RGBA, gl.FLOAT, 0);
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
    await completion(gl);
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, buffer);
    gl.getBufferSubData(gl.PIXEL_PACK_BUFFER, 0, values);
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
    gl.deleteBuffer(buffer);
    return values;
}

/// Resolves when the device has done all that it was told to do before.
export function completion(gl: Gl): Promise<void> {
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    return new Promise(resolve => {
        const poll = () => {
            if (fence !== null && gl.clientWaitSync(fence, 0, 0) === gl.TIMEOUT_EXPIRED) {
                setTimeout(poll, 4);
            } else {
                gl.deleteSync(fence);
                resolve();
            }
        };
        poll();
    });
}

export type UniformValue = number | boolean | ArrayLike<number> | WebGLTexture;

function setUniform(gl: Gl, { location, type }: Uniform, values: ArrayLike<number>): void {
    if (values.length === 0) return; // an array of lights of which there are none
    switch (type) {
    case gl.FLOAT: return gl.uniform1fv(location, Float32Array.from(values));
    case gl.FLOAT_VEC2: return gl.uniform2fv(location, Float32Array.from(values));
    case gl.FLOAT_VEC3: return gl.uniform3fv(location, Float32Array.from(values));
    case gl.FLOAT_VEC4: return gl.uniform4fv(location, Float32Array.from(values));
    case gl.FLOAT_MAT4: return gl.uniformMatrix4fv(location, false, Float32Array.from(values));
    case gl.INT: case gl.BOOL: return gl.uniform1iv(location, Int32Array.from(values));
    default: throw new Error(`uniforms of type ${type} are not supported`);
    }
}

/// Draws vertices without attributes; three of them cover the screen.
/// \param uniforms by name; the program may lack some of them.
export function draw(gl: Gl, program: Program, target: Target | null, uniforms: ReadonlyMap<string, UniformValue>,
                     vertexCount = 3): void {
    gl.bindFramebuffer(gl.FRAMEBUFFER, target?.framebuffer ?? null);
    gl.viewport(0, 0, target?.width ?? gl.drawingBufferWidth, target?.height ?? gl.drawingBufferHeight);
    gl.useProgram(program.program);
    let unit = 0;
    for (const [name, uniform] of program.uniforms) {
        const value = uniforms.get(name);
        if (value === undefined) throw new Error(`the uniform ${name} has no value`);
        if (value instanceof WebGLTexture) {
            gl.activeTexture(gl.TEXTURE0 + unit);
            gl.bindTexture(gl.TEXTURE_2D, value);
            gl.uniform1i(uniform.location, unit++);
        } else {
            setUniform(gl, uniform, typeof value === "object" ? value : [Number(value)]);
        }
    }
    gl.drawArrays(gl.TRIANGLES, 0, vertexCount);
}
