/// A light in the form of a tube.

import { Color, ColorRepresentation, CylinderGeometry, Mesh, MeshBasicMaterial, Vector3 } from "three";
import { TubularLight } from "../library/light_uniforms";

/// A tube along the local y axis that emits from its side, visible as a mesh that casts no shadow. Scales of the object
/// do not count, as with RectAreaLight.
export class TubeLight extends Mesh<CylinderGeometry, MeshBasicMaterial> {
    readonly isTubeLight = true;
    readonly color: Color;

    /// \param color     as for all lights of three.js.
    /// \param intensity factor of the colour: radiance [nt], as for RectAreaLight.
    /// \param length    along the axis, > 0.
    /// \param radius    > 0. Light is that of a thin tube: exact for radii much smaller than distances.
    constructor(color: ColorRepresentation = 0xffffff, public intensity = 1, public length = 1, public radius = 0.02) {
        super(new CylinderGeometry(radius, radius, length, 32), new MeshBasicMaterial());
        this.color = new Color(color);
        this.name = "TubeLight";
    }

    /// Makes the mesh look like the light. @internal
    updateLook(): void {
        this.material.color.copy(this.color).multiplyScalar(this.intensity);
        const { height, radiusTop } = this.geometry.parameters;
        if (height === this.length && radiusTop === this.radius) return;
        this.geometry.dispose();
        this.geometry = new CylinderGeometry(this.radius, this.radius, this.length, 32);
    }

    /// The light in world space, by its matrixWorld. @internal
    toWorld(): TubularLight {
        const center = new Vector3().setFromMatrixPosition(this.matrixWorld);
        const half = new Vector3(0, 1, 0).transformDirection(this.matrixWorld).multiplyScalar(0.5 * this.length);
        const radiance = this.color.clone().multiplyScalar(this.intensity);
        return {
            begin: center.clone().sub(half).toArray(), end: center.add(half).toArray(), radius: this.radius,
            radiance: radiance.toArray(),
        };
    }
}
