import numpy as np
import pytest

import triad

triad.set_verbosity(0)


@pytest.fixture(autouse=True)
def own_folder(tmp_path, monkeypatch):
    """Every test writes into a folder of its own."""
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def square():
    """A square of side 2 in the plane z = 0, its front towards +z."""
    return dict(
        positions=np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]), indices=np.array([[0, 1, 2], [0, 2, 3]]),
        uvs=np.array([[0, 1], [1, 1], [1, 0], [0, 0]]))


@pytest.fixture
def near():
    """Of this camera the square fills the picture."""
    return triad.Camera(eye=(0, 0, 1), fov=60)
