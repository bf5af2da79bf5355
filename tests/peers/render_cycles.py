#!/usr/bin/env python3
"""Renders one picture with Blender's Cycles, as a child of error_for_time.py.

The scene is set up by cycles_scene.py. Besides, the materials of the comparison get the one BSDF that is meant by them, because
Principled, which the importer makes of them, takes longer to the same picture.
"""
import math
import os
import sys

import bpy

import cycles_scene
import render_child
from glb_reader import Glb


def single_bsdf(material, definition):
    """A lamp that emits and does nothing else, metal, clear glass, or Lambert's law."""
    nodes, principled = cycles_scene.Nodes(material.node_tree), cycles_scene.principled_of(material)
    surface = definition["pbrMetallicRoughness"]
    colour = cycles_scene.value_of(principled.inputs["Base Color"])
    if any(definition.get("emissiveFactor", [])):
        shader = nodes.new("ShaderNodeEmission", Color=cycles_scene.value_of(principled.inputs["Emission Color"]),
                           Strength=cycles_scene.value_of(principled.inputs["Emission Strength"]))
        material.cycles.emission_sampling = "FRONT"
    elif cycles_scene.extension(definition, "KHR_materials_transmission"):
        shader = nodes.new("ShaderNodeBsdfGlass", Color=(1, 1, 1, 1), Roughness=0.0, IOR=cycles_scene.value_of(principled.inputs["IOR"]))
    elif surface.get("metallicFactor", 1) == 1:
        shader = nodes.new("ShaderNodeBsdfMetallic", Roughness=surface["roughnessFactor"])
        shader.fresnel_type, shader.distribution = "F82", "MULTI_GGX"  # with a white edge Schlick's; keeps its energy
        nodes.put(shader.inputs["Base Color"], colour)
        nodes.put(shader.inputs["Edge Tint"], (1, 1, 1, 1))
    else:
        shader = nodes.new("ShaderNodeBsdfDiffuse", Color=colour)
    output = next(node for node in material.node_tree.nodes if node.type == "OUTPUT_MATERIAL")
    material.node_tree.links.new(shader.outputs[0], output.inputs["Surface"])


def main():
    options = render_child.arguments(__doc__)
    glb = Glb(options.scene)
    scene = cycles_scene.CyclesScene(options.scene, options.environment, options.size, options.threads)
    definitions = {definition["name"]: definition for definition in glb.json["materials"]}
    for material in bpy.data.materials:
        if material.name in definitions:
            single_bsdf(material, definitions[material.name])
    if options.environment:
        scene.scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = options.strength
    scene.scene.cycles.use_light_tree = options.light_tree == "on"
    scene.scene.cycles.max_bounces = options.depth - 2  # 0: direct light alone, which is two edges
    node, matrix = next((node, matrix) for node, matrix in glb.nodes() if "camera" in node)
    lens = glb.json["cameras"][node["camera"]]["perspective"]
    scene.look_at(matrix[:3, 3], matrix[:3, 3] - matrix[:3, 2], math.degrees(lens["yfov"]))
    render_child.measure(options, scene.render, f"Cycles {bpy.app.version_string}")
    sys.stdout.flush()
    os._exit(0)  # Blender's module does not always end well


main()
