// The picture: frames as they come, and the hands on it.
import { pixels } from "./link.js";

const scratch = document.createElement("canvas"); // pixels on their way to a size

export class Picture {
  /// stage: the element around canvas and rubber band. change(wanted) goes to the server.
  constructor(stage, { change, magnifier, whenChosen }) {
    Object.assign(this, { stage, change, magnifier, whenChosen });
    this.canvas = stage.querySelector("#picture");
    this.rubber = stage.querySelector("#rubber");
    this.bounds = stage.querySelector("#bounds"); // of the region
    this.choosing = false;   // a region
    this.shown = { frame: 0, region: 0 };
    this.wanted = { frame: 0, region: 0 };
    this.fetching = false;
    this.pointers = new Map();
    new ResizeObserver(() => this.fit()).observe(stage);
    stage.addEventListener("pointerdown", (e) => this.down(e));
    stage.addEventListener("pointermove", (e) => this.move(e));
    for (const end of ["pointerup", "pointercancel"]) stage.addEventListener(end, (e) => this.up(e));
    stage.addEventListener("wheel", (e) => this.wheel(e), { passive: false });
    stage.addEventListener("contextmenu", (e) => e.preventDefault());
  }

  /// Fetches what is newer than what is shown, one at a time.
  async follow(state) {
    this.wanted = { frame: state.frame, region: state.region_frame };
    this.region = state.region;
    this.bounds.hidden = state.region[2] === 0;
    this.frame(this.bounds, state.region);
    if (this.fetching) return;
    this.fetching = true;
    try {
      for (const path of ["frame", "region", "frame", "region"])
        while (this.wanted[path] > this.shown[path]) {
          const frame = await pixels(path);
          if (!frame) break;
          // A region lies on a picture that is there.
          if (path === "frame") this.shown.region = 0;
          this.shown[path] = frame.number;
          this.draw(frame);
        }
    } catch { /* the server ended: its events say so */ }
    this.fetching = false;
  }

  draw({ full: [width, height], x, y, width: w, height: h, partial, image }) {
    const { canvas } = this;
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width, canvas.height = height;
      this.fit();
    }
    scratch.width = image.width, scratch.height = image.height;
    scratch.getContext("2d").putImageData(image, 0, 0);
    const context = canvas.getContext("2d");
    context.imageSmoothingQuality = "high";
    if (!partial) context.clearRect(x, y, w, h);
    context.drawImage(scratch, x, y, w, h);
    canvas.dataset.frames = Number(canvas.dataset.frames || 0) + 1;
    canvas.dataset.coarse = String(image.width < w);
    this.magnifier.look();
  }

  /// As large as the stage allows.
  fit() {
    const { clientWidth, clientHeight } = this.stage, { width, height } = this.canvas;
    this.scale = Math.min(clientWidth / width, clientHeight / height);
    this.left = (clientWidth - width * this.scale) / 2;
    this.top = (clientHeight - height * this.scale) / 2;
    this.canvas.style.transform = `translate(${this.left}px, ${this.top}px) scale(${this.scale})`;
    if (this.region) this.frame(this.bounds, this.region);
    this.magnifier.place(this);
  }

  /// Pixel of the picture under a pointer.
  at({ clientX, clientY }) {
    const box = this.stage.getBoundingClientRect();
    return [(clientX - box.left - this.left) / this.scale, (clientY - box.top - this.top) / this.scale];
  }

  choose(on) {
    this.choosing = on;
    this.stage.classList.toggle("choosing", on);
    if (!on) this.rubber.hidden = true;
    this.whenChosen();
  }

  down(event) {
    if (event.target.closest("button, a")) return;
    document.activeElement?.blur(); // keys are the picture's again
    this.stage.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    this.start = this.at(event);
    this.stage.classList.add("moving");
    if (this.magnifier.on && event.pointerType === "touch") this.magnifier.look(this.start);
  }

  move(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) {
      if (this.magnifier.on) this.magnifier.look(this.at(event));
      return;
    }
    const now = [event.clientX, event.clientY];
    const shift = now.map((v, i) => (v - before[i]) / (this.canvas.height * this.scale));
    if (this.choosing) return this.stretch(this.at(event));
    if (this.pointers.size === 2) this.pinch(event.pointerId, now, shift);
    else if (this.pointers.size === 1) {
      if (this.magnifier.on && event.pointerType === "touch") this.magnifier.look(this.at(event));
      else if (event.shiftKey || (event.buttons & 6) > 0) this.change({ pan: [shift[0], -shift[1]] });
      else this.change({ orbit: [-shift[0] * Math.PI, shift[1] * Math.PI] });
    }
    this.pointers.set(event.pointerId, now);
  }

  /// Two fingers: each moves the picture by half of its way, and their distance zooms.
  pinch(id, now, shift) {
    const [other] = [...this.pointers].filter(([key]) => key !== id).map(([, place]) => place);
    const distance = ([x, y]) => Math.max(Math.hypot(x - other[0], y - other[1]), 1);
    this.change({ pan: [shift[0] / 2, -shift[1] / 2], zoom: distance(this.pointers.get(id)) / distance(now) });
  }

  up(event) {
    if (!this.pointers.delete(event.pointerId)) return;
    if (this.pointers.size === 0) this.stage.classList.remove("moving");
    if (!this.choosing) return;
    const [x, y, width, height] = this.rectangle(this.at(event));
    if (width < 2 || height < 2) return; // a click
    this.change({ region: [x, y, width, height] });
    this.choose(false);
  }

  /// From where the pointer went down, in whole pixels of the picture.
  rectangle(end) {
    const low = [0, 1].map((i) => Math.floor(Math.min(this.start[i], end[i])));
    const high = [0, 1].map((i) => Math.ceil(Math.max(this.start[i], end[i])));
    const limit = [this.canvas.width, this.canvas.height];
    const from = low.map((v, i) => Math.max(0, Math.min(v, limit[i])));
    const to = high.map((v, i) => Math.max(0, Math.min(v, limit[i])));
    return [...from, to[0] - from[0], to[1] - from[1]];
  }

  stretch(end) {
    this.rubber.hidden = false;
    this.frame(this.rubber, this.rectangle(end));
  }

  /// Lays an element over these pixels.
  frame(element, [x, y, width, height]) {
    Object.assign(element.style, {
      left: `${this.left + x * this.scale}px`, top: `${this.top + y * this.scale}px`,
      width: `${width * this.scale}px`, height: `${height * this.scale}px`,
    });
  }

  wheel(event) {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1;
    this.change({ zoom: Math.exp(Math.max(-300, Math.min(300, event.deltaY * lines)) * 0.0015) });
  }
}
