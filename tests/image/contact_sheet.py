#!/usr/bin/env python3
"""Every test model as a tile of 256 x 256 pixels: contact sheets, and the table of docs/assets.md.

  tests/image/contact_sheet.py --triad build/bin/triad --assets ../shared/assets --work /tmp/sheet --docs docs

Needs Pillow (10.1 or later). A model with lamps of its own is lit by them, every other by the suite's sky
(scenes/suite/sky.hdr); LOOK names what differs. Tiles that are there are not rendered again: remove WORK, or name models
(`contact_sheet.py ... Duck Fox`: those whose names contain a word) to render them once more. Writes
DOCS/images/assets-N.jpg, and between the two marks of DOCS/assets.md the table. Exit 1 where an exit code is not the
expected one."""
import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import time

from PIL import Image, ImageDraw, ImageFont

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
SKY = REPOSITORY / "scenes/suite/sky.hdr"
SIZE, LABEL, GAP, COLUMNS, ROWS = 256, 20, 2, 8, 5
BEGIN, END = "<!-- table of contact_sheet.py -->", "<!-- end of the table -->"

# What a model needs beyond the defaults. "dark": no sky, though it has no lamp that info counts; "sky": the sky, though it has.
LOOK = {
    "core/playcanvas_geometry-camera-light/geometry-camera-light.glb": ["--exposure", "-2"],
    "deform/blenderio_01_morphed_cube/01_morphed_cube.gltf": ["--env", "STUDIO"],  # a mirror: the sky's ground hides it
    "ext-lights/gdx_spotLightTest/spotLightTest.gltf": ["--look-at=3,5,5,0,0,0"],  # its light falls on the upper side alone
    "ext-lights/nanogl_PointLightTest/PointLightTest.gltf": ["--exposure", "6"],
    "ext-materials/IridescenceSuzanne-glb/IridescenceSuzanne.glb": ["sky"],
    "scenes/GlamVelvetSofa/GlamVelvetSofa.gltf": ["sky"],
    "scenes/bevy_CornellBox/CornellBox.glb": ["dark"],
    # A room without a camera: from within, where one sun of 68300 lux falls through small windows.
    "scenes/bevy_VolumetricFogExample/VolumetricFogExample.glb": [
        "--look-at=-1.7,1.5,4.5,-1.5,1.7,3.5", "--fov", "60", "--exposure", "-12", "--spp", "512"],
}
STUDIO = "env/studio_small_03_1k.hdr"  # of the assets
REFUSED = {  # path: exit code
    "assetgen/Compatibility/Compatibility_04.gltf": 3,
    "assetgen/Compatibility/Compatibility_05.gltf": 3,
    "ext-textures/cesium_BalloonKTX2/CesiumBalloonKTX2.glb": 3,
    "ext-other/SharpGLTF_XmpJsonLd/XmpJsonLd.gltf": 2,
    "ext-other/fastgltf_node_visibility/khr_node_visibility_valid.gltf": 2,
    "ext-other/fastgltf_transform_matrices/transform_matrices.gltf": 2,
    "core/blenderio_00_no_nodes/00_no_nodes.gltf": 2,
    "core/blenderio_00_empty_scene/00_empty_scene.gltf": 2,
}
SKIPPED = ("malformed", "malformed-minimal", "subpixel", "env")


def models(assets):
    found = [p.relative_to(assets).as_posix() for p in assets.rglob("*") if p.suffix in (".gltf", ".glb")]
    return sorted(p for p in found if p.split("/")[0] not in SKIPPED)


def name_of(model):
    """The folder, or the file where a folder holds several."""
    folder, stem = model.split("/")[-2], pathlib.PurePath(model).stem
    return stem if model.startswith("assetgen/") else folder


def tile_of(options, model):
    return options.work / (model.replace("/", "__") + ".png")


def info(options, path):
    done = subprocess.run([options.triad, "info", path, "--json", "-"], capture_output=True, text=True)
    try:
        return json.loads(done.stdout)["rows"][0]
    except (json.JSONDecodeError, KeyError, IndexError):
        return {}


def render(options, model):
    tile = tile_of(options, model)
    kept = tile.with_suffix(".json")
    wanted = any(word in model for word in options.names)
    if kept.exists() and not wanted:
        return json.loads(kept.read_text())
    path = options.assets / model
    facts = info(options, path)
    look = list(LOOK.get(model, []))
    lamps = (facts.get("lights", 0) > 0 or facts.get("environment") or "dark" in look or "--env" in look) and "sky" not in look
    command = [options.triad, "render", path, "-o", tile, "--size", f"{SIZE}x{SIZE}", "-q"]
    command += [] if "--spp" in look else ["--spp", str(options.spp)]
    command += [options.assets / STUDIO if word == "STUDIO" else word for word in look if word not in ("dark", "sky")]
    command += [] if lamps else ["--env", SKY]
    start = time.monotonic()
    done = subprocess.run([*command, "--json", options.work / f"{tile.name}.row"], capture_output=True, text=True)
    row = {"model": model, "exit": done.returncode, "wall_s": time.monotonic() - start, "said": done.stderr.strip(),
           "triangles": facts.get("placed_triangles", 0), "contents": facts.get("contents", {}), "lamps": bool(lamps),
           "used": facts.get("extensions_used", []), "required": facts.get("extensions_required", []),
           "lights": facts.get("lights", 0), "cameras": len(facts.get("cameras", [])), "look": look}
    if done.returncode == 0:
        timed = json.loads((options.work / f"{tile.name}.row").read_text())["rows"][0]
        row.update({k: timed[k] for k in ("load_s", "build_s", "compile_s", "render_s", "render_cpu_s")})
    kept.write_text(json.dumps(row))
    print(f"{row['exit']} {row['wall_s']:6.1f} s  {model}  {row['said'][:200]}", file=sys.stderr, flush=True)
    return row


def sheets(options, rows):
    """Files that were written."""
    font, count, written = ImageFont.load_default(13), COLUMNS * ROWS, []
    for first in range(0, len(rows), count):
        part = rows[first:first + count]
        sheet = Image.new("RGB", (COLUMNS * (SIZE + GAP) - GAP, -(-len(part) // COLUMNS) * (SIZE + LABEL)))
        for i, row in enumerate(part):
            x, y = i % COLUMNS * (SIZE + GAP), i // COLUMNS * (SIZE + LABEL)
            sheet.paste(Image.open(tile_of(options, row["model"])).convert("RGB"), (x, y))
            name = name_of(row["model"]).encode("latin-1", "ignore").decode("latin-1")
            ImageDraw.Draw(sheet).text((x + SIZE // 2, y + SIZE + LABEL // 2), name, font=font, anchor="mm")
        written.append(options.docs / f"images/assets-{first // count + 1}.jpg")
        sheet.save(written[-1], quality=options.quality, optimize=True)
    return written


def special(row):
    words = [e.replace("KHR_", "").replace("materials_", "") for e in row["used"]]
    c = row["contents"]
    kinds = [k.replace("_", " ") for k in c.get("primitives", {}) if k != "triangles"]
    words += kinds
    for key, word in (("skins", "skin"), ("animations", "animation"), ("morph_targets", "morph targets")):
        if c.get(key):
            words.append(word)
    if row["cameras"]:
        words.append("camera")
    if row["look"]:
        look = " ".join(row["look"]).replace("STUDIO", pathlib.PurePath(STUDIO).name)
        words.append({"dark": "without sky", "sky": "with sky"}.get(look, f"`{look}`"))
    return ", ".join(words)


def licences(assets):
    """By folder: what MANIFEST.json says."""
    entries = json.loads((assets / "MANIFEST.json").read_text())
    return {"/".join(entry["entry"].split("/")[:2]): entry["spdx"].split(" (")[0] for entry in entries}


def table(rows, licence):
    lines = ["| sheet | model | triangles | seconds | exit | special | licence |", "|---|---|---|---|---|---|---|"]
    shown = 0
    for row in rows:
        sheet = ""
        if row["exit"] == 0:
            place = shown % (COLUMNS * ROWS)
            sheet = f"{shown // (COLUMNS * ROWS) + 1}, row {place // COLUMNS + 1}, {place % COLUMNS + 1}"
            shown += 1
        seconds = f"{row['render_cpu_s']:.1f}" if row["exit"] == 0 else ""
        lines.append(f"| {sheet} | {row['model'].split('/')[0]}/{name_of(row['model'])} | {row['triangles']} | {seconds} | {row['exit']} "
                     f"| {special(row)} | {licence.get('/'.join(row['model'].split('/')[:2]), '')} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="render models again whose path contains one of these")
    parser.add_argument("--triad", default="build/bin/triad")
    parser.add_argument("--assets", type=pathlib.Path, default=os.environ.get("TRIAD_TEST_ASSETS", "../shared/assets"))
    parser.add_argument("--work", type=pathlib.Path, required=True, help="folder of the tiles")
    parser.add_argument("--docs", type=pathlib.Path, default=REPOSITORY / "docs")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--quality", type=int, default=85)
    options = parser.parse_args()
    options.assets = pathlib.Path(options.assets)
    options.work.mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        rows = list(pool.map(lambda model: render(options, model), models(options.assets)))
    for written in sheets(options, [row for row in rows if row["exit"] == 0]):
        print(written, written.stat().st_size)
    page = options.docs / "assets.md"
    text = page.read_text()
    if BEGIN in text:
        before, rest = text.split(BEGIN, 1)
        page.write_text(f"{before}{BEGIN}\n{table(rows, licences(options.assets))}\n{END}{rest.split(END, 1)[1]}")
    wrong = [row for row in rows if row["exit"] != REFUSED.get(row["model"], 0)]
    for row in wrong:
        print(f"exit {row['exit']}: {row['model']}: {row['said']}", file=sys.stderr)
    return 1 if wrong else 0


sys.exit(main())
