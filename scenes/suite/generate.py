#!/usr/bin/env python3
"""Writes the suite's scenes and skies: ./generate.py [FOLDER]. Needs python3-numpy. What it writes is kept beside it, so that
nobody needs Python to run the suite."""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent))

import pictures  # noqa: E402
import places  # noqa: E402
import studio  # noqa: E402

SCENES = {"knot": studio.knot, "metals": studio.metals, "glass": studio.glasses, "plates": studio.plates, "lamps": places.lamps,
          "garden": places.garden, "rotunda": places.rotunda, "corridor": places.corridor}


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE
    for name, make in SCENES.items():
        make().write(folder / f"{name}.glb")
    (folder / "sky.hdr").write_bytes(pictures.hdr(pictures.sky()))
    (folder / "sun.hdr").write_bytes(pictures.hdr(pictures.sky(sun=pictures.SUN)))


main()
