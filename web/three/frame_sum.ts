/// Adds up frames while nothing moves, so that noise goes away and edges become smooth.

import {
    Constant, FloatType, GLSL3, HalfFloatType, Mesh, NearestFilter, OrthographicCamera, PerspectiveCamera, PlaneGeometry, Scene, ShaderMaterial,
    Vector2,
    WebGLRenderTarget, WebGLRenderer,
} from "three";
import { halton } from "../library/halton";

const vertexShader = "void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }";
/// Sums have the number of frames in w.
const addShader = `
uniform highp sampler2D frame;
uniform highp sampler2D sum;
uniform bool is_first;
out highp vec4 result;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    result = vec4(texelFetch(frame, pixel, 0).xyz, 1.0);
    if (!is_first) result += texelFetch(sum, pixel, 0);
}`;
const showShader = `
uniform highp sampler2D sum;
layout(location = 0) out highp vec4 pc_fragColor;
#define gl_FragColor pc_fragColor
void main() {
    vec4 frames = texelFetch(sum, ivec2(gl_FragCoord.xy), 0);
    gl_FragColor = vec4(frames.xyz / frames.w, 1.0);
    #include <tonemapping_fragment>
    #include <colorspace_fragment>
}`;

function makePass(fragmentShader: string, names: readonly string[]): ShaderMaterial {
    const uniforms = Object.fromEntries(names.map(name => [name, { value: null as unknown }]));
    return new ShaderMaterial({ vertexShader, fragmentShader, uniforms, glslVersion: GLSL3, depthTest: false, depthWrite: false });
}

function makeTarget(type: Constant, depthBuffer: boolean): WebGLRenderTarget {
    return new WebGLRenderTarget(1, 1, { type, depthBuffer, minFilter: NearestFilter, magFilter: NearestFilter });
}

type AnyCamera = PerspectiveCamera | OrthographicCamera;

/// Renders frames of a scene and shows their mean on the canvas.
export class FrameSum {
    /// Frames that have added up.
    count = 0;
    /// Whether camera rays pass pixels in other places in each frame.
    smooth = true;

    private readonly frame = makeTarget(HalfFloatType, true);
    private readonly sums = [makeTarget(FloatType, false), makeTarget(FloatType, false)];
    private readonly addPass = makePass(addShader, ["frame", "sum", "is_first"]);
    private readonly showPass = makePass(showShader, ["sum"]);
    private readonly quad = new Mesh<PlaneGeometry, ShaderMaterial>(new PlaneGeometry(2, 2), this.addPass);
    private readonly quadCamera = new OrthographicCamera();
    private view = "";

    constructor(private readonly renderer: WebGLRenderer) {
        this.quad.frustumCulled = false;
    }

    /// Forgets the frames: the scene has changed. A camera that moves and a canvas of another size are noticed.
    restart(): void { this.count = 0; }

    /// Whether the next frame starts anew, since the camera or the size of the canvas has changed.
    isOutdated(camera: AnyCamera): boolean { return this.viewOf(camera) !== this.view; }

    private viewOf(camera: AnyCamera): string {
        camera.updateMatrixWorld();
        const { x, y } = this.renderer.getDrawingBufferSize(new Vector2());
        return [x, y, camera.layers.mask, ...camera.matrixWorld.elements, ...camera.projectionMatrix.elements].join();
    }

    /// Adds a frame. Does nothing while the canvas has no pixels.
    /// \param camera its view offset is cleared.
    render(scene: Scene, camera: AnyCamera): void {
        const { renderer, frame, sums } = this;
        const old = renderer.getRenderTarget();
        const { x: width, y: height } = renderer.getDrawingBufferSize(new Vector2());
        if (width === 0 || height === 0) return;
        for (const target of [frame, ...sums]) target.setSize(width, height);
        if (this.isOutdated(camera)) this.restart();
        this.view = this.viewOf(camera);

        if (this.smooth && this.count > 0)
            camera.setViewOffset(width, height, halton(this.count, 2) - 0.5, halton(this.count, 3) - 0.5, width, height);
        renderer.setRenderTarget(frame);
        renderer.render(scene, camera);
        camera.clearViewOffset();

        this.draw(this.addPass, { frame: frame.texture, sum: sums[0].texture, is_first: this.count === 0 }, sums[1]);
        sums.reverse();
        ++this.count;
        this.draw(this.showPass, { sum: sums[0].texture }, old);
        renderer.setRenderTarget(old);
    }

    private draw(pass: ShaderMaterial, values: Record<string, unknown>, target: WebGLRenderTarget | null): void {
        for (const [name, value] of Object.entries(values)) pass.uniforms[name].value = value;
        this.quad.material = pass;
        this.renderer.setRenderTarget(target);
        this.renderer.render(this.quad, this.quadCamera);
    }

    /// The linear mean of the frames: red, green, blue and 1, row by row from the bottom.
    read(): Float32Array {
        const { width, height } = this.sums[0];
        const values = new Float32Array(4 * width * height);
        this.renderer.readRenderTargetPixels(this.sums[0], 0, 0, width, height, values);
        return values.map((value, i) => value / values[i - i % 4 + 3]);
    }

    /// Frees textures and programs.
    dispose(): void {
        for (const part of [this.frame, ...this.sums, this.addPass, this.showPass, this.quad.geometry]) part.dispose();
    }
}
