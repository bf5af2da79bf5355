"""Chromium without a window, driven over its pipe (Chrome DevTools Protocol), with nothing but Python."""
import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

KEYS = {  # key: (code, virtual key, text)
    "ArrowLeft": ("ArrowLeft", 37, ""), "ArrowRight": ("ArrowRight", 39, ""), "ArrowUp": ("ArrowUp", 38, ""),
    "ArrowDown": ("ArrowDown", 40, ""), "Home": ("Home", 36, ""), "Escape": ("Escape", 27, ""), " ": ("Space", 32, " "),
    "Tab": ("Tab", 9, ""),
}


def find_chromium():
    """Path of a Chromium, or None."""
    for name in ("chromium-headless-shell", "chromium", "chromium-browser"):
        if shutil.which(name):
            return shutil.which(name)
    return None


class Chromium:
    """One page in a browser of its own; a context manager."""

    def __init__(self, width=1280, height=900, scheme="light", mobile=False):
        self.folder = tempfile.mkdtemp(prefix="triad-view-")
        to_browser, from_me = os.pipe()
        from_browser, to_me = os.pipe()

        def ends():  # Chromium reads commands at 3 and writes answers to 4
            os.dup2(to_browser, 10), os.dup2(to_me, 11)
            os.dup2(10, 3), os.dup2(11, 4)
            os.set_inheritable(3, True), os.set_inheritable(4, True)

        self.process = subprocess.Popen(
            [find_chromium(), "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--disable-dev-shm-usage",
             "--remote-debugging-pipe", f"--user-data-dir={self.folder}/profile", f"--window-size={width},{height}", "about:blank"],
            preexec_fn=ends, close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser), os.close(to_me)
        self.write, self.read, self.rest = from_me, from_browser, b""
        self.count, self.session, self.log, self.downloads = 0, None, [], {}
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")
        self.size(width, height, mobile)
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        session, self.session = self.session, None
        self.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=self.folder, eventsEnabled=True)
        self.session = session

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()
        os.close(self.write), os.close(self.read)
        shutil.rmtree(self.folder, ignore_errors=True)

    def size(self, width, height, mobile=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=mobile)
        if mobile:
            self.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)

    def _receive(self, seconds):
        """The next message, or None."""
        end = time.monotonic() + seconds
        while b"\0" not in self.rest:
            if not select.select([self.read], [], [], max(0, end - time.monotonic()))[0]:
                return None
            piece = os.read(self.read, 1 << 20)
            if not piece:
                raise RuntimeError("Chromium ended")
            self.rest += piece
        text, self.rest = self.rest.split(b"\0", 1)
        message = json.loads(text)
        method, p = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            self.log.append(json.dumps(p["exceptionDetails"])[:2000])
        elif method == "Log.entryAdded" and p["entry"]["level"] in ("error", "warning"):
            self.log.append(p["entry"]["text"] + " " + p["entry"].get("url", ""))
        elif method == "Runtime.consoleAPICalled":
            self.log.append(json.dumps(p["args"])[:2000])
        elif method == "Browser.downloadWillBegin":
            self.downloads[p["guid"]] = {"name": p["suggestedFilename"], "state": "begun"}
        elif method == "Browser.downloadProgress" and p["guid"] in self.downloads:
            self.downloads[p["guid"]]["state"] = p["state"]
        return message

    def call(self, method, **params):
        self.count += 1
        message = {"id": self.count, "method": method, "params": params}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.write, json.dumps(message).encode() + b"\0")
        end = time.monotonic() + 120
        while time.monotonic() < end:
            answer = self._receive(1)
            if answer and answer.get("id") == self.count:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
        raise TimeoutError(method)

    def open(self, url):
        self.call("Page.navigate", url=url)
        self.until("document.readyState === 'complete'")

    def js(self, expression):
        """The value of an expression, awaited."""
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(json.dumps(result["exceptionDetails"])[:2000])
        return result["result"].get("value")

    def until(self, expression, seconds=240):
        """Waits until an expression is true; its value."""
        end = time.monotonic() + seconds
        while True:
            value = self.js(expression)
            if value:
                return value
            if time.monotonic() > end:
                raise TimeoutError(f"{expression} after {seconds} s; the page said {self.log}")
            self._receive(0.05)

    def wait(self, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self._receive(end - time.monotonic())

    def mouse(self, kind, x, y, button="none", buttons=0, shift=False, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button, buttons=buttons, modifiers=8 if shift else 0,
                  clickCount=1 if kind != "mouseMoved" else 0, **more)

    def centre(self, selector):
        """Of an element that is scrolled into view."""
        return self.js(f"(() => {{ const e = document.querySelector({json.dumps(selector)}); e.scrollIntoView({{block: 'nearest'}});"
                       "const b = e.getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2]; })()")

    def click(self, selector):
        x, y = self.centre(selector)
        self.mouse("mouseMoved", x, y)
        self.mouse("mousePressed", x, y, "left", 1)
        self.mouse("mouseReleased", x, y, "left")

    def drag(self, start, end, steps=8, shift=False, pause=0.0):
        self.mouse("mouseMoved", *start)
        self.mouse("mousePressed", *start, "left", 1, shift)
        for i in range(1, steps + 1):
            self.mouse("mouseMoved", *(a + (b - a) * i / steps for a, b in zip(start, end)), "left", 1, shift)
            if pause:
                self.wait(pause)
        self.mouse("mouseReleased", *end, "left", 0, shift)

    def wheel(self, x, y, delta):
        self.mouse("mouseWheel", x, y, deltaX=0, deltaY=delta)

    def key(self, key, shift=False, alt=False):
        code, number, text = KEYS.get(key, ("Key" + key.upper() if key.isalpha() else "", ord(key.upper()[0]), key))
        modifiers = 8 * shift + alt
        self.call("Input.dispatchKeyEvent", type="keyDown" if text and not alt else "rawKeyDown", key=key, code=code, text=text,
                  windowsVirtualKeyCode=number, modifiers=modifiers)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=key, code=code, windowsVirtualKeyCode=number, modifiers=modifiers)

    def choose(self, selector, value):
        """As a person does by the keyboard: the option's place in the list, then the event."""
        self.js(f"(() => {{ const s = document.querySelector({json.dumps(selector)}); s.focus(); s.value = {json.dumps(value)};"
                "s.dispatchEvent(new Event('input', {bubbles: true})); s.dispatchEvent(new Event('change', {bubbles: true})); })()")

    def download(self, act, seconds=120):
        """What act() makes the page save: name and bytes."""
        self.downloads.clear()
        act()
        end = time.monotonic() + seconds
        while not any(d["state"] == "completed" for d in self.downloads.values()):
            if time.monotonic() > end or any(d["state"] == "canceled" for d in self.downloads.values()):
                raise TimeoutError(f"no download: {self.downloads}, {self.log}")
            self._receive(0.1)
        name = next(d["name"] for d in self.downloads.values() if d["state"] == "completed")
        with open(os.path.join(self.folder, name), "rb") as file:
            return name, file.read()

    def screenshot(self, path):
        data = self.call("Page.captureScreenshot", format="png")["data"]
        with open(path, "wb") as file:
            file.write(base64.b64decode(data))
