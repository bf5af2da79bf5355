"""What the suite's scenes share: materials, lamps, the camera."""
import math

import numpy

import forms
import shapes
from glb import look_at


def surface(scene, name, colour, roughness=0.8, metallic=0.0, lambert=False, **members):
    """A material without textures; lambert: without the coat's reflection."""
    if lambert:
        members["extensions"] = {"KHR_materials_specular": {"specularFactor": 0.0}}
    return scene.material(name, pbrMetallicRoughness={"baseColorFactor": [*colour, 1], "metallicFactor": metallic,
                                                      "roughnessFactor": roughness}, **members)


def lamp(scene, name, radiance, double_sided=False):
    strength = max(radiance)
    return scene.material(name, pbrMetallicRoughness={"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0},
                          emissiveFactor=[r / strength for r in radiance], doubleSided=double_sided,
                          extensions={"KHR_materials_emissive_strength": {"emissiveStrength": strength},
                                      "KHR_materials_specular": {"specularFactor": 0.0}})


def glass(scene, name, tint=(1, 1, 1), distance=1.0, roughness=0.0):
    return scene.material(name, pbrMetallicRoughness={"metallicFactor": 0, "roughnessFactor": roughness},
                          extensions={"KHR_materials_transmission": {"transmissionFactor": 1},
                                      "KHR_materials_volume": {"thicknessFactor": 1, "attenuationColor": list(tint),
                                                               "attenuationDistance": distance}})


def put(scene, form, material, name, **place):
    return scene.node(mesh=scene.mesh(scene.primitive(**form, material=material), name=name), name=name, **place)


def camera(scene, eye, target, degrees, aspect=16 / 9):
    scene.node(camera=scene.perspective(math.radians(degrees), aspect), matrix=look_at(eye, target), name="camera")


def panel(scene, name, radiance, centre, target, width, height):
    """A rectangular lamp that shines at target."""
    m = look_at(centre, target)[:3]
    put(scene, shapes.quad(m[:, 3] - width / 2 * m[:, 0] - height / 2 * m[:, 1], height * m[:, 1], width * m[:, 0]),
        lamp(scene, name, radiance), name)


def plain(form):
    """Without UVs, for materials that have no texture."""
    return {key: value for key, value in form.items() if key != "uvs"}


def cove(half_width, front, back, height, radius, steps=16):
    """A floor that rises into a wall without an edge, as in a photographer's studio."""
    bend = numpy.linspace(0, math.pi / 2, steps + 1)
    z = numpy.concatenate([[front], back + radius - radius * numpy.sin(bend), [back]])
    y = numpy.concatenate([[0], radius - radius * numpy.cos(bend), [height]])
    ny = numpy.concatenate([[1], numpy.cos(bend), [0]])
    nz = numpy.concatenate([[0], numpy.sin(bend), [1]])
    side = numpy.array([-half_width, half_width])
    points = numpy.stack([numpy.broadcast_to(side, (len(z), 2)), numpy.repeat(y, 2).reshape(-1, 2),
                          numpy.repeat(z, 2).reshape(-1, 2)], axis=-1)
    normals = numpy.stack([numpy.zeros((len(z), 2)), numpy.repeat(ny, 2).reshape(-1, 2), numpy.repeat(nz, 2).reshape(-1, 2)],
                          axis=-1)
    return forms.grid(points, normals)
