"""Errors of pictures, the time to a given error, and whether two pictures show the same."""
import math

import numpy as np

TRIMMED = 0.001  # share of the pixels
BLOCK = 16  # pixels
LIMIT = 0.02


def relmse(picture, reference, samples_ratio):
    """(over all pixels, without the worst .1 % of them): mean over pixels and channels of (x - r)^2 / (r^2 + .01). The reference's own
    noise is taken out by dividing by 1 + samples_ratio, its samples being 1 / samples_ratio times as many."""
    errors = np.sort(((picture - reference) ** 2 / (reference**2 + 0.01)).mean(axis=2).ravel()) / (1 + samples_ratio)
    return float(errors.mean()), float(errors[: len(errors) - int(TRIMMED * len(errors))].mean())


def seconds_to(error, points):
    """Where the curve through the points (seconds, error) comes to this error: between points it is straight in the logarithms of both,
    before the first and after the last the error falls as 1 / seconds."""
    points = sorted(points)
    if error >= points[0][1]:
        return points[0][0] * points[0][1] / error
    for (t0, e0), (t1, e1) in zip(points, points[1:]):
        if e1 <= error:
            part = math.log(e0 / error) / math.log(e0 / e1)
            return t0 * (t1 / t0) ** part
    return points[-1][0] * points[-1][1] / error


def blocks(picture):
    """Means over blocks of 16 x 16 pixels and the channels."""
    n = picture.shape[0] // BLOCK
    return picture[: n * BLOCK, : n * BLOCK].reshape(n, BLOCK, n, BLOCK, 3).mean(axis=(1, 3, 4))


def difference(picture, other):
    """(ratio of the means, relative differences of the blocks); 1 % of the mean is added to what blocks are divided by."""
    mine, theirs = blocks(picture), blocks(other)
    return float(picture.mean() / other.mean()), (mine - theirs) / (theirs + 0.01 * theirs.mean())
