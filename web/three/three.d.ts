// What the module and the example use of three.js. The published types need a newer compiler than Debian's.
declare module "three" {
    type Constant = number & { readonly constant: unique symbol };
    export const FloatType: Constant, HalfFloatType: Constant, RGBAFormat: Constant, RGFormat: Constant, NearestFilter: Constant;
    export const BackSide: Constant, FrontSide: Constant, GLSL3: Constant;

    export class Vector2 {
        constructor(x?: number, y?: number);
        x: number;
        y: number;
    }
    export class Vector3 {
        constructor(x?: number, y?: number, z?: number);
        fromArray(values: readonly number[]): this;
        setFromMatrixPosition(matrix: Matrix4): this;
        transformDirection(matrix: Matrix4): this;
        applyMatrix4(matrix: Matrix4): this;
        clone(): Vector3;
        sub(v: Vector3): this;
        subVectors(a: Vector3, b: Vector3): this;
        crossVectors(a: Vector3, b: Vector3): this;
        add(v: Vector3): this;
        normalize(): this;
        length(): number;
        addScaledVector(v: Vector3, scale: number): this;
        multiplyScalar(scale: number): this;
        toArray(): [number, number, number];
    }
    export class Matrix4 {
        readonly elements: readonly number[];
        makeBasis(x: Vector3, y: Vector3, z: Vector3): this;
        copy(matrix: Matrix4): this;
        multiply(matrix: Matrix4): this;
    }
    export class Quaternion {
        setFromRotationMatrix(matrix: Matrix4): this;
        setFromUnitVectors(from: Vector3, to: Vector3): this;
    }
    export class Color {
        constructor(color?: ColorRepresentation);
        copy(color: Color): this;
        clone(): Color;
        setRGB(r: number, g: number, b: number): this;
        multiplyScalar(scale: number): this;
        toArray(): [number, number, number];
    }
    export type ColorRepresentation = Color | number | string;

    export class BufferAttribute {
        constructor(array: Float32Array, itemSize: number);
        readonly count: number;
        readonly version: number;
        getX(index: number): number;
    }
    export class InterleavedBuffer {
        readonly version: number;
    }
    export class InterleavedBufferAttribute {
        readonly count: number;
        readonly data: InterleavedBuffer;
        getX(index: number): number;
    }
    export class Float32BufferAttribute extends BufferAttribute {
        constructor(array: readonly number[], itemSize: number);
    }
    export class BufferGeometry {
        readonly id: number;
        readonly index: BufferAttribute | null;
        readonly attributes: Readonly<Record<string, BufferAttribute | InterleavedBufferAttribute | undefined>>;
        readonly drawRange: { readonly start: number; readonly count: number };
        setAttribute(name: string, attribute: BufferAttribute): this;
        computeVertexNormals(): void;
        dispose(): void;
    }
    export class CylinderGeometry extends BufferGeometry {
        constructor(radiusTop: number, radiusBottom: number, height: number, radialSegments: number);
        readonly parameters: { readonly height: number; readonly radiusTop: number };
    }
    export class PlaneGeometry extends BufferGeometry {
        constructor(width: number, height: number);
    }

    export interface Shader {
        readonly uniforms: Record<string, { value: unknown }>;
        fragmentShader: string;
    }
    export class Material {
        name: string;
        defines?: Record<string, string | number>;
        needsUpdate: boolean;
        onBeforeCompile(shader: Shader, renderer: WebGLRenderer): void;
        customProgramCacheKey(): string;
        dispose(): void;
    }
    export class MeshBasicMaterial extends Material {
        constructor(parameters?: object);
        readonly color: Color;
    }
    export class MeshStandardMaterial extends Material {
        constructor(parameters?: object);
        readonly isMeshStandardMaterial: true;
        readonly color: Color;
        readonly emissive: Color;
        roughness: number;
    }
    export class MeshPhysicalMaterial extends MeshStandardMaterial {}
    export class ShaderMaterial extends Material {
        constructor(parameters: object);
        readonly uniforms: Record<string, { value: unknown }>;
    }

    export class Layers {
        mask: number;
        test(layers: Layers): boolean;
    }
    export class Object3D {
        readonly id: number;
        readonly layers: Layers;
        name: string;
        castShadow: boolean;
        receiveShadow: boolean;
        frustumCulled: boolean;
        readonly position: Vector3;
        readonly quaternion: Quaternion;
        readonly matrixWorld: Matrix4;
        add(...objects: Object3D[]): this;
        traverse(visit: (object: Object3D) => void): void;
        traverseVisible(visit: (object: Object3D) => void): void;
        updateMatrixWorld(): void;
        lookAt(target: Vector3): void;
    }
    export class Scene extends Object3D {
        background: Color | null;
    }
    export class Mesh<G extends BufferGeometry = BufferGeometry, M extends Material = Material> extends Object3D {
        constructor(geometry: G, material: M);
        geometry: G;
        material: M;
        getVertexPosition(index: number, target: Vector3): Vector3;
    }
    export class InstancedMesh extends Mesh {
        readonly count: number;
        readonly instanceMatrix: BufferAttribute;
        getMatrixAt(index: number, matrix: Matrix4): void;
    }
    export class RectAreaLight extends Object3D {
        constructor(color: ColorRepresentation, intensity: number, width: number, height: number);
        readonly isRectAreaLight: true;
        readonly color: Color;
        intensity: number;
        width: number;
        height: number;
    }

    export class Camera extends Object3D {
        readonly projectionMatrix: Matrix4;
    }
    export class PerspectiveCamera extends Camera {
        constructor(fov?: number, aspect?: number, near?: number, far?: number);
        aspect: number;
        fov: number;
        setViewOffset(fullWidth: number, fullHeight: number, x: number, y: number, width: number, height: number): void;
        clearViewOffset(): void;
        updateProjectionMatrix(): void;
    }
    export class OrthographicCamera extends Camera {
        setViewOffset(fullWidth: number, fullHeight: number, x: number, y: number, width: number, height: number): void;
        clearViewOffset(): void;
    }

    export class Texture {
        needsUpdate: boolean;
        dispose(): void;
    }
    export class DataTexture extends Texture {
        constructor(data: ArrayBufferView, width: number, height: number, format: Constant, type: Constant);
    }
    export class WebGLRenderTarget {
        constructor(width: number, height: number, options: object);
        readonly texture: Texture;
        readonly width: number;
        readonly height: number;
        setSize(width: number, height: number): void;
        dispose(): void;
    }
    export class WebGLRenderer {
        constructor(parameters?: object);
        readonly domElement: HTMLCanvasElement;
        getRenderTarget(): WebGLRenderTarget | null;
        setRenderTarget(target: WebGLRenderTarget | null): void;
        getDrawingBufferSize(target: Vector2): Vector2;
        render(scene: Object3D, camera: Camera): void;
        readRenderTargetPixels(target: WebGLRenderTarget, x: number, y: number, width: number, height: number,
                               buffer: Float32Array): void;
        setSize(width: number, height: number, updateStyle?: boolean): void;
        setPixelRatio(ratio: number): void;
    }
}

declare module "three/addons/controls/OrbitControls.js" {
    import { Camera, Vector3 } from "three";
    export class OrbitControls {
        constructor(camera: Camera, element: HTMLElement);
        readonly target: Vector3;
        enabled: boolean;
        update(): boolean;
    }
}

declare module "three/addons/controls/DragControls.js" {
    import { Camera, Object3D } from "three";
    export class DragControls {
        constructor(objects: readonly Object3D[], camera: Camera, element: HTMLElement);
        recursive: boolean;
        addEventListener(type: "dragstart" | "dragend", listener: () => void): void;
    }
}

declare module "three/addons/lights/RectAreaLightUniformsLib.js" {
    export const RectAreaLightUniformsLib: { init(): void };
}

// What web/build_three.py makes, and files as esbuild imports them.
declare module "*.glsl" {
    const text: string;
    export default text;
}
declare module "*.bin" {
    const bytes: Uint8Array;
    export default bytes;
}
