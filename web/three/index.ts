/// Area lights with shadows for three.js.

export { AreaLights } from "./area_lights";
export { FrameSum } from "./frame_sum";
export { TubeLight } from "./tube_light";
