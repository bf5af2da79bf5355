#!/usr/bin/env python3
"""Renders the hard scenes with Triad and with Mitsuba 3, from the same cameras, and compares the means of 8 x 8 pixels.

  pip install mitsuba==3.9.*        (numpy comes with it; libllvm for the llvm variant: DRJIT_LIBLLVM_PATH)
  python tests/peers/mitsuba_hard.py --triad build/bin/triad --out hard-peers [SCENE...]

A second opinion, not a referee: both compute in single precision. Each renderer renders with two seeds: the mean is
compared, half the difference is its noise. Writes OUT/mitsuba.json and a PNG per scene: Triad, Mitsuba, difference (full
colour at 10 %: red where Triad is brighter). docs/hard.md has the table and says who is right.
"""
import argparse
import json
import os
import subprocess
import sys

import numpy as np

from glb_reader import Glb

TILE = 8
HERE = os.path.dirname(os.path.abspath(__file__))
VIEWS = {  # scene: camera, width, height, samples of either, longest path (edges; 0: no limit)
    "kilometres_and_millimetres": (0, 128, 96, 64, 2),
    "horizon": (0, 128, 96, 64, 2),
    "hair_far_away": (0, 64, 64, 256, 0),
    "slivers": (0, 64, 48, 16, 2),
    "coplanar": (0, 96, 96, 64, 2),
    "twins": (0, 128, 64, 16, 2),
    "terminator": (0, 136, 48, 256, 2),
    "closed_rooms": (1, 64, 48, 256, 0),
    "hundred_million": (0, 128, 96, 64, 2),
    "dielectrics": (0, 144, 24, 1024, 0),
    "glass_stack": (0, 96, 48, 256, 0),
    "sun_in_a_texel": (0, 64, 64, 256, 2),
    "mirrors": (1, 64, 64, 1024, 0),
    "ten_thousand_lights": (0, 32, 32, 4096, 2),
    "white_boxes": (0, 32, 24, 256, 0),
}
# Mitsuba's boundaries name the indices on both sides: what lies within what must be said. Mesh: index around it.
AROUND = {"dielectrics": {2: 1.5, 10: 1.5}}

# Parts of a picture that are compared alone: x, y, width, height.
PARTS = {
    "dielectrics": {name: (24 * column + 6, 6, 12, 12) for column, name in
                    {0: "glass", 1: "water within glass", 3: "water, air, glass", 5: "bubble in glass"}.items()},
    "glass_stack": {"panes": (12, 12, 24, 24), "thin walls": (60, 12, 24, 24)},
}


def material(mi, glb, index, around):
    """(bsdf, emitter or None)"""
    m = glb.json["materials"][index]
    pbr, extensions = m["pbrMetallicRoughness"], m.get("extensions", {})
    colour = {"type": "rgb", "value": pbr.get("baseColorFactor", [1, 1, 1, 1])[:3]}
    emitter = None
    if "emissiveFactor" in m:
        strength = extensions["KHR_materials_emissive_strength"]["emissiveStrength"]
        emitter = {"type": "area", "radiance": {"type": "rgb", "value": [strength * c for c in m["emissiveFactor"]]}}
    if "KHR_materials_transmission" in extensions:
        kind = "dielectric" if "KHR_materials_volume" in extensions else "thindielectric"
        bsdf = {"type": kind, "int_ior": extensions.get("KHR_materials_ior", {"ior": 1.5})["ior"], "ext_ior": around}
        return (bsdf if bsdf["int_ior"] != around else {"type": "null"}), emitter
    if pbr.get("metallicFactor", 1.0) == 1.0:
        alpha = pbr["roughnessFactor"] ** 2
        return {"type": "twosided", "bsdf": {"type": "roughconductor", "material": "none", "distribution": "ggx",
                                             "alpha": alpha, "specular_reflectance": colour}}, emitter
    return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": colour}}, emitter


def shape(mi, glb, primitive, matrix, name, around):
    positions = glb.array(primitive["attributes"]["POSITION"]).astype(float) @ matrix[:3, :3].T + matrix[:3, 3]
    faces = glb.array(primitive["indices"]).reshape(-1, 3)
    if np.linalg.det(matrix[:3, :3]) < 0:
        faces = faces[:, ::-1]
    has_normals = "NORMAL" in primitive["attributes"]
    bsdf, emitter = material(mi, glb, primitive["material"], around)
    properties = mi.Properties()
    properties["bsdf"] = mi.load_dict(bsdf)
    if emitter:
        properties["emitter"] = mi.load_dict(emitter)
    if not has_normals:
        properties["face_normals"] = True
    mesh = mi.Mesh(name, len(positions), len(faces), has_vertex_normals=has_normals, props=properties)
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = positions.astype(np.float32).ravel()
    parameters["faces"] = faces.astype(np.uint32).ravel()
    if has_normals:
        normals = glb.array(primitive["attributes"]["NORMAL"]) @ np.linalg.inv(matrix[:3, :3])
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        parameters["vertex_normals"] = normals.astype(np.float32).ravel()
    parameters.update()
    return mesh


def sky(mi, path, strength=1.0):
    return {"type": "envmap", "filename": str(path), "scale": strength, "to_world": mi.ScalarTransform4f().rotate([0, 1, 0], 90)}


def description(mi, glb, view, name=""):
    """What mi.load_dict takes, without a sky."""
    camera, width, height, spp, depth = view
    transform = mi.ScalarTransform4f
    out = {"type": "scene", "integrator": {"type": "path", "max_depth": depth or -1}}
    cameras = [(n, m) for n, m in glb.nodes() if "camera" in n]
    node, matrix = cameras[camera]
    lens = glb.json["cameras"][node["camera"]]
    eye, forward, up = matrix[:3, 3], -matrix[:3, 2], matrix[:3, 1]
    target = eye + forward * max(1, np.abs(eye).max())
    to_world = transform().look_at(origin=eye.tolist(), target=target.tolist(), up=up.tolist())
    film = {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"}, "pixel_format": "rgb",
            "component_format": "float32"}
    if lens["type"] == "perspective":
        sensor = {"type": "perspective", "fov": float(np.degrees(lens["perspective"]["yfov"])), "fov_axis": "y",
                  "near_clip": 1e-4, "far_clip": 1e8}
    else:
        mag = max(lens["orthographic"]["xmag"], lens["orthographic"]["ymag"] * width / height)
        sensor = {"type": "orthographic", "near_clip": 1e-4, "far_clip": 1e8}
        to_world = to_world @ transform().scale([mag, mag, 1])
    out["camera"] = sensor | {"to_world": to_world, "film": film, "sampler": {"type": "independent", "sample_count": spp}}
    uses = {}
    for node, _ in glb.nodes():
        if "mesh" in node:
            uses[node["mesh"]] = uses.get(node["mesh"], 0) + 1
    count = 0
    for node, matrix in glb.nodes():
        light = node.get("extensions", {}).get("KHR_lights_punctual")
        if light is not None:
            light = glb.json["extensions"]["KHR_lights_punctual"]["lights"][light["light"]]
            value = {"type": "rgb", "value": [light["intensity"] * c for c in light.get("color", [1, 1, 1])]}
            if light["type"] == "directional":
                out[f"light{count}"] = {"type": "directional", "direction": (-matrix[:3, 2]).tolist(), "irradiance": value}
            else:
                out[f"light{count}"] = {"type": "point", "position": matrix[:3, 3].tolist(), "intensity": value}
            count += 1
        if "mesh" not in node:
            continue
        mesh = glb.json["meshes"][node["mesh"]]
        around = AROUND.get(name, {}).get(node["mesh"], 1.0)
        for k, primitive in enumerate(mesh["primitives"]):
            if uses[node["mesh"]] > 100:  # placed by reference
                group = f"group{node['mesh']}"
                if group not in out:
                    out[group] = {"type": "shapegroup", "shape": shape(mi, glb, primitive, np.eye(4), group, around)}
                out[f"shape{count}"] = {"type": "instance", "to_world": transform(matrix.tolist()),
                                        "group": {"type": "ref", "id": group}}
            else:
                out[f"shape{count}"] = shape(mi, glb, primitive, matrix, f"mesh{count}", around)
            count += 1
    return out


def scene(mi, name, path, view):
    out = description(mi, Glb(path + ".glb"), view, name)
    if os.path.exists(path + ".hdr"):
        out["sky"] = sky(mi, path + ".hdr")
    return mi.load_dict(out)


def by_triad(mi, options, path, view, seed):
    camera, width, height, spp, depth = view
    out = os.path.join(options.out, "triad.exr")
    command = [options.triad, "render", path + ".glb", "-q", "-o", out, "--size", f"{width}x{height}", "--spp", str(spp),
               "--seed", str(seed), "--camera", str(camera), "--max-depth", str(depth)]
    if os.path.exists(path + ".hdr"):
        command += ["--env", path + ".hdr"]
    subprocess.run(command, check=True)
    return np.array(mi.Bitmap(out).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32)).astype(float)


def tiles(picture):
    height, width = (n // TILE * TILE for n in picture.shape[:2])
    return picture[:height, :width].reshape(height // TILE, TILE, width // TILE, TILE, 3).mean(axis=(1, 3))


def save_strip(mi, path, triad, mitsuba):
    level = np.percentile(mitsuba, 99) or 1
    difference = np.clip((triad - mitsuba) / (mitsuba + 0.01 * mitsuba.mean() + 1e-30) * 10, -1, 1).mean(axis=2)
    shown = [np.clip(p / level, 0, 1) ** (1 / 2.2) for p in (triad, mitsuba)]
    shown.append(np.stack([np.maximum(difference, 0), 0 * difference, np.maximum(-difference, 0)], axis=2))
    mi.Bitmap((np.concatenate(shown, axis=1) * 255).astype(np.uint8)).write(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--triad", default="build/bin/triad")
    parser.add_argument("--out", default="hard-peers")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="of Mitsuba; scalar_rgb needs no LLVM")
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=f"default: {' '.join(VIEWS)}")
    options = parser.parse_args()
    import mitsuba as mi
    mi.set_variant(options.variant)
    os.makedirs(options.out, exist_ok=True)
    names = options.scenes or list(VIEWS)
    generator = os.path.join(HERE, "../../scenes/hard/generate.py")
    subprocess.run([sys.executable, generator, "--out", options.out, *names], check=True)
    rows = []
    for name in names:
        path = os.path.join(options.out, name)
        a = [by_triad(mi, options, path, VIEWS[name], seed) for seed in (1, 2)]
        loaded = scene(mi, name, path, VIEWS[name])
        b = [np.array(mi.render(loaded, seed=seed)).astype(float) for seed in (1, 2)]
        triad, mitsuba = (a[0] + a[1]) / 2, (b[0] + b[1]) / 2
        whole = mitsuba.mean()
        scale = tiles(mitsuba) + 0.01 * whole + 1e-30
        error = np.abs(tiles(triad) - tiles(mitsuba)) / scale
        noise = [np.sqrt(np.mean((tiles(p[0] - p[1]) / 2 / scale) ** 2)) for p in (a, b)]
        rows.append({"scene": name, "mean_triad": triad.mean(), "mean_mitsuba": whole,
                     "ratio": triad.mean() / whole if whole else None,
                     "within_2_percent": float(np.mean(error.max(axis=2) <= 0.02)),
                     "median": float(np.median(error)), "largest": float(error.max()), "noise_triad": noise[0],
                     "noise_mitsuba": noise[1]})
        r = rows[-1]
        print(f"{name:28} Triad {r['mean_triad']:.6g}  Mitsuba {r['mean_mitsuba']:.6g}  ratio {r['ratio'] or 0:.5f}  "
              f"tiles within 2 % {100 * r['within_2_percent']:.1f}  largest {100 * r['largest']:.2f} %  "
              f"noise {100 * noise[0]:.2f} % {100 * noise[1]:.2f} %", flush=True)
        for part, (x, y, w, h) in PARTS.get(name, {}).items():
            means = [p[y : y + h, x : x + w].mean() for p in (triad, mitsuba)]
            r.setdefault("parts", {})[part] = means
            print(f"    {part:24} Triad {means[0]:.5f}  Mitsuba {means[1]:.5f}", flush=True)
        save_strip(mi, path + ".png", triad, mitsuba)
    with open(os.path.join(options.out, "mitsuba.json"), "w", encoding="utf-8") as file:
        json.dump(rows, file, indent=1)


if __name__ == "__main__":
    main()
