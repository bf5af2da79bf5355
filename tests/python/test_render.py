"""Renders, films and pictures."""
import os
import pathlib
import signal
import subprocess
import threading
import time

import numpy as np
import pytest

import triad

SMALL = dict(width=40, height=24, spp=4)


def test_image_is_an_array_of_height_width_channels():
    film = triad.render(**SMALL)
    assert film.image.shape == (24, 40, 3) and film.image.dtype == np.float32
    assert film.image.flags.c_contiguous and np.isfinite(film.image).all() and film.image.max() > 0.1
    assert (film.width, film.height, film.spp, film.complete) == (40, 24, 4, True)
    assert 0 < film.relmse < 10
    assert film.metadata["triad:spp"] == "4"
    assert triad.render(**SMALL, background="transparent").image.shape == (24, 40, 4)


@pytest.mark.skipif(os.environ.get("TRIAD") == "none", reason="only the module is installed")
def test_image_is_what_the_command_line_writes():
    command = [os.environ["TRIAD"], "render", "-q", "--size", "40x24", "--spp", "4", "--seed", "5", "--max-depth", "3",
               "--exposure", "1", "-o", "a.exr", "-o", "a.png"]
    subprocess.run(command, check=True)
    film = triad.render(**SMALL, seed=5, max_depth=3)
    assert (film.image == triad.read_image("a.exr")).all()
    assert (film.bitmap(exposure=1) == np.round(triad.read_image("a.png") * 255)).all()


def test_settings_of_every_kind_arrive():
    film = triad.render(
        **SMALL, bins=(2, 2), samples=None, adaptive=False, look_at=np.array([0, 1, 4, 0, 0.5, 0]), fov=np.float32(30),
        aov=["depth", "normal"])
    assert set(film.layers) == {"depth.Z", "normal.X", "normal.Y", "normal.Z"}
    assert film.layers["depth.Z"].shape == (24, 40)
    assert not (film.image == triad.render(**SMALL).image).all()


def test_films_are_kept_and_merged():
    parts = [triad.render(width=16, height=16, samples=samples) for samples in [(0, 2), (2, 6)]]
    whole = triad.render(width=16, height=16, spp=6)
    parts[0].save("part.triadfilm")
    merged = triad.merge([parts[1], triad.load_film(pathlib.Path("part.triadfilm"))])
    assert (merged.image == whole.image).all()
    with pytest.raises(triad.Error) as caught:
        triad.merge([whole, whole])
    assert caught.value.exit_code == 6


def test_pictures_are_written():
    film = triad.render(**SMALL, aov="depth")
    film.write(["a.png", pathlib.Path("a.exr")], exposure=-1)
    film.write("b.png")
    assert triad.read_image("a.png").mean() < triad.read_image("b.png").mean()
    assert (triad.read_image("a.exr") == film.image).all()
    assert film.encode(".png")[:4] == b"\x89PNG" and film._repr_png_() == film.encode(".png")
    assert film.bitmap().dtype == np.uint8 and film.bitmap(bits=16).dtype == np.uint16
    assert abs(film.bitmap(bits=16).astype(float) / 257 - film.bitmap()).max() <= 0.51


def test_film_is_resolved_for_a_panel():
    film = triad.render(width=40, height=24, spp=9, bins=(3, 3))
    rgb, bgr = (triad.resolve(film, panel=panel) for panel in ["rgb", "bgr"])
    assert rgb.shape == (24, 40, 3) and rgb.min() >= 0 and rgb.max() <= 1
    assert not (rgb == bgr).all() and not (rgb == film.image).all()


def test_picture_of_anyone_is_resolved():
    bins = np.zeros((4, 4, 3), np.float32)
    bins[:, ::2, 0] = 1
    bins[:2, :, 2] = 1
    assert np.allclose(triad.resolve(bins, bins=(2, 2)), [[[0.5, 0, 1]] * 2, [[0.5, 0, 0]] * 2])
    assert triad.resolve(np.full((2, 2, 3), 188, np.uint8), bins=(2, 2), reconstruct="pane:2").shape == (1, 1, 3)


def test_compare_knows_films_files_and_arrays():
    film = triad.render(**SMALL)
    film.write("a.exr")
    same = triad.compare(film, "a.exr")
    assert same.rmse == 0 and same.flip == 0 and same.psnr == float("inf")
    difference = triad.compare(film.image + np.float32(0.25), film)
    assert difference.rmse == pytest.approx(0.25, abs=1e-4) and difference.mae == pytest.approx(0.25, abs=1e-4)
    assert triad.compare(np.full((2, 2, 3), 255, np.uint8), np.ones((2, 2, 3))).rmse == 0
    with pytest.raises(triad.Error, match="differ in size") as caught:
        triad.compare(film, np.zeros((2, 2, 3)))
    assert caught.value.exit_code == 7


def test_an_eye_sees_less_of_what_is_made_for_its_panel():
    film = triad.render(width=96, height=64, spp=36, bins=(3, 3))
    reference = triad.render(width=288, height=192, spp=4, reconstruct="pane:1")
    right = triad.perceived(triad.resolve(film, panel="rgb"), reference, "rgb")
    wrong = triad.perceived(triad.resolve(film, panel="bgr"), reference, "rgb")
    assert 0 < right.error < wrong.error and right.de_p95 > right.de_mean
    with pytest.raises(triad.Error, match="cat"):
        triad.perceived(film, reference, "rgb", eye="cat")


def test_progress_is_told_and_stops():
    seen = []

    def progress(p):
        seen.append((p.done, p.spp, p.seconds))
        return len(seen) < 3

    film = triad.render(width=64, height=36, spp=1000000, progress=progress)
    assert len(seen) == 3 and seen == sorted(seen) and not film.complete and 0 < film.spp < 1000000
    assert triad.render(**SMALL, progress=lambda p: None).complete


def test_exceptions_of_progress_come_out():
    def progress(p):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        triad.render(width=8, height=8, spp=1000000, progress=progress)


def test_ctrl_c_ends_a_render():
    started = time.monotonic()
    threading.Timer(1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        triad.render(width=64, height=36, spp=100000000)
    assert time.monotonic() - started < 60


def test_other_threads_run_while_it_renders():
    ticks = []
    done = threading.Event()

    def tick():
        while not done.wait(0.01):
            ticks.append(time.monotonic())

    ticker = threading.Thread(target=tick)
    ticker.start()
    triad.render(width=320, height=180, time=1)
    done.set()
    ticker.join()
    assert len(ticks) > 20


def test_calls_of_other_threads_wait_their_turn():
    film = triad.render(**SMALL)
    film.write("a.exr")
    calls = [triad.devices, triad.panels, lambda: triad.read_image("a.exr"), lambda: triad.compare(film, film),
             film.bitmap, triad.Scene, lambda: film.save("a.triadfilm"), lambda: triad.render(**SMALL)]
    started = []

    def progress(p):
        if not started:
            started.extend(threading.Thread(target=call) for call in calls)
            for thread in started:
                thread.start()
        time.sleep(0.01)  # so that they run and wait
        return p.seconds < 1

    triad.render(width=64, height=36, spp=1000000, progress=progress)
    for thread in started:
        thread.join(timeout=60)
        assert not thread.is_alive()


def test_devices_panels_and_check():
    devices = triad.devices()
    assert any(d.usable and d.chosen and d.compute_units > 0 for d in devices)
    assert "qd-oled" in [panel.name for panel in triad.panels()]
    told = []
    rows = triad.check(level="quick", cases=["M1", "M3"], progress=told.append)
    assert [r.right for r in rows] == [True, True] and len(told) == 2 and rows[0].value <= rows[0].bound


@pytest.mark.parametrize("call, error, words", [
    (lambda: triad.render(spp=1, max_dept=3), triad.Error, "no option 'max_dept'. Did you mean 'max-depth'"),
    (lambda: triad.render(**SMALL, tonemap="pretty"), triad.Error, "--tonemap"),
    (lambda: triad.render(**SMALL, variant="red"), triad.Error, "no variants|load"),
    (lambda: triad.render("/no/such.glb"), triad.Error, "/no/such.glb"),
    (lambda: triad.render(width=-5, height=3), ValueError, "width: expected a whole number from 1"),
    (lambda: triad.render(width=5), triad.Error, "width and height"),
    (lambda: triad.render(width=5.5, height=3), TypeError, "width: expected a whole number, not 5.5"),
    (lambda: triad.render(spp=0), ValueError, "spp"),
    (lambda: triad.render(spp=1, env=3j), TypeError, "env"),
    (lambda: triad.resolve(np.zeros((2, 2))), ValueError, "N x N x 3"),
    (lambda: triad.compare(np.zeros((2, 2, 3), complex), np.zeros((2, 2, 3))), TypeError, "numbers"),
    (lambda: triad.set_verbosity(9), triad.Error, "0, 1 or 2"),
    (lambda: triad.check(level="slow"), triad.Error, "slow"),
])
def test_bad_input_gets_a_sentence(call, error, words):
    with pytest.raises(error, match=words):
        call()
