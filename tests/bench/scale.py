#!/usr/bin/env python3
"""How the work before a picture grows with the scene (needs python3-numpy, gnuplot-nox; 20 GB of disk at the largest sizes).

  tests/bench/scale.py [--program build/bin/triad] [--folder DIR] [--limit N] [--plot FILE.svg] [FAMILY ...]

Makes scenes of five kinds at growing sizes and renders 64x64 pixels, one sample each, of every one. Prints per scene: size of its files,
seconds to load and to build, bytes per second, what must be kept (the scene on the host, and what the device reads, which on a CPU is
memory of the process), and by how much the process grew at most beyond that of a scene of two triangles."""
import argparse
import json
import multiprocessing
import os
import struct
import subprocess
import sys
import tempfile
import zlib

import numpy as np

GLB, JSON_CHUNK, BINARY_CHUNK = 0x46546C67, 0x4E4F534A, 0x004E4942


class Document:
    """A glTF file that grows by accessors."""

    def __init__(self):
        self.parts, self.size = [], 0
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [], "meshes": [],
                     "bufferViews": [], "accessors": []}

    def add(self, values, kind, component, bounds=False):
        data = np.ascontiguousarray(values)
        view = {"buffer": 0, "byteOffset": self.size, "byteLength": data.nbytes}
        self.json["bufferViews"].append(view)
        accessor = {"bufferView": len(self.json["bufferViews"]) - 1, "componentType": component, "type": kind, "count": len(data)}
        if bounds:
            accessor.update(min=data.min(0).tolist(), max=data.max(0).tolist())
        self.json["accessors"].append(accessor)
        self.parts.append(data)
        self.size += data.nbytes
        assert self.size % 4 == 0
        return len(self.json["accessors"]) - 1

    def write(self, path):
        if self.size:
            self.json["buffers"] = [{"byteLength": self.size}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        with open(path, "wb") as f:
            f.write(struct.pack("<III", GLB, 2, 20 + len(text) + (8 + self.size if self.size else 0)))
            f.write(struct.pack("<II", len(text), JSON_CHUNK) + text)
            if self.size:
                f.write(struct.pack("<II", self.size, BINARY_CHUNK))
                for part in self.parts:
                    f.write(part.tobytes())


def relief(document, triangles):
    """A mesh of so many triangles over the unit square, with normals and texture coordinates."""
    side = max(1, round((triangles / 2) ** .5))
    y, x = np.meshgrid(*[np.linspace(0, 1, side + 1, dtype=np.float32)] * 2, indexing="ij")
    position = np.stack([x, y, .05 * np.sin(40 * x) * np.sin(40 * y)], -1).reshape(-1, 3).astype(np.float32)
    normal = np.zeros_like(position)
    normal[:, 2] = 1
    corner = (np.arange(side, dtype=np.uint32)[:, None] * (side + 1) + np.arange(side, dtype=np.uint32)).reshape(-1, 1)
    index = (corner + np.array([0, 1, side + 2, 0, side + 2, side + 1], np.uint32)).reshape(-1)
    attributes = {"POSITION": document.add(position, "VEC3", 5126, True), "NORMAL": document.add(normal, "VEC3", 5126),
                  "TEXCOORD_0": document.add(np.stack([x, y], -1).reshape(-1, 2), "VEC2", 5126)}
    return {"attributes": attributes, "indices": document.add(index, "SCALAR", 5125)}


def spread(count):
    """Places in a cube, side by side."""
    side = round(count ** (1 / 3) + .5)
    i = np.arange(count)
    return 1.5 * np.stack([i % side, i // side % side, i // side**2], -1).astype(np.float32)


def triangles(count, folder):
    d = Document()
    d.json["meshes"] = [{"primitives": [relief(d, count)]}]
    d.json["nodes"] = [{"mesh": 0}]
    return d


def nodes(count, folder):
    d = Document()
    d.json["meshes"] = [{"primitives": [relief(d, 8)]}]
    d.json["nodes"] = [{"children": list(range(1, count + 1))}]
    d.json["nodes"] += [{"mesh": 0, "translation": place} for place in spread(count).tolist()]
    return d


def instances(count, folder):
    d = Document()
    d.json["meshes"] = [{"primitives": [relief(d, 8)]}]
    places = d.add(spread(count), "VEC3", 5126)
    d.json["nodes"] = [{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places}}}}]
    d.json["extensionsUsed"] = d.json["extensionsRequired"] = ["EXT_mesh_gpu_instancing"]
    return d


def materials(count, folder):
    d = Document()
    shape = relief(d, 8)
    d.json["materials"] = [{"pbrMetallicRoughness": {"roughnessFactor": (i + 1) / count}} for i in range(count)]
    d.json["meshes"] = [{"primitives": [dict(shape, material=i)]} for i in range(count)]
    d.json["nodes"] = [{"children": list(range(1, count + 1))}]
    d.json["nodes"] += [{"mesh": i, "translation": place} for i, place in enumerate(spread(count).tolist())]
    return d


def png(path, side, shade):
    """A wavy picture of side x side, 8-bit RGB."""
    wave = (127 + 120 * np.sin(np.arange(side) / (3 + shade))).astype(np.uint8)
    rows = np.zeros((side, 1 + 3 * side), np.uint8)
    rows[:, 1:] = np.stack([np.minimum(wave[:, None], wave), np.broadcast_to(wave, (side, side)), wave[:, None] // 2 + wave // 2], -1
                           ).reshape(side, -1)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(path, "wb") as f:
        f.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0))
                + chunk(b"IDAT", zlib.compress(rows.tobytes(), 1)) + chunk(b"IEND", b""))


def textures(count, folder):
    d = materials(count, folder)
    for i in range(count):
        png(os.path.join(folder, f"{i}.png"), 4096, i)
        d.json["materials"][i]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": i}
    d.json["images"] = [{"uri": f"{i}.png"} for i in range(count)]
    d.json["textures"] = [{"source": i} for i in range(count)]
    return d


# 36 million triangles are a GLB of 1 GB.
FAMILIES = {triangles: [100_000, 1_000_000, 10_000_000, 36_000_000], nodes: [1000, 10_000, 100_000, 1_000_000],
            instances: [10_000, 100_000, 1_000_000], materials: [100, 1000, 10_000], textures: [1, 10, 100]}


def make(family, count, path):
    """In a process of its own: what is started later counts the largest size of its parent as its own."""
    def work():
        family(count, os.path.dirname(path)).write(path)

    process = multiprocessing.Process(target=work)
    process.start()
    process.join()
    if process.exitcode:
        sys.exit(f"{path}: not made")


def measured(program, path, options):
    """Report of a render, with the largest resident size of the process in bytes and its seconds of processors."""
    output = os.path.join(os.path.dirname(path), "picture.exr")
    command = [program, "render", path, "--size", "64x64", "--spp", "1", "-q", "--json", "-", "-o", output, *options]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    text = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        sys.exit(f"{path}: exit {os.waitstatus_to_exitcode(status)}")
    return dict(json.loads(text)["rows"][0], peak=usage.ru_maxrss * 1024, cpu_s=usage.ru_utime + usage.ru_stime)


def plot(rows, path):
    script = ["set terminal svg size 800,480 dynamic background rgb 'white'", f"set output '{path}'", "set logscale xy", "set key bottom right",
              "set xlabel 'units: triangles, nodes, instances, materials, textures'", "set ylabel 'load and build, seconds'"]
    names = list(dict.fromkeys(row["family"] for row in rows))
    for i, name in enumerate(names):
        data = "\n".join(f"{r['count']} {r['load_s'] + r['build_s']}" for r in rows if r["family"] == name)
        script += [f"$d{i} << E", data, "E"]
    script.append("plot " + ", ".join(f"$d{i} with linespoints linewidth 2 title '{name}'" for i, name in enumerate(names)))
    subprocess.run(["gnuplot"], input="\n".join(script), text=True, check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("families", nargs="*", help=", ".join(f.__name__ for f in FAMILIES))
    parser.add_argument("--program", default="build/bin/triad")
    parser.add_argument("--folder", help="for the scenes, which are kept; default: a temporary one, each scene removed after its run")
    parser.add_argument("--limit", type=int, default=10**9, help="leave out larger scenes")
    parser.add_argument("--plot", help="seconds against size, as SVG")
    parser.add_argument("--options", default="", help="more options of the renders")
    options = parser.parse_args()
    if unknown := set(options.families) - {f.__name__ for f in FAMILIES}:
        parser.error(f"unknown family {sorted(unknown)}")
    rows = []
    print("| scene | units | files MB | load s | build s | CPU s | MB/s of files | us per unit | kept MB | grown MB | grown / kept |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as temporary:
        small = os.path.join(temporary, "small.glb")
        make(triangles, 2, small)
        measured(options.program, small, options.options.split())  # compiles
        base = measured(options.program, small, options.options.split())
        for family, counts in FAMILIES.items():
            for count in counts:
                if count > options.limit or options.families and family.__name__ not in options.families:
                    continue
                with tempfile.TemporaryDirectory(dir=options.folder) as folder:
                    path = os.path.join(folder, f"{family.__name__}-{count}.glb")
                    make(family, count, path)
                    files = sum(os.path.getsize(os.path.join(folder, f)) for f in os.listdir(folder))
                    r = measured(options.program, path, options.options.split())
                work = r["load_s"] + r["build_s"]
                kept = sum(r[k] - base[k] for k in ("scene_bytes", "device_bytes"))
                grown = r["peak"] - base["peak"]
                rows.append(dict(r, family=family.__name__, count=count))
                print(f"| {family.__name__} | {count:,} | {files / 1e6:.1f} | {r['load_s']:.2f} | {r['build_s']:.2f} | {r['cpu_s']:.2f} "
                      f"| {files / 1e6 / work:.1f} | {1e6 * work / count:.2f} | {kept / 1e6:.1f} | {grown / 1e6:.1f} | {grown / kept:.2f} |",
                      flush=True)
    if options.plot:
        plot(rows, options.plot)


if __name__ == "__main__":
    main()
