"""What the child processes of error_for_time.py are told, and what they hand back.

A child renders a scene once with one sample, so that what is built or compiled for the first picture is not in the time of the second,
which counts. It writes OUT.npz: `picture` (linear RGB, row 0 at the top), `seconds` (user and system time of this process while it
rendered) and `version`.
"""
import argparse
import time

import numpy as np


def arguments(description):
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("scene", help="a .glb file")
    parser.add_argument("out", help="the .npz file to write")
    parser.add_argument("--environment", help="a latitude-longitude picture")
    parser.add_argument("--strength", type=float, default=1.0, help="of the environment")
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--depth", type=int, default=16, help="longest path in edges, from the camera to the lamp")
    parser.add_argument("--sampler", default="independent", help="of Mitsuba")
    parser.add_argument("--light-tree", choices=("on", "off"), default="on", help="of Cycles")
    return parser.parse_args()


def measure(options, render, version):
    """render(spp, seed) gives a picture."""
    render(1, options.seed + 1)
    begin = time.process_time()
    picture = render(options.spp, options.seed)
    seconds = time.process_time() - begin
    np.savez(options.out, picture=np.asarray(picture, np.float32), seconds=seconds, version=version)
