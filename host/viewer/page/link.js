// To the server and back.

const waiting = {}; // changes that are not sent yet
let sending = false;
let tell = () => {};

/// tell(sentence, isLost): "" when all is well again.
export function whenItFails(listener) { tell = listener; }

/// Moves that come while one is under way are added up.
export function change(wanted) {
  for (const [name, value] of Object.entries(wanted)) {
    if (waiting[name] !== undefined && (name === "orbit" || name === "pan"))
      waiting[name] = waiting[name].map((v, i) => v + value[i]);
    else if (waiting[name] !== undefined && name === "zoom") waiting[name] *= value;
    else waiting[name] = value;
  }
  if (!sending) send();
}

async function send() {
  sending = true;
  while (Object.keys(waiting).length > 0) {
    const body = JSON.stringify(waiting);
    for (const name of Object.keys(waiting)) delete waiting[name];
    try {
      const reply = await fetch("change", { method: "POST", headers: { "Content-Type": "application/json" }, body });
      tell(reply.ok ? "" : await reply.text(), false);
    } catch {
      tell("The view does not answer: triad may have ended.", true);
    }
  }
  sending = false;
}

/// Calls show(state) for every state that the server tells.
export function follow(show) {
  const events = new EventSource("events");
  events.onmessage = (event) => show(JSON.parse(event.data));
  events.onopen = () => tell("", false);
  events.onerror = () => tell("The view does not answer: triad may have ended.", true);
}

/// RGBA pixels as { number, full, x, y, width, height, partial, image }; null where there are none.
export async function pixels(path) {
  const reply = await fetch(path);
  if (reply.status !== 200) return null;
  const [number, fullWidth, fullHeight, x, y, width, height, columns, rows, partial] =
    reply.headers.get("X-Triad-Frame").split(" ").map(Number);
  const image = new ImageData(new Uint8ClampedArray(await reply.arrayBuffer()), columns, rows);
  return { number, full: [fullWidth, fullHeight], x, y, width, height, partial: partial > 0, image };
}
