"""Drives the page of `triad view` in Chromium as a person does: view_page.py TRIAD FOLDER. Exit 0 when all is as it should be.

No time is asserted: everything is waited for.
"""
import base64
import json
import os
import shlex
import signal
import struct
import subprocess
import sys

from chromium import Chromium

triad, folder = sys.argv[1:]
width, height = 320, 180


def scene():
    """A quad in the light of a lamp, with two variants and two cameras."""
    corners = struct.pack("<12f", -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0)
    data = corners + struct.pack("<6H", 0, 1, 2, 0, 2, 3)

    def material(colour):
        return {"pbrMetallicRoughness": {"baseColorFactor": colour, "metallicFactor": 0}, "doubleSided": True}

    gltf = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2, 3]}],
        "extensionsUsed": ["KHR_materials_variants", "KHR_lights_punctual"],
        "extensions": {"KHR_materials_variants": {"variants": [{"name": "red"}, {"name": "blue"}]},
                       "KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 40, "color": [1, 1, 1]}]}},
        "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 4]}, {"camera": 1, "translation": [0.5, 0, 2]},
                  {"translation": [1, 1, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "cameras": [{"type": "perspective", "name": name, "perspective": {"yfov": 0.7, "znear": 0.1}} for name in ("far", "near")],
        "materials": [material([0.8, 0.05, 0.05, 1]), material([0.05, 0.05, 0.8, 1])],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0, "extensions": {
            "KHR_materials_variants": {"mappings": [{"material": i, "variants": [i]} for i in (0, 1)]}}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
                      {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
        "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
    }
    path = os.path.join(folder, "a scene.gltf")
    with open(path, "w", encoding="utf-8") as file:
        json.dump(gltf, file)
    return path


class View:
    """The program, and a page that shows it."""

    def __init__(self, page, url):
        self.page = page
        page.open(url)
        # Whether a coarse picture came since it was last asked.
        page.js("""(() => { window.coarse = 0; const picture = document.querySelector('#picture');
            new MutationObserver(() => { if (picture.dataset.coarse === 'true') ++window.coarse; })
                .observe(picture, { attributes: true, attributeFilter: ['data-frames'] }); })()""")
        self.grown()

    def text(self, selector):
        return self.page.js(f"document.querySelector('{selector}').textContent")

    def mean(self, x=0, y=0, w=width, h=height):
        """Mean R, G and B of a part of the picture."""
        return self.page.js(f"""(() => {{ const c = document.querySelector('#picture');
            const d = c.getContext('2d').getImageData({x}, {y}, {w}, {h}).data, sum = [0, 0, 0];
            for (let i = 0; i < d.length; ++i) if (i % 4 < 3) sum[i % 4] += d[i];
            return sum.map((v) => v / (d.length / 4)); }})()""")

    def grown(self):
        """Waits for a picture that is not coarse and has samples."""
        self.page.until("document.querySelector('#picture').dataset.coarse === 'false' && "
                        "/^[1-9]/.test(document.querySelector('#numbers').textContent)")

    def after(self, act):
        """What follows a move: a coarse picture, then a fine one. Returns how the mean changed."""
        before = self.mean()
        self.page.js("window.coarse = 0")
        act()
        self.page.until("window.coarse > 0")
        self.grown()
        return max(abs(a - b) for a, b in zip(self.mean(), before))


def check(condition, words):
    if not condition:
        raise AssertionError(words)


def said(page):
    """What the page logged, but what reading its canvas here makes Chromium say."""
    return [line for line in page.log if "getImageData" not in line]


def leads_the_camera(view):
    page = view.page
    x, y = page.centre("#stage")
    check("--look-at" not in view.text("#command"), "a command names an eye before any move")
    check(view.after(lambda: page.drag((x, y), (x + 120, y + 30))) > 1, "a drag changes nothing")
    check("--look-at=" in view.text("#command"), "the command does not follow the eye")
    page.until("document.querySelector('#camera').selectedOptions[0].textContent === 'Led by hand'")
    check(view.after(lambda: page.wheel(x, y, -400)) > 1, "the wheel changes nothing")
    check(view.after(lambda: page.drag((x, y), (x + 60, y), shift=True)) > 0.2, "shift and drag change nothing")
    for key in ("ArrowLeft", "+"):
        check(view.after(lambda key=key: page.key(key)) > 0.2, f"{key} changes nothing")
    view.after(lambda: page.key("Home"))
    check("--look-at" not in view.text("#command"), "Home does not lead back")
    near = view.after(lambda: page.choose("#camera", "1"))
    check(near > 1, "another camera shows the same")
    view.after(lambda: page.key("c"))
    page.until("document.querySelector('#camera').value === '-1'")
    check("Trees built once" in view.text("#device"), "moves built trees again")


def changes_tones(view):
    page = view.page
    before = sum(view.mean())
    for _ in range(4):
        page.key("]")
    page.until("document.querySelector('#exposure-value').textContent === '+1 EV'")
    page.until(f"(() => {{ const c = document.querySelector('#picture'); const d = c.getContext('2d').getImageData(0, 0, {width}, {height}).data;"
               f"let s = 0; for (let i = 0; i < d.length; ++i) if (i % 4 < 3) s += d[i]; return s / (d.length / 4) > {before} * 1.05; }})()")
    page.choose("#tonemap", "agx")
    page.until("document.querySelector('#command').textContent.includes('--tonemap=agx')")
    page.choose("#tonemap", "khronos")


def changes_the_variant(view):
    page = view.page
    red = view.mean(100, 60, 100, 60)
    check(red[0] > red[2], f"the quad is not red: {red}")
    view.after(lambda: page.choose("#variant", "blue"))
    page.until("document.querySelector('#command').textContent.includes('--variant=blue')")
    blue = view.mean(100, 60, 100, 60)
    check(blue[2] > blue[0], f"the quad is not blue: {blue}")


def magnifies_emitters(view):
    page = view.page
    page.choose("#panel", "rgb")
    page.until("document.querySelector('#device').textContent.includes('Reconstruction: triad')")
    view.grown()
    x, y = page.centre("#stage")
    page.mouse("mouseMoved", x, y)
    page.mouse("mouseMoved", x + 5, y)
    # Blue light: some samples are blue, and between the emitters all is dark.
    page.until("""(() => { const c = document.querySelector('#lens'); if (c.hidden || c.width < 100) return false;
        const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data; let blue = 0, dark = 0;
        for (let i = 0; i < d.length; i += 4) { blue += d[i + 2] > 100 && d[i] < 30; dark += d[i + 2] < 5; }
        return blue > 500 && dark > 500; })()""")
    page.key("x")
    page.until("document.querySelector('#device').textContent.includes('whole pixels')")
    page.key("m")
    page.until("document.querySelector('#lens').hidden")
    page.choose("#panel", "")
    page.until("!document.querySelector('#device').textContent.includes('Reconstruction')")
    view.grown()


def png_size(data):
    check(data[:8] == b"\x89PNG\r\n\x1a\n", "no PNG")
    return struct.unpack(">II", data[16:24])


def renders_a_region(view):
    page = view.page
    page.click("#region")
    x, y = page.centre("#stage")
    page.drag((x - 100, y - 60), (x + 50, y + 40))
    page.until("document.querySelector('#region').textContent === 'Whole' && !document.querySelector('#bounds').hidden")
    view.grown()
    name, data = page.download(lambda: page.key("s"))
    size = png_size(data)
    check(0 < size[0] < width and 0 < size[1] < height, f"a region of {size}")
    check(f"--crop=" in view.text("#command"), "the command does not crop")
    page.key("Escape")
    page.until("document.querySelector('#region').textContent === 'Region'")
    view.grown()


def saves(view):
    page = view.page
    name, data = page.download(lambda: page.click("#save-png"))
    check(name == "a_scene.png" and png_size(data) == (width, height), f"saved {name} of {png_size(data)}")
    name, data = page.download(lambda: page.click("#save-exr"))
    check(data[:4] == b"v/1\x01", "no EXR")
    name, data = page.download(lambda: page.click("#save-film"))
    film = os.path.join(folder, name)
    with open(film, "wb") as file:
        file.write(data)
    told = subprocess.run([triad, "info", film], capture_output=True, text=True, check=False)
    check(told.returncode == 0 and f"{width} x {height}" in told.stdout.replace("x", " x ").replace("  ", " "), told.stdout + told.stderr)
    command = shlex.split(view.text("#command"))
    check(command[:2] == ["triad", "render"], command)
    done = subprocess.run([triad, *command[1:], "--spp", "1", "-o", os.path.join(folder, "again.png")], capture_output=True, text=True, check=False)
    check(done.returncode == 0, f"the command to copy fails: {command}: {done.stderr}")


def stops_and_explains(view):
    page = view.page
    page.key(" ")
    page.until("document.querySelector('#pause').textContent === 'Go on' && document.querySelector('#status').textContent === 'Paused'")
    page.click("#pause")
    page.until("document.querySelector('#pause').textContent === 'Pause'")
    page.key("?")
    page.until("document.querySelector('#keys').open")
    page.key("Escape")
    page.until("!document.querySelector('#keys').open")
    check(page.js("document.querySelector('#kernels').rows.length") > 0, "no kernel has a time")
    page.until("document.querySelector('#error-words').textContent.startsWith('relMSE')")


def fits_a_phone(url):
    with Chromium(420, 800, "dark", mobile=True) as page:
        view = View(page, url)
        check(page.js("document.documentElement.scrollWidth") <= 420, "the page is wider than a phone")
        check(page.js("[...document.querySelectorAll('aside button, aside select, aside a')].every((e) => {"
                      "const b = e.getBoundingClientRect(); return b.width === 0 || b.right <= 420; })"), "a control is cut")
        x, y = page.centre("#stage")

        def swipe():
            page.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y}])
            page.call("Input.dispatchTouchEvent", type="touchMove", touchPoints=[{"x": x + 80, "y": y}])
            page.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])

        view.after(swipe)
        check("--look-at=" in view.text("#command"), "a finger does not move the eye")
        check(said(page) == [], page.log)


def main():
    program = subprocess.Popen([triad, "view", "--no-browser", "--size", f"{width}x{height}", scene()], stdout=subprocess.PIPE, text=True)
    try:
        url = program.stdout.readline().strip()
        with Chromium() as page:
            view = View(page, url)
            check(view.text("#scene") == "a scene.gltf", view.text("#scene"))
            for act in (leads_the_camera, changes_tones, changes_the_variant, magnifies_emitters, renders_a_region, saves, stops_and_explains):
                print(act.__name__, flush=True)
                act(view)
            check(said(page) == [], page.log)
        print("fits_a_phone", flush=True)
        fits_a_phone(url)
    finally:
        program.send_signal(signal.SIGINT)
        end = program.wait()
    check(end == 0, f"Ctrl-C ends the view with {end}")


if __name__ == "__main__":
    main()
