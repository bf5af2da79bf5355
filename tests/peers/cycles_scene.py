"""A glTF file in Blender's Cycles, set up to mean what Triad means by it.

Blender's importer and its Principled shader differ from glTF in a few places that have nothing to do with rendering:
those are put right here, each in a function of its own that says what it changes. What remains is explained in
docs/agreement.md.
"""
import functools
import json
import math
import os
import re
import struct
import tempfile

import bpy
import numpy as np
from mathutils import Matrix, Vector

BOUNCES = 128  # Triad has no limit; what is left after so many is far below the noise


def to_blender(p):
    """glTF is y up, Blender z up: its importer turns (x, y, z) into (x, -z, y)."""
    return Vector((p[0], -p[2], p[1]))


def to_gltf(p):
    return (p[0], p[2], -p[1])


def read_gltf_json(path):
    with open(path, "rb") as f:
        data = f.read()
    if data[:4] == b"glTF":
        data = data[20 : 20 + struct.unpack("<I", data[12:16])[0]]
    return json.loads(data)


class CyclesScene:
    def __init__(self, path, environment, size, threads):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.scene = bpy.context.scene
        self.size = size
        self._settings(threads)
        # COMPAT: a point light of x candela gets 4 pi x watts, of which Cycles makes x per steradian; lux stay lux
        bpy.ops.import_scene.gltf(filepath=path, export_import_convert_lighting_mode="COMPAT", merge_vertices=False)
        self._world(environment)
        linear_textures()
        gltf = read_gltf_json(path)
        materials = {m.get("name", ""): m for m in gltf.get("materials", [])}
        for material in bpy.data.materials:
            # Blender numbers materials of one name, whose extensions are taken to be the same
            definition = materials.get(material.name) or materials.get(re.sub(r"\.\d{3}$", "", material.name))
            if definition and material.use_nodes:
                exact_absorption(material, definition)
                thin_walls(material, definition)
                one_sided_emission(material, definition)
                exact_anisotropy(material, definition)
        punctual = gltf.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])
        exact_lights({light.get("name", ""): light for light in punctual})
        for item in self.scene.objects:
            item.cycles.shadow_terminator_offset = 0.0
            item.cycles.shadow_terminator_geometry_offset = 0.0

    def _settings(self, threads):
        scene, cycles, render = self.scene, self.scene.cycles, self.scene.render
        render.engine = "CYCLES"
        cycles.device = "CPU"
        cycles.use_adaptive_sampling = cycles.use_denoising = False
        cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
        cycles.blur_glossy = cycles.light_sampling_threshold = 0.0
        cycles.caustics_reflective = cycles.caustics_refractive = True
        cycles.pixel_filter_type = "BOX"
        cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = BOUNCES
        cycles.transmission_bounces = cycles.transparent_max_bounces = BOUNCES
        cycles.volume_bounces = 0  # absorption does not scatter
        render.resolution_x = render.resolution_y = self.size
        render.resolution_percentage = 100
        render.threads_mode, render.threads = "FIXED", threads
        render.use_persistent_data = True
        render.use_compositing = render.use_sequencer = render.film_transparent = False
        render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
        scene.view_settings.view_transform = "Raw"

    def _world(self, environment):
        """Both map (x, y, z) of glTF to u = 1/2 + atan2(z, x) / 2 pi, v = acos(y) / pi: nothing to turn or mirror."""
        world = bpy.data.worlds.new("environment")
        self.scene.world = world
        world.use_nodes = True
        background = world.node_tree.nodes["Background"]
        if environment is None:
            background.inputs["Strength"].default_value = 0.0
            return
        image = bpy.data.images.load(environment)
        image.colorspace_settings.name = "Linear Rec.709"
        node = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
        node.image = image
        world.node_tree.links.new(node.outputs[0], background.inputs["Color"])

    def bounds(self):
        """Centre (glTF axes) and radius of all meshes."""
        corners = [
            item.matrix_world @ Vector(corner)
            for item in self.scene.objects
            if item.type == "MESH"
            for corner in item.bound_box
        ]
        low = Vector(map(min, *corners))
        high = Vector(map(max, *corners))
        return to_gltf((low + high) / 2), (high - low).length / 2

    def look_at(self, eye, target, fov):
        """eye and target in glTF axes, fov vertical in degrees."""
        camera = bpy.data.cameras.new("view")
        item = bpy.data.objects.new("view", camera)
        self.scene.collection.objects.link(item)
        self.scene.camera = item
        camera.sensor_fit = "VERTICAL"
        camera.angle_y = math.radians(fov)
        camera.clip_start, camera.clip_end = 1e-4, 1e6
        eye, target = to_blender(eye), to_blender(target)
        back = (eye - target).normalized()
        right = Vector((0, 0, 1)).cross(back).normalized()
        item.matrix_world = Matrix.Translation(eye) @ Matrix((right, back.cross(right), back)).transposed().to_4x4()

    def render(self, spp, seed):
        """Linear RGB, row 0 at the top."""
        self.scene.cycles.samples, self.scene.cycles.seed = spp, seed
        with tempfile.TemporaryDirectory() as folder, quiet():
            self.scene.render.filepath = os.path.join(folder, "cycles.exr")
            bpy.ops.render.render(write_still=True)
            return read_image(self.scene.render.filepath)


class quiet:
    """Cycles reports its progress on the file descriptor, past Python."""

    def __enter__(self):
        self.kept = os.dup(1)
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, 1)
        os.close(null)

    def __exit__(self, *_):
        os.dup2(self.kept, 1)
        os.close(self.kept)


def read_image(path):
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    pixels = np.empty(image.size[0] * image.size[1] * 4, np.float32)
    image.pixels.foreach_get(pixels)
    shape = (image.size[1], image.size[0], 4)
    bpy.data.images.remove(image)
    return pixels.reshape(shape)[::-1, :, :3].astype(np.float64)


def write_png(path, values):
    """values in [0, 1], already encoded; row 0 at the top."""
    image = bpy.data.images.new("picture", values.shape[1], values.shape[0])
    image.colorspace_settings.name = "Non-Color"
    rgba = np.ones((*values.shape[:2], 4), np.float32)
    rgba[..., :3] = np.clip(values, 0, 1)
    image.pixels.foreach_set(rgba[::-1].ravel())
    image.file_format = "PNG"
    image.save(filepath=path)
    bpy.data.images.remove(image)


def extension(definition, name):
    return definition.get("extensions", {}).get(name)


def principled_of(material):
    return next((n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED"), None)


def linear_textures():
    """Cycles filters 8-bit colour textures as they are stored and decodes after; Triad filters decoded, linear texels."""
    images = [i for i in bpy.data.images if i.colorspace_settings.name == "sRGB" and i.size[0] and not i.is_float]
    for image in images:
        values = np.empty(image.size[0] * image.size[1] * 4, np.float32)
        image.pixels.foreach_get(values)
        values = values.reshape(-1, 4)
        rgb = values[:, :3]
        values[:, :3] = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
        decoded = bpy.data.images.new(image.name, *image.size, alpha=True, float_buffer=True)
        decoded.colorspace_settings.name = "Non-Color"
        decoded.alpha_mode = "CHANNEL_PACKED"
        decoded.pixels.foreach_set(values.ravel())
        decoded.update()
        for material in bpy.data.materials:
            for node in material.node_tree.nodes if material.use_nodes else ():
                if node.type == "TEX_IMAGE" and node.image == image:
                    node.image = decoded


def exact_absorption(material, definition):
    """glTF absorbs -ln(colour) / distance per metre; the importer makes (1 - colour) / distance of it."""
    volume = extension(definition, "KHR_materials_volume")
    node = next((n for n in material.node_tree.nodes if n.type == "VOLUME_ABSORPTION"), None)
    if node is None:
        return
    distance = volume.get("attenuationDistance", math.inf)
    sigma = [-math.log(max(c, 1e-6)) / distance for c in volume.get("attenuationColor", [1, 1, 1])]
    density = max(*sigma, 0.0)
    if density == 0.0:
        material.node_tree.links.remove(node.outputs[0].links[0])
        return
    node.inputs["Color"].default_value = [*(1 - s / density for s in sigma), 1]
    node.inputs["Density"].default_value = density


class Nodes:
    """Arithmetic on sockets."""

    def __init__(self, tree):
        self.tree = tree

    def new(self, kind, **inputs):
        node = self.tree.nodes.new(kind)
        for name, value in inputs.items():
            self.put(node.inputs[name], value)
        return node

    def put(self, socket, value):
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        else:
            socket.default_value = value

    def math(self, operation, a, b=0.0, clamp=False):
        node = self.tree.nodes.new("ShaderNodeMath")
        node.operation, node.use_clamp = operation, clamp
        self.put(node.inputs[0], a)
        self.put(node.inputs[1], b)
        return node.outputs[0]

    def mix(self, factor, a, b):
        node = self.tree.nodes.new("ShaderNodeMixShader")
        self.put(node.inputs[0], factor)
        self.put(node.inputs[1], a)
        self.put(node.inputs[2], b)
        return node.outputs[0]


def value_of(socket):
    """What feeds a socket: the linked output, or the constant."""
    if socket.is_linked:
        return socket.links[0].from_socket
    value = socket.default_value
    return value if isinstance(value, float) else tuple(value)


def fresnel(c, n):
    """Of a bare face of index n, unpolarised."""
    g = np.sqrt(n * n - 1 + c * c)
    return 0.5 * ((g - c) / (g + c)) ** 2 * (1 + ((c * (g + c) - 1) / (c * (g - c) + 1)) ** 2)


def wall(c, n, specular=1.0):
    """What a wall reflects: both faces, and all reflections between them; specular: the factor of KHR_materials_specular."""
    f = specular * fresnel(c, n)
    return 2 * f / (1 + f)


def seen_microfacets(mu, roughness, samples):
    """From a direction (sin, 0, mu): the angles' cosines at visible normals, the directions that these reflect to, and the shares that leave."""
    alpha = roughness * roughness
    i = np.arange(samples)
    phi, v = 2 * math.pi * (i * 0.6180339887 % 1), (i + 0.5) / samples
    eye = np.array([math.sqrt(max(0.0, 1 - mu * mu)), 0.0, mu])
    o = eye * (alpha, alpha, 1)
    o /= np.linalg.norm(o)
    z = 1 - v * (1 + o[2])  # visible normals by spherical caps: Dupuy and Benyoub 2023
    r = np.sqrt(np.maximum(0, 1 - z * z))
    h = np.stack([alpha * (r * np.cos(phi) + o[0]), alpha * r * np.sin(phi), np.maximum(z + o[2], 1e-9)])
    h /= np.linalg.norm(h, axis=0)
    c = np.clip(eye @ h, 0, 1)
    out = 2 * c * h - eye[:, None]
    smith = lambda x: (np.sqrt(1 + alpha * alpha * (1 / np.maximum(x, 1e-9) ** 2 - 1)) - 1) / 2
    return c, out, np.where(out[2] > 0, (1 + smith(mu)) / (1 + smith(mu) + smith(out[2])), 0)


@functools.lru_cache(None)
def rough_wall(mu, roughness, n, specular=1.0, samples=4096):
    """Share that a wall of GGX microfacets reflects, seen at the cosine mu: the mean of wall() over the normals that are seen from
    there, each at its own angle, by how much of its reflection leaves."""
    if roughness * roughness < 1e-3:
        return float(wall(mu, n, specular))
    c, _, kept = seen_microfacets(mu, roughness, samples)
    return float((kept * wall(c, n, specular)).sum() / kept.sum())


def through_wall(mu, roughness, n, samples):
    """Share that it lets through into the half of directions beyond that goes on away from the eye (not back below it)."""
    if roughness * roughness < 1e-3:
        return 1 - float(wall(mu, n))
    c, out, kept = seen_microfacets(mu, roughness, samples)
    return float((kept * (1 - wall(c, n)) * (out[0] < 0)).sum() / kept.sum())


ROUGHNESSES = (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.65, 0.8, 1.0)


def wall_ramp(nodes, cosine, roughness, n, specular):
    """rough_wall() over the cosine, with stops at squares."""
    ramp = nodes.new("ShaderNodeValToRGB")
    nodes.put(ramp.inputs[0], cosine)
    stops = ramp.color_ramp.elements
    for i in range(32):
        mu = (i / 31) ** 2
        stop = stops[0] if i == 0 else stops[-1] if i == 31 else stops.new(mu)
        stop.position, stop.color = mu, (*[rough_wall(max(mu, 1e-4), roughness, n, specular)] * 3, 1)
    return ramp.outputs[0]


def wall_curve(nodes, roughness, n, specular, normal):
    """rough_wall() of what is looked at, as a socket; of a textured roughness linear between ROUGHNESSES."""
    facing = nodes.new("ShaderNodeLayerWeight", Blend=0.5)
    if normal is not None:
        nodes.put(facing.inputs["Normal"], normal)
    cosine = nodes.math("SUBTRACT", 1.0, facing.outputs["Facing"])
    if isinstance(roughness, float):
        return wall_ramp(nodes, cosine, roughness, n, specular)
    out = wall_ramp(nodes, cosine, 0.0, n, specular)
    for below, above in zip(ROUGHNESSES, ROUGHNESSES[1:]):
        t = nodes.math("DIVIDE", nodes.math("SUBTRACT", roughness, below), above - below, clamp=True)
        step = nodes.math("SUBTRACT", wall_ramp(nodes, cosine, above, n, specular), out)
        out = nodes.math("ADD", out, nodes.math("MULTIPLY", t, step))
    return out


def thin_walls(material, definition, macroscopic=False):
    """Without KHR_materials_volume, transmission is that of a thin wall; Principled would refract into a body.

    A smooth wall of index n reflects R = 2F / (1 + F), F the Fresnel term of one face, and lets the rest through
    unbent, times the base colour. A rough one reflects the mean of R over its microfacets; with `macroscopic` R of its
    macroscopic normal stands in. Mixed with the material without transmission by the transmission's texture.
    """
    transmission = extension(definition, "KHR_materials_transmission")
    volume = extension(definition, "KHR_materials_volume") or {}
    if not transmission or volume.get("thicknessFactor", 0) > 0:
        return
    principled = principled_of(material)
    amount, colour = value_of(principled.inputs["Transmission Weight"]), value_of(principled.inputs["Base Color"])
    specular = (extension(definition, "KHR_materials_specular") or {}).get("specularFactor", 1.0)
    roughness, normal = value_of(principled.inputs["Roughness"]), principled.inputs["Normal"]
    alpha, metallic = value_of(principled.inputs["Alpha"]), value_of(principled.inputs["Metallic"])
    tree = material.node_tree
    for link in list(principled.inputs["Transmission Weight"].links):
        tree.links.remove(link)
    principled.inputs["Transmission Weight"].default_value = 0.0
    nodes = Nodes(tree)
    index = principled.inputs["IOR"].default_value
    glossy = nodes.new("ShaderNodeBsdfAnisotropic", Roughness=roughness, Color=(1, 1, 1, 1))
    mapped = value_of(normal) if normal.is_linked else None
    if mapped is not None:
        nodes.put(glossy.inputs["Normal"], mapped)
    if not macroscopic:
        reflected = wall_curve(nodes, roughness, index, specular, mapped)
    else:
        # the IOR is turned over on back faces by Principled and Fresnel alike; a wall has no inside
        back = nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"]
        index = nodes.math("POWER", index, nodes.math("SUBTRACT", 1.0, nodes.math("MULTIPLY", back, 2.0)))
        bare = nodes.new("ShaderNodeFresnel", IOR=index)
        if mapped is not None:
            nodes.put(bare.inputs["Normal"], mapped)
        f = nodes.math("MULTIPLY", bare.outputs[0], specular)
        reflected = nodes.math("DIVIDE", nodes.math("MULTIPLY", f, 2.0), nodes.math("ADD", f, 1.0))
    pane = nodes.mix(reflected, nodes.new("ShaderNodeBsdfTransparent", Color=colour).outputs[0], glossy.outputs[0])
    nothing = nodes.new("ShaderNodeBsdfTransparent", Color=(1, 1, 1, 1)).outputs[0]
    pane = nodes.mix(alpha, nothing, pane)  # the material's own coverage
    share = nodes.math("MULTIPLY", amount, nodes.math("SUBTRACT", 1.0, metallic))
    mixed = nodes.mix(share, principled.outputs[0], pane)
    output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
    tree.links.new(mixed, output.inputs["Surface"])


def one_sided_emission(material, definition):
    """Triad's emitters shine from their front unless the material is double-sided."""
    principled = principled_of(material)
    if principled is None or definition.get("doubleSided") or not any(definition.get("emissiveFactor", [])):
        return
    nodes = Nodes(material.node_tree)
    front = nodes.math("SUBTRACT", 1.0, nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"])
    strength = principled.inputs["Emission Strength"]
    nodes.put(strength, nodes.math("MULTIPLY", front, value_of(strength)))


def exact_anisotropy(material, definition):
    """glTF widens alpha along the tangent, mix(alpha, 1, strength^2); Principled divides and multiplies alpha by the root of
    1 - 0.9 times its own strength. Ratios of up to 10, of factors without textures."""
    wanted = extension(definition, "KHR_materials_anisotropy")
    principled = principled_of(material)
    if not wanted or principled is None or principled.inputs["Roughness"].is_linked or "anisotropyTexture" in wanted:
        return
    narrow = principled.inputs["Roughness"].default_value ** 2
    wide = narrow + (1 - narrow) * wanted.get("anisotropyStrength", 0) ** 2
    for name in ("Roughness", "Anisotropic", "Anisotropic Rotation", "Tangent"):
        for link in list(principled.inputs[name].links):
            material.node_tree.links.remove(link)
    principled.inputs["Roughness"].default_value = (wide * narrow) ** 0.25
    principled.inputs["Anisotropic"].default_value = min((1 - narrow / wide) / 0.9, 1.0)
    principled.inputs["Anisotropic Rotation"].default_value = wanted.get("anisotropyRotation", 0) / (2 * math.pi)
    tangent = material.node_tree.nodes.new("ShaderNodeTangent")
    tangent.direction_type = "UV_MAP"
    material.node_tree.links.new(tangent.outputs[0], principled.inputs["Tangent"])


def exact_lights(definitions):
    """Points without size, suns without angle, and glTF's cone (linear in the cosine, then squared) for Cycles' own."""
    for item in [item for item in bpy.context.scene.objects if item.type == "LIGHT"]:
        light = item.data
        if light.type == "SUN":
            light.angle = 0.0
            continue
        light.shadow_soft_size = 0.0
        light.use_soft_falloff = False
        if light.type == "SPOT":
            cone = definitions[light.name]["spot"]
            outer = math.cos(cone.get("outerConeAngle", math.pi / 4))
            inner = math.cos(cone.get("innerConeAngle", 0.0))
            point = bpy.data.lights.new(light.name, "POINT")
            point.color, point.energy, point.shadow_soft_size = light.color, light.energy, 0.0
            point.use_soft_falloff = False
            point.use_nodes = True
            nodes = Nodes(point.node_tree)
            emission = next(n for n in point.node_tree.nodes if n.type == "EMISSION")
            axis = item.matrix_world.to_3x3() @ Vector((0, 0, -1))
            dot = nodes.new("ShaderNodeVectorMath")
            dot.operation = "DOT_PRODUCT"
            nodes.put(dot.inputs[0], nodes.new("ShaderNodeNewGeometry").outputs["Incoming"])
            dot.inputs[1].default_value = axis.normalized()
            scale = 1.0 / max(inner - outer, 1e-3)
            ramp = nodes.math("MULTIPLY", nodes.math("SUBTRACT", dot.outputs["Value"], outer), scale, clamp=True)
            nodes.put(emission.inputs["Strength"], nodes.math("MULTIPLY", ramp, ramp))
            item.data = point
