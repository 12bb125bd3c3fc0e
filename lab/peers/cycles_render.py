"""Renders a scene with Blender's Cycles, for its own Python (Blender 3.4):

    blender --background --factory-startup --python cycles_render.py -- JOB.json

The job has the scene (as `pbrt_scene.py` describes it), threads, and variants: a list of dictionaries with lamps ("area",
"mesh", see `add_light`), mis, roulette, and renderings: a list of dictionaries with samples, seed, output (an EXR file, or
null), and passes (true adds Emit and Depth to the file). For each rendering, the program prints a line "rendering: {...}"
with its times in seconds.

Only direct light, only at pixel centres, and without anything that trades noise for bias.
"""
import json
import pathlib
import sys
import time

import bpy
from mathutils import Matrix

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))  # Blender does not

from cycles_geometry import camera_axes, lamp_of, occluder_of, reversed_side, tube_mesh  # noqa: E402


def place(scene, data, center, axes):
    """An object with this position and these axes."""
    thing = bpy.data.objects.new(data.name, data)
    thing.matrix_world = Matrix.Translation(center) @ Matrix(axes).transposed().to_4x4()
    scene.collection.objects.link(thing)
    return thing


def set_up_camera(scene, film, camera):
    axes, angle = camera_axes(film, camera)
    data = bpy.data.cameras.new("camera")
    data.sensor_fit, data.angle = "HORIZONTAL", angle
    data.clip_start, data.clip_end = 1e-3, 1e4
    scene.camera = place(scene, data, camera["origin"], axes)
    scene.render.resolution_x, scene.render.resolution_y = film
    scene.render.resolution_percentage = 100


def new_shader(name):
    """A material without nodes except its output."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    return material, nodes, material.node_tree.links, nodes.new("ShaderNodeOutputMaterial").inputs["Surface"]


def surface(description):
    """Lambert, GGX without Fresnel term, or Disney's principled BSDF, which is the nearest one to that of Frostbite."""
    material, nodes, links, output = new_shader(description["name"])
    diffuse, f0 = [*description["diffuse"], 1], description["f0"] and [*description["f0"], 1]
    if not f0:
        node = nodes.new("ShaderNodeBsdfDiffuse")
        node.inputs["Color"].default_value = diffuse
        node.inputs["Roughness"].default_value = 0
    elif f0 == [1, 1, 1, 1] and diffuse == [0, 0, 0, 1]:
        node = nodes.new("ShaderNodeBsdfGlossy")
        node.distribution = "GGX"
        node.inputs["Color"].default_value = f0
        node.inputs["Roughness"].default_value = description["roughness"]  # perceptual here, too
    else:
        node = nodes.new("ShaderNodeBsdfPrincipled")
        node.distribution = "GGX"
        metal = diffuse == [0, 0, 0, 1]
        node.inputs["Base Color"].default_value = f0 if metal else diffuse
        node.inputs["Metallic"].default_value = 1 if metal else 0
        node.inputs["Specular"].default_value = f0[0] / 0.08
        node.inputs["Roughness"].default_value = description["roughness"]
    links.new(node.outputs["BSDF"], output)
    return material


def emitter(name, radiance, two_sided):
    material, nodes, links, output = new_shader(name)
    emission = nodes.new("ShaderNodeEmission")
    emission.inputs["Color"].default_value = [*radiance, 1]
    emission.inputs["Strength"].default_value = 1
    if two_sided:
        links.new(emission.outputs["Emission"], output)
        return material
    mix, black = nodes.new("ShaderNodeMixShader"), nodes.new("ShaderNodeEmission")
    black.inputs["Strength"].default_value = 0
    links.new(nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], mix.inputs[0])
    links.new(emission.outputs["Emission"], mix.inputs[1])
    links.new(black.outputs["Emission"], mix.inputs[2])
    links.new(mix.outputs["Shader"], output)
    return material


def add_mesh(scene, name, positions, polygons, material):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(positions, [], polygons)
    mesh.materials.append(material)
    scene.collection.objects.link(bpy.data.objects.new(name, mesh))


def add_lamp(scene, polygon, radiance, mis):
    lamp = lamp_of(polygon, radiance)
    data = bpy.data.lights.new("lamp", "AREA")
    data.shape, data.size, data.size_y = "RECTANGLE", lamp["width"], lamp["height"]
    data.energy, data.color = lamp["power"], lamp["color"]
    data.cycles.use_multiple_importance_sampling = mis
    place(scene, data, lamp["center"], lamp["axes"])


def add_light(scene, light, lamps, mis, alone):
    """Polygons become area lights (two if both sides shine) or emissive meshes; tubes become emissive meshes."""
    radiance = light["radiance"]
    if "tube" in light:
        # Nobody sees the inner side. A mesh whose material has no case distinction is faster.
        add_mesh(scene, "tube", *tube_mesh(light["tube"], light["finite"]), emitter("tube", radiance, True))
        return
    polygon = light["polygon"]
    if lamps == "mesh":
        add_mesh(scene, "light", polygon, [[*range(len(polygon))]], emitter("light", radiance, light["two_sided"]))
        return
    add_lamp(scene, polygon, radiance, mis)
    if light["two_sided"]:
        add_lamp(scene, reversed_side(polygon), radiance, mis)
    elif not alone:
        # Area lights hide nothing, but ours hide the light of others.
        black = surface({"name": "black", "diffuse": [0, 0, 0], "f0": None})
        add_mesh(scene, "occluder", occluder_of(polygon), [[0, 1, 2, 3]], black)


def build(description, lamps, mis):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.world = None
    set_up_camera(scene, description["film"], description["camera"])
    materials = [surface(m) for m in description["materials"]]
    for i, mesh in enumerate(description["meshes"]):
        add_mesh(scene, f"mesh {i}", mesh["positions"], mesh["triangles"], materials[mesh["material"]])
    for light in description["lights"]:
        add_light(scene, light, lamps, mis, len(description["lights"]) == 1)
    return scene


def settings(scene, roulette, threads):
    scene.render.engine = "CYCLES"
    scene.render.threads_mode, scene.render.threads = "FIXED", threads
    scene.view_settings.view_transform = "Raw"
    scene.render.use_compositing = scene.render.use_sequencer = False
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_auto_tile = False
    # All rays of a pixel go through its centre, up to 1/200 of its side. A box would be as wide as a pixel in any case.
    cycles.pixel_filter_type, cycles.filter_width = "BLACKMAN_HARRIS", 0.01
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.blur_glossy = 0
    # The contribution below which shadow rays are subject to Russian roulette.
    cycles.light_sampling_threshold = roulette


def render(scene, samples, seed, output, passes):
    scene.cycles.samples, scene.cycles.seed = samples, seed
    layer = scene.view_layers[0]
    layer.use_pass_emit = layer.use_pass_z = passes
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER" if passes else "OPEN_EXR"
    scene.render.image_settings.color_mode, scene.render.image_settings.color_depth = "RGB", "32"
    if output:
        scene.render.filepath = output
    cpu, wall = time.process_time(), time.monotonic()
    bpy.ops.render.render(write_still=bool(output))
    times = {"cpu": time.process_time() - cpu, "wall": time.monotonic() - wall}
    print("rendering:", json.dumps({"samples": samples, "seed": seed, **times}), flush=True)


def main(file):
    job = json.loads(pathlib.Path(file).read_text())
    for variant in job["variants"]:
        scene = build(job["scene"], variant["lamps"], variant["mis"])
        settings(scene, variant["roulette"], job["threads"])
        for rendering in variant["renderings"]:
            render(scene, **rendering)


try:
    main(sys.argv[sys.argv.index("--") + 1])
except Exception as error:  # Blender would print it and exit with 0
    print(f"error: {error}", file=sys.stderr)
    sys.exit(1)
