// A lens that shows the emitters of the pixels under the pointer.
import { pixels } from "./link.js";

export class Magnifier {
  constructor(canvas, spot) {
    this.canvas = canvas;
    this.spot = spot; // marks what it shows
    this.on = false;
    this.zoom = 24;
    this.fetching = this.again = false;
  }

  turn(on, picture) {
    this.on = on;
    this.picture = picture;
    this.canvas.hidden = this.spot.hidden = !on;
    if (!on) return;
    if (!this.centre) this.centre = [picture.canvas.width / 2, picture.canvas.height / 2];
    this.look();
  }

  shift(x, y) {
    if (this.on) this.look([this.centre[0] + x, this.centre[1] + y]);
  }

  /// At these pixels, or again where it is.
  async look(centre = this.centre) {
    if (!this.on || !centre) return;
    const { width, height } = this.picture.canvas;
    this.centre = [Math.max(0, Math.min(width - 1, centre[0])), Math.max(0, Math.min(height - 1, centre[1]))];
    if (this.fetching) {
      this.again = true;
      return;
    }
    this.fetching = true;
    do {
      this.again = false;
      await this.fetch();
    } while (this.again && this.on);
    this.fetching = false;
  }

  async fetch() {
    const [x, y] = this.centre.map(Math.floor);
    const across = Math.max(5, Math.round(264 / this.zoom));
    try {
      const lens = await pixels(`magnifier?x=${x}&y=${y}&across=${across}&zoom=${this.zoom}`);
      if (!lens) return;
      this.canvas.width = lens.image.width, this.canvas.height = lens.image.height;
      this.canvas.getContext("2d").putImageData(lens.image, 0, 0);
      this.shown = [lens.x, lens.y, lens.width, lens.height];
      this.place(this.picture);
    } catch { /* the server ended: its events say so */ }
  }

  place(picture) {
    if (!this.on || !this.shown) return;
    picture.frame(this.spot, this.shown);
    // Never over what it shows.
    const [x, y] = this.centre;
    const isThere = x > 0.5 * picture.canvas.width && y < 0.6 * picture.canvas.height;
    this.canvas.classList.toggle("left", isThere);
  }
}
