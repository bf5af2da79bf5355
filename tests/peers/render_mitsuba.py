#!/usr/bin/env python3
"""Renders one picture with Mitsuba 3, variant llvm_ad_rgb, as a child of error_for_time.py."""
import drjit
import mitsuba as mi
import numpy as np

mi.set_variant("llvm_ad_rgb")

import mitsuba_hard  # noqa: E402
import render_child  # noqa: E402
from glb_reader import Glb  # noqa: E402

SAMPLES_OF_A_PASS = 2**24  # of all pixels together; more may not fit into memory


def main():
    options = render_child.arguments(__doc__)
    drjit.set_thread_count(options.threads)
    view = (0, options.size, options.size, options.spp, options.depth)
    description = mitsuba_hard.description(mi, Glb(options.scene), view)
    description["camera"]["sampler"]["type"] = options.sampler
    if options.environment:
        description["sky"] = mitsuba_hard.sky(mi, options.environment, options.strength)
    scene = mi.load_dict(description)

    def render(spp, seed):
        largest = max(1, SAMPLES_OF_A_PASS // options.size**2)
        passes = [min(largest, spp - first) for first in range(0, spp, largest)]
        total = 0.0
        for i, samples in enumerate(passes):
            total = total + samples * np.array(mi.render(scene, spp=samples, seed=1000 * seed + i), dtype=float)
        return total / spp

    render_child.measure(options, render, f"Mitsuba {mi.__version__}")


main()
