"""Renders a scene with Blender's Cycles, for its own Python (Blender 3.4):

    blender --background --factory-startup --python cycles_render.py -- JOB.json

The job has the scene (as `pbrt_scene.py` describes it), lamps ("area", "mesh", see `add_light`), roulette, mis, threads
and renderings: a list of dictionaries with samples, seed, output (an EXR file, or null), and passes (true adds Emit and
Depth to the file). For each rendering, the program prints a line "rendering: {...}" with its times in seconds.

Only direct light, only at pixel centres, and without anything that trades noise for bias.
"""
import json
import math
import pathlib
import sys
import time

import bpy
from mathutils import Matrix, Vector

TUBE_SIDES = 12  # a tube as a mesh has this many
OCCLUDER_OFFSET = 1e-4  # [m]


def set_up_film(scene, film, camera):
    right, down, corner = (Vector(camera[name]) for name in ("right", "down", "corner"))
    forward = corner + 0.5 * right + 0.5 * down
    x, y, z = right.normalized(), -down.normalized(), -forward.normalized()
    # What a perspective camera of Blender cannot do, such as mirrored or sheared images, must not pass.
    if (x.cross(y) - z).length > 1e-5 or abs(right.length / film[0] - down.length / film[1]) > 1e-6 * right.length:
        raise ValueError("Blender has no such camera")
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "HORIZONTAL"
    data.angle = 2 * math.atan(0.5 * right.length / forward.length)
    data.clip_start, data.clip_end = 1e-3, 1e4
    thing = bpy.data.objects.new("camera", data)
    axes = Matrix((x, y, z)).transposed().to_4x4()
    thing.matrix_world = Matrix.Translation(camera["origin"]) @ axes
    scene.collection.objects.link(thing)
    scene.camera = thing
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
    """An area light. It is a rectangle that shines along its -z axis."""
    a, b, c, d = (Vector(v) for v in polygon)
    if (a - b + c - d).length > 1e-6 or abs((b - a).dot(d - a)) > 1e-6:
        raise ValueError("Blender's area lights are rectangles")
    x, y = b - a, d - a
    lamp = bpy.data.lights.new("lamp", "AREA")
    lamp.shape, lamp.size, lamp.size_y = "RECTANGLE", x.length, y.length
    # A lamp of power E has the radiance E / (4 A), as tests of constant light show.
    lamp.energy = 4 * x.length * y.length * max(radiance)
    lamp.color = [value / max(radiance) for value in radiance]
    lamp.cycles.use_multiple_importance_sampling = mis
    thing = bpy.data.objects.new("lamp", lamp)
    # The side from which vertices appear counter-clockwise emits: x cross y points there, and so does -z.
    axes = Matrix((x.normalized(), -y.normalized(), -x.cross(y).normalized())).transposed().to_4x4()
    thing.matrix_world = Matrix.Translation((a + c) / 2) @ axes
    scene.collection.objects.link(thing)


def tube_mesh(tube, caps):
    """A prism with the lateral area of the cylinder, and thus the same projected area in the mean over all directions
    from which it is seen."""
    begin, end = Vector(tube["begin"]), Vector(tube["end"])
    axis = (end - begin).normalized()
    x = axis.orthogonal().normalized()
    y = axis.cross(x)
    half_angle = math.pi / TUBE_SIDES
    radius = tube["radius"] * half_angle / math.sin(half_angle)
    ring = [radius * (math.cos(2 * half_angle * i) * x + math.sin(2 * half_angle * i) * y) for i in range(TUBE_SIDES)]
    positions = [begin + v for v in ring] + [end + v for v in ring]
    following = [(i + 1) % TUBE_SIDES for i in range(TUBE_SIDES)]
    polygons = [[i, j, TUBE_SIDES + j, TUBE_SIDES + i] for i, j in enumerate(following)]
    if caps:
        polygons += [[*range(TUBE_SIDES - 1, -1, -1)], [*range(TUBE_SIDES, 2 * TUBE_SIDES)]]
    return positions, polygons


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
        add_lamp(scene, polygon[:1] + polygon[:0:-1], radiance, mis)
    elif not alone:
        # Area lights hide nothing, but ours hide the light of others.
        a, b, _, d = (Vector(v) for v in polygon)
        offset = -OCCLUDER_OFFSET * (b - a).cross(d - a).normalized()
        black = surface({"name": "black", "diffuse": [0, 0, 0], "f0": None})
        add_mesh(scene, "occluder", [Vector(v) + offset for v in polygon], [[0, 1, 2, 3]], black)


def build(description, lamps, mis):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.world = None
    set_up_film(scene, description["film"], description["camera"])
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
    # The narrowest filter: all rays of a pixel go through its centre.
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 0.01
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
    scene = build(job["scene"], job["lamps"], job["mis"])
    settings(scene, job["roulette"], job["threads"])
    for rendering in job["renderings"]:
        render(scene, **rendering)


try:
    main(sys.argv[sys.argv.index("--") + 1])
except Exception as error:  # Blender would print it and exit with 0
    print(f"error: {error}", file=sys.stderr)
    sys.exit(1)
