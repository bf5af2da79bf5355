// Everything by the keyboard.

const step = Math.PI / 36;
const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

function onArrow(actions, event, [x, y]) {
  if (event.altKey) actions.shift(x, -y);
  else if (event.shiftKey) actions.pan(-0.05 * x, -0.05 * y);
  else actions.orbit(step * x, step * y);
}

const byKey = {
  "+": (a) => a.zoom(1 / 1.15), "=": (a) => a.zoom(1 / 1.15), "-": (a) => a.zoom(1.15),
  Home: (a) => a.reset(), 0: (a) => a.reset(), " ": (a) => a.pause(), Escape: (a) => a.whole(),
  "[": (a) => a.exposure(-0.25), "]": (a) => a.exposure(0.25),
  c: (a) => a.camera(), v: (a) => a.variant(), t: (a) => a.tonemap(), p: (a) => a.panel(), x: (a) => a.subpixels(),
  m: (a) => a.magnifier(), r: (a) => a.region(), s: (a) => a.save("png"), e: (a) => a.save("exr"), f: (a) => a.save("film"),
  y: (a) => a.copy(), "?": (a) => a.help(),
};

/// What a control does with keys of its own stays with it.
function isTaken(event) {
  const tag = event.target.tagName;
  if (event.ctrlKey || event.metaKey || (event.altKey && !arrows[event.key])) return true;
  if (document.querySelector("dialog[open]")) return event.key !== "?";
  if (tag === "SELECT") return event.key in arrows || event.key === "Home" || event.key === " ";
  if (tag === "INPUT" && event.target.type === "range") return event.key in arrows || event.key === "Home";
  return event.key === " " && ["BUTTON", "INPUT"].includes(tag);
}

export function listenToKeys(actions, isReady) {
  // What was clicked by a pointer does not keep the keys.
  document.addEventListener("click", (event) => {
    if (event.detail > 0) event.target.closest("button, a, input")?.blur();
  });
  document.addEventListener("keydown", (event) => {
    if (!isReady() || isTaken(event)) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (arrows[key]) onArrow(actions, event, arrows[key]);
    else if (Object.hasOwn(byKey, key)) byKey[key](actions);
    else return;
    event.preventDefault();
  });
}
