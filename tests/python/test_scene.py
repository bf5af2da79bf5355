"""Scenes of files and of arrays."""
import json
import pathlib

import numpy as np
import pytest

import triad

CORNELL = pathlib.Path(__file__).parents[2] / "scenes" / "cornell" / "cornell.gltf"


def test_file_is_loaded_and_rendered():
    scene = triad.load(CORNELL)
    assert scene.name == "cornell.gltf" and scene.triangles > 10 and len(scene.cameras) >= 1
    low, high = np.array(scene.bounds).reshape(2, 3)
    assert (low < high).all()
    image = triad.render(scene, width=24, height=24, spp=4).image
    assert (image == triad.render(str(CORNELL), width=24, height=24, spp=4, strict=True).image).all()


def test_emission_of_arrays_is_what_is_seen(square, near):
    scene = triad.make_scene([triad.Mesh(**square)], [triad.Material((0, 0, 0), emission=(1, 2, 0.5))], near)
    assert scene.triangles == 2 and scene.bounds == [-1, -1, 0, 1, 1, 0]
    image = triad.render(scene, width=8, height=8, spp=4, max_depth=1).image
    assert np.allclose(image, [1, 2, 0.5], atol=1e-5)


def test_matrix_places_a_mesh(square, near):
    lamp = triad.Material((0, 0, 0), emission=(1, 1, 1))
    move = np.eye(4)
    move[0, 3] = 1  # to the right: its left edge is in the middle of the picture
    scene = triad.make_scene([triad.Mesh(**square, to_world=move)], [lamp], near)
    assert scene.bounds == [0, -1, 0, 2, 1, 0]
    image = triad.render(scene, width=8, height=8, spp=16, max_depth=1, background="transparent").image
    assert np.allclose(image[:, 4:, 0], 1) and np.allclose(image[:, :4, 0], 0)


def test_texture_of_an_array_lies_on_its_mesh(square, near):
    texture = np.zeros((2, 2, 3), np.uint8)
    texture[0] = (255, 0, 0)  # the upper half
    texture[1] = (0, 0, 255)
    material = triad.Material((0.5, 0.5, 0.5), base_colour_texture=texture)
    scene = triad.make_scene([triad.Mesh(**square)], [material], near)
    image = triad.render(scene, width=16, height=16, spp=64, look="white", ground="off").image
    assert image[1, :, 0].mean() > 3 * image[1, :, 2].mean()
    assert image[-2, :, 2].mean() > 3 * image[-2, :, 0].mean()


def test_glass_and_smooth_normals(square):
    from triad import Camera, Material, Mesh
    n = 24
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 2 * n + 1), np.linspace(0, np.pi, n + 1))
    ball = np.stack([np.cos(u) * np.sin(v), np.cos(v), -np.sin(u) * np.sin(v)], -1).reshape(-1, 3)
    i = (np.arange(n)[:, None] * (2 * n + 1) + np.arange(2 * n)).ravel()
    faces = np.concatenate([np.stack([i, i + 2 * n + 1, i + 1], -1), np.stack([i + 1, i + 2 * n + 1, i + 2 * n + 2], -1)])
    glass = Material((1, 1, 1), roughness=0, transmission=1, thickness=1)
    scene = triad.make_scene([Mesh(ball, faces, normals=ball)], [glass], Camera((0, 0, 4)))
    image = triad.render(scene, width=16, height=16, spp=256, look="white", ground="off").image
    # In light that is even everywhere a body without absorption cannot be seen.
    assert np.abs(image / image[0, 0] - 1).mean() < 0.02


@pytest.mark.parametrize("change, error, words", [
    (dict(positions=np.zeros((4, 2))), ValueError, "positions of mesh 0: expected an array of N x 3, not an array of 4 x 2"),
    (dict(positions=[["a", "b", "c"]]), TypeError, "positions of mesh 0: expected numbers"),
    (dict(indices=np.zeros((2, 3))), TypeError, "indices of mesh 0: expected whole numbers, not an array of float64"),
    (dict(indices=[[0, 1, -1]]), ValueError, "from 0 to 4294967295"),
    (dict(indices=[[0, 1, 4]]), triad.Error, "include 4, and it has 4 vertices"),
    (dict(normals=np.ones((3, 3))), triad.Error, "normals of Mesh 0 are 3"),
    (dict(material=1), triad.Error, "Mesh 0 has material 1, and there are 1"),
    (dict(to_world=np.eye(3)), ValueError, "expected an array of 4 x 4"),
    (dict(name="lid", uvs=[0, 1]), ValueError, "uvs of mesh 0 'lid'"),
    (dict(positions=np.full((4, 3), np.nan)), triad.Error, "nothing to render|Mesh"),
])
def test_bad_mesh_is_named(square, change, error, words):
    with pytest.raises(error, match=words):
        triad.render(triad.make_scene([triad.Mesh(**{**square, **change})]), width=8, height=8, spp=1)


@pytest.mark.parametrize("change, error, words", [
    (dict(base_colour=(1, 1)), ValueError, "base_colour of material 0"),
    (dict(metallic=2), triad.Error, "Material 0"),
    (dict(metallic=(0, 1)), ValueError, "metallic of material 0: expected one value, not an array of 2"),
    (dict(metallic="much"), TypeError, "metallic of material 0"),
    (dict(emission=(-1, 0, 0)), triad.Error, "Material 0"),
    (dict(ior=0.5), triad.Error, "index of refraction"),
    (dict(base_colour_texture=np.zeros((2, 2, 3))), TypeError, "uint8"),
    (dict(base_colour_texture=np.zeros((2, 2), np.uint8)), ValueError, "N x N x 3"),
])
def test_bad_material_is_named(square, change, error, words):
    with pytest.raises(error, match=words):
        triad.make_scene([triad.Mesh(**square)], [triad.Material(**change)])


def test_bad_file_is_said():
    pathlib.Path("bad.gltf").write_text(json.dumps({"asset": {"version": "1.0"}}))
    with pytest.raises(triad.Error, match="bad.gltf") as caught:
        triad.load("bad.gltf")
    assert caught.value.exit_code in (2, 3)
    with pytest.raises(triad.Error, match="--spp is an option of render"):
        triad.load(CORNELL, spp=4)
