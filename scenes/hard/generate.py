#!/usr/bin/env python3
"""Writes the hard scenes: generate.py [--out FOLDER] [NAME...]; --list names them. README.md says what each asks."""
import argparse
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import geometry  # noqa: E402
import light  # noqa: E402
import scale  # noqa: E402

# name -> function(path of a file that lies beside it or is it, without extension)
SCENES = scale.SCENES | geometry.SCENES | light.SCENES


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default=".", help="folder to write to (default: here)")
    parser.add_argument("--list", action="store_true", help="list the names and end")
    parser.add_argument("names", nargs="*", metavar="NAME", help="scenes to write (default: all)")
    options = parser.parse_args()
    unknown = [name for name in options.names if name not in SCENES]
    if unknown:
        parser.error(f"there is no scene {unknown[0]}; --list names them")
    if options.list:
        print("\n".join(SCENES))
        return
    os.makedirs(options.out, exist_ok=True)
    for name in options.names or SCENES:
        SCENES[name](os.path.join(options.out, name))


if __name__ == "__main__":
    main()
