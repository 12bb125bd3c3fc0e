// Runs the entry points of shaders/parity in WebGL 2, for shader_host.py: each answer asks for the next request.
"use strict";

// The sizes are those of shaders/parity/buffers.glsl.
const kRowSize = 2048; // texels of a texture of inputs or words
const kResultsInRow = 256;
const kTextures = 3; // that a shader writes, with four words each

// A triangle that covers all pixels.
const kTriangle = `#version 300 es
void main() {
    gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);
}`;

const gl = document.createElement("canvas").getContext("webgl2");

function compile(type, source) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    return shader;
}

function link(source) {
    const program = gl.createProgram();
    gl.attachShader(program, compile(gl.VERTEX_SHADER, kTriangle));
    gl.attachShader(program, compile(gl.FRAGMENT_SHADER, source));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    return program;
}

// Integers of 32 bits. Textures without filters have no other levels.
function makeTexture(internalFormat, format, width, height, words) {
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.texImage2D(gl.TEXTURE_2D, 0, internalFormat, width, height, 0, format, gl.UNSIGNED_INT, words);
    return texture;
}

function textureOf(bytes) {
    const words = new Uint32Array(bytes);
    const rows = Math.max(1, Math.ceil(words.length / kRowSize));
    const padded = new Uint32Array(rows * kRowSize);
    padded.set(words);
    return makeTexture(gl.R32UI, gl.RED_INTEGER, kRowSize, rows, padded);
}

const targets = new Map(); // framebuffers by their number of rows

function bindTarget(rows) {
    if (targets.has(rows)) return gl.bindFramebuffer(gl.FRAMEBUFFER, targets.get(rows));
    const target = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    const attachments = [...Array(kTextures).keys()].map(k => gl.COLOR_ATTACHMENT0 + k);
    for (const attachment of attachments)
        gl.framebufferTexture2D(gl.FRAMEBUFFER, attachment, gl.TEXTURE_2D,
                                makeTexture(gl.RGBA32UI, gl.RGBA_INTEGER, kResultsInRow, rows, null), 0);
    gl.drawBuffers(attachments);
    targets.set(rows, target);
}

function readResults(rows, calls) {
    const results = new Uint32Array(calls * 4 * kTextures);
    const pixels = new Uint32Array(rows * kResultsInRow * 4);
    for (let k = 0; k < kTextures; ++k) {
        gl.readBuffer(gl.COLOR_ATTACHMENT0 + k);
        gl.readPixels(0, 0, kResultsInRow, rows, gl.RGBA_INTEGER, gl.UNSIGNED_INT, pixels);
        for (let i = 0; i < calls; ++i)
            for (let j = 0; j < 4; ++j) results[4 * (kTextures * i + k) + j] = pixels[4 * i + j];
    }
    return results;
}

const programs = new Map(); // by their names: drivers compile them when they run first, which takes seconds
const shaders = []; // programs with their textures of words

async function programOf(name) {
    if (programs.has(name)) return programs.get(name);
    const response = await fetch(`/shaders/${name}`);
    if (!response.ok) throw new Error(`no shader ${name}`);
    programs.set(name, link(await response.text()));
    return programs.get(name);
}

const answers = {
    // A shader, and the words that it reads. Its number is how many came before it.
    async shader({ name }, words) {
        shaders.push({ program: await programOf(name), words: textureOf(words) });
        return new Uint32Array();
    },
    // Computes with the inputs of some calls.
    run({ shader, calls }, inputs) {
        const { program, words } = shaders[shader];
        // The last row may have more pixels than calls.
        const rows = Math.ceil(calls / kResultsInRow);
        bindTarget(rows); // first, because it may bind textures, too
        gl.useProgram(program);
        gl.uniform1ui(gl.getUniformLocation(program, "count"), calls);
        const texture = textureOf(inputs);
        for (const [unit, [name, of]] of [["inputs", texture], ["words", words]].entries()) {
            gl.activeTexture(gl.TEXTURE0 + unit);
            gl.bindTexture(gl.TEXTURE_2D, of);
            gl.uniform1i(gl.getUniformLocation(program, name), unit);
        }
        gl.viewport(0, 0, kResultsInRow, rows);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
        const results = readResults(rows, calls);
        gl.deleteTexture(texture);
        const error = gl.getError();
        if (error !== gl.NO_ERROR) throw new Error(`WebGL error ${error}`);
        return results;
    },
};

async function serve() {
    let answer = { ok: true, body: new Uint32Array() };
    for (;;) {
        const response = await fetch(answer.ok ? "/answer" : "/error", { method: "POST", body: answer.body });
        const request = JSON.parse(response.headers.get("Request"));
        try {
            answer = { ok: true, body: await answers[request.kind](request, await response.arrayBuffer()) };
        } catch (error) {
            answer = { ok: false, body: error.message };
        }
    }
}

serve();
