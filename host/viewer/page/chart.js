// The error of the picture against the time that it took, both logarithmic.

const decade = (x) => 10 ** x;

/// points: [seconds, samples, relMSE], by rising seconds.
export function drawChart(canvas, points) {
  const style = getComputedStyle(canvas), ratio = devicePixelRatio || 1;
  const width = canvas.clientWidth, height = canvas.clientHeight;
  if (width === 0) return;
  canvas.width = Math.round(width * ratio), canvas.height = Math.round(height * ratio);
  const c = canvas.getContext("2d");
  c.scale(ratio, ratio);
  c.font = `11px ${style.fontFamily}`;
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const shown = points.filter(([seconds, , relmse]) => seconds > 0 && relmse > 0);
  if (shown.length === 0) return;
  const left = 40, bottom = 18, right = 6, top = 6;
  const xs = shown.map((p) => Math.log10(p[0])), ys = shown.map((p) => Math.log10(p[2]));
  const range = (v) => {
    const low = Math.min(...v), high = Math.max(...v), room = Math.max(0, 1 - (high - low)) / 2;
    return [low - room - 0.05, high + room + 0.05];
  };
  const [x0, x1] = range(xs), [y0, y1] = range(ys);
  const px = (x) => left + (x - x0) / (x1 - x0) * (width - left - right);
  const py = (y) => height - bottom - (y - y0) / (y1 - y0) * (height - top - bottom);
  c.strokeStyle = colour("--line"), c.fillStyle = colour("--soft"), c.lineWidth = 1;
  const ticks = (low, high) => {
    const whole = [], between = [];
    for (let d = Math.floor(low); d <= Math.ceil(high); ++d)
      for (const [m, list] of [[1, whole], [2, between], [5, between]]) {
        const v = d + Math.log10(m);
        if (v >= low && v <= high) list.push(v);
      }
    return whole.length >= 2 ? whole : [...whole, ...between].sort((a, b) => a - b);
  };
  const label = (v) => {
    const n = decade(v);
    return n >= 0.01 && n < 10000 ? String(Number(n.toPrecision(1))) : n.toExponential(0).replace("e+", "e");
  };
  c.textBaseline = "middle", c.textAlign = "right";
  for (const y of ticks(y0, y1)) {
    line(c, [[left, py(y)], [width - right, py(y)]]);
    c.fillText(label(y), left - 5, py(y));
  }
  c.textBaseline = "top", c.textAlign = "center";
  for (const x of ticks(x0, x1)) {
    line(c, [[px(x), top], [px(x), height - bottom]]);
    c.fillText(`${label(x)} s`, Math.min(px(x), width - 14), height - bottom + 4);
  }
  c.strokeStyle = c.fillStyle = colour("--accent"), c.lineWidth = 1.75, c.lineJoin = "round";
  line(c, shown.map((_, i) => [px(xs[i]), py(ys[i])]));
  c.beginPath();
  c.arc(px(xs.at(-1)), py(ys.at(-1)), 2.5, 0, 2 * Math.PI);
  c.fill();
}

function line(c, places) {
  c.beginPath();
  for (const [x, y] of places) c.lineTo(x, y);
  c.stroke();
}
