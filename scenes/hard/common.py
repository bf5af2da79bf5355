"""Materials and a few objects that the hard scenes share."""
import numpy


def lambert(scene, albedo, **members):
    """Lambert's law and nothing else: KHR_materials_specular with factor 0."""
    colour = numpy.broadcast_to(albedo, 3).tolist()
    return scene.material(pbrMetallicRoughness={"baseColorFactor": colour + [1.0], "metallicFactor": 0.0},
                          extensions={"KHR_materials_specular": {"specularFactor": 0.0}}, **members)


def lamp(scene, radiance, albedo=0.0, **members):
    """Lambert that emits `radiance` (one number or three)."""
    radiance = numpy.broadcast_to(radiance, 3).astype(float)
    strength = radiance.max()
    colour = numpy.broadcast_to(albedo, 3).tolist()
    return scene.material(pbrMetallicRoughness={"baseColorFactor": colour + [1.0], "metallicFactor": 0.0},
                          emissiveFactor=(radiance / strength).tolist(),
                          extensions={"KHR_materials_emissive_strength": {"emissiveStrength": strength},
                                      "KHR_materials_specular": {"specularFactor": 0.0}}, **members)


def unlit(scene, colour):
    colour = numpy.broadcast_to(colour, 3).tolist()
    return scene.material(pbrMetallicRoughness={"baseColorFactor": colour + [1.0]},
                          extensions={"KHR_materials_unlit": {}})


def glass(scene, ior, solid=True, colour=(1, 1, 1), distance=None):
    """A smooth clear body, or a thin wall; absorbs so that `colour` is left after `distance`."""
    extensions = {"KHR_materials_transmission": {"transmissionFactor": 1.0}, "KHR_materials_ior": {"ior": ior}}
    if solid:
        extensions["KHR_materials_volume"] = {"thicknessFactor": 1.0}
        if distance:
            extensions["KHR_materials_volume"].update(attenuationColor=list(colour), attenuationDistance=distance)
    return scene.material(pbrMetallicRoughness={"metallicFactor": 0.0, "roughnessFactor": 0.0}, extensions=extensions)


def metal(scene, roughness, colour=(1, 1, 1)):
    return scene.material(pbrMetallicRoughness={"baseColorFactor": [*colour, 1.0], "metallicFactor": 1.0,
                                                "roughnessFactor": roughness})


def place(scene, shape, material, **node):
    """A mesh of one shape and its node; returns the mesh."""
    mesh = scene.mesh(scene.primitive(**shape, material=material))
    scene.node(mesh=mesh, **node)
    return mesh


def rotation(axis, degrees):
    """The 3 x 3 matrix that turns about an axis (Rodrigues)."""
    x, y, z = numpy.asarray(axis, float) / numpy.linalg.norm(axis)
    k = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    t = numpy.radians(degrees)
    return numpy.eye(3) + numpy.sin(t) * k + (1 - numpy.cos(t)) * k @ k


def turned(axis, degrees, translation=(0, 0, 0)):
    """The same as a 4 x 4 matrix, followed by a translation."""
    matrix = numpy.eye(4)
    matrix[:3, :3] = rotation(axis, degrees)
    matrix[:3, 3] = translation
    return matrix


def sun(scene, direction, lux, matrix=None):
    """A directional light that shines along `direction`."""
    from glb import look_at
    direction = numpy.asarray(direction, float)
    up = (0, 1, 0) if abs(direction[1]) < 0.99 * numpy.linalg.norm(direction) else (0, 0, 1)
    placed = look_at((0, 0, 0), direction, up)
    scene.node(light=scene.light("directional", intensity=lux), matrix=placed if matrix is None else matrix @ placed)
