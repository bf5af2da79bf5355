// The page of `triad view`: glue between its controls, its picture and the server.
import { change, follow, whenItFails } from "./link.js";
import { Picture } from "./picture.js";
import { Magnifier } from "./magnifier.js";
import { drawChart } from "./chart.js";
import { listenToKeys } from "./keys.js";

const $ = (id) => document.getElementById(id);
const words = {
  device: "Opening the device", load: "Loading the scene", build: "Building trees", compile: "Compiling kernels",
  design: "Designing taps", render: "Rendering", paused: "Paused", done: "Done",
};
const waits = ["device", "load", "build", "compile", "design"];

let state = null; // the latest, as the server told it
const magnifier = new Magnifier($("lens"), $("spot"));
const picture = new Picture($("stage"), { change, magnifier, whenChosen: showRegion });

function say(sentence) {
  $("message").textContent = sentence;
  $("message").hidden = sentence === "";
}

/// Options as [value, words]; left alone while someone chooses.
function fill(select, options, value) {
  const text = JSON.stringify(options);
  if (select.dataset.options !== text) {
    select.dataset.options = text;
    select.replaceChildren(...options.map(([v, label]) => new Option(label, v)));
  }
  select.value = String(value);
}

function time(seconds) {
  return seconds >= 1 ? `${seconds.toFixed(1)} s` : `${(1000 * seconds).toFixed(seconds < 0.01 ? 1 : 0)} ms`;
}

function short(x) {
  return x >= 0.001 ? String(Number(x.toPrecision(2))) : x.toExponential(1);
}

function showRegion() {
  const has = state !== null && state.region[2] > 0;
  $("region").setAttribute("aria-pressed", String(has || picture.choosing));
  $("region").textContent = has ? "Whole" : picture.choosing ? "Drag one" : "Region";
}

function showNumbers() {
  const { seconds, samples, relmse, points } = state.course;
  const spp = samples >= 10 ? Math.round(samples) : Number(samples.toFixed(1));
  const known = relmse !== null;
  $("numbers").textContent =
    samples > 0 ? `${spp} spp · ${seconds.toFixed(1)} s${known ? ` · relMSE ${short(relmse)}` : ""}` : "";
  $("error-words").textContent =
    known ? `relMSE ${short(relmse)}, estimated from two halves of the samples` : "No estimate yet";
  drawChart($("chart"), points);
}

function showKernels() {
  const all = state.kernels.reduce((sum, [, , seconds]) => sum + seconds, 0) || 1;
  $("kernels").tBodies[0].replaceChildren(...state.kernels.map(([name, launches, seconds]) => {
    const row = document.createElement("tr");
    for (const text of [name, time(seconds), `${Math.round(100 * seconds / all)} %`]) row.insertCell().textContent = text;
    row.title = `${name}: ${launches} times`;
    return row;
  }));
}

/// A wait is shown only when it is one: most pass within a frame.
let waitTimer = 0;
function showPhase() {
  const isWaiting = waits.includes(state.phase);
  const coarse = state.divisor > 1 ? `, 1/${state.divisor} of the size` : "";
  $("status").textContent = (words[state.phase] || state.phase) + (state.phase === "render" ? coarse : "");
  clearTimeout(waitTimer);
  if (!isWaiting) $("busy").hidden = true;
  else waitTimer = setTimeout(() => { $("busy").textContent = words[state.phase]; $("busy").hidden = false; }, 300);
}

function showFacts() {
  const facts = [state.device, state.integrator];
  if (state.method || state.panel) facts.push(`Reconstruction: ${state.method || "whole pixels"}`);
  if (state.move_s !== null) facts.push(`First picture of the last move after ${time(state.move_s)}`);
  facts.push(`Trees built ${state.packings === 1 ? "once" : `${state.packings} times`}`);
  $("device").textContent = facts.filter((text) => text).join(". ") + ".";
}

function showChoices() {
  const cameras = [[-1, "As it began"], ...state.cameras.map((name, i) => [i, name || `Camera ${i}`])];
  fill($("camera"), state.moved ? [...cameras, ["", "Led by hand"]] : cameras, state.moved ? "" : state.camera);
  fill($("variant"), [["", "The file's own"], ...state.variants.map((name) => [name, name])], state.variant);
  fill($("panel"), [["", "None"], ...state.panels.map((name) => [name, name])], state.panel);
  $("variants").hidden = state.variants.length === 0;
  $("subpixels").checked = state.subpixels;
  $("subpixels").disabled = state.panel === "";
  $("tonemap").value = state.tonemap;
  $("scale").value = String(state.scale);
  if (state.exposure === exposure) exposure = null;
  if (exposure === null) showExposure(state.exposure);
  $("pause").textContent = state.paused ? "Go on" : "Pause";
  $("pause").setAttribute("aria-pressed", String(state.paused));
}

function show(next) {
  state = next;
  document.title = `${state.scene} · Triad`;
  $("scene").textContent = $("scene").title = state.scene;
  for (const [id, extension] of [["save-png", "png"], ["save-exr", "exr"], ["save-film", "triadfilm"]]) {
    const name = state.scene.replace(/\.(glb|gltf)$/i, "").replace(/[^\p{L}\p{N}._-]/gu, "_");
    $(id).href = `save/${encodeURIComponent(name)}.${extension}`;
    $(id).download = `${name}.${extension}`;
  }
  $("command").textContent = state.command;
  $("copy").disabled = state.command === "";
  showPhase(), showNumbers(), showKernels(), showFacts(), showChoices(), showRegion();
  if (state.message) say(state.message);
  else if (!failed) say("");
  picture.follow(state);
}

let failed = false;
whenItFails((sentence, isLost) => {
  failed = sentence !== "";
  say(sentence);
  if (isLost) $("status").textContent = "Not connected";
});

let exposure = null; // on its way to the server
function showExposure(value) {
  $("exposure").value = String(value);
  $("exposure-value").textContent = `${value > 0 ? "+" : ""}${value} EV`;
}
function expose(value) {
  exposure = Math.max(-64, Math.min(64, value));
  showExposure(exposure);
  change({ exposure });
}
$("exposure").addEventListener("input", () => expose(Number($("exposure").value)));
for (const id of ["tonemap", "variant", "panel"])
  $(id).addEventListener("change", () => change({ [id]: $(id).value }));
for (const id of ["camera", "scale"])
  $(id).addEventListener("change", () => { if ($(id).value !== "") change({ [id]: Number($(id).value) }); });
$("panel").addEventListener("change", () => magnify($("panel").value !== "" || magnifier.on));
$("subpixels").addEventListener("change", () => change({ subpixels: $("subpixels").checked }));
$("zoom").addEventListener("change", () => { magnifier.zoom = Number($("zoom").value); magnifier.look(); });
$("magnifier").addEventListener("change", () => magnify($("magnifier").checked));

function magnify(on) {
  $("magnifier").checked = on;
  $("stage").classList.toggle("magnifying", on);
  magnifier.turn(on, picture);
}

async function copy() {
  $("command").hidden = false;
  try {
    await navigator.clipboard.writeText(state.command);
    $("copy").textContent = "Copied";
    setTimeout(() => { $("copy").textContent = "Command"; }, 1500);
  } catch {
    getSelection().selectAllChildren($("command")); // for who copies by hand
  }
}

/// The next of a list of options; sent as if it had been chosen.
function next(select) {
  if (select.options.length < 2) return; // nothing to choose
  select.selectedIndex = (select.selectedIndex + 1) % select.options.length;
  select.dispatchEvent(new Event("change"));
}

const actions = {
  pause: () => change({ paused: !state.paused }),
  reset: () => change({ camera: -1 }),
  region: () => (state.region[2] > 0 ? change({ region: [0, 0, 0, 0] }) : picture.choose(!picture.choosing)),
  whole: () => {
    if (picture.choosing) picture.choose(false);
    else if (state.region[2] > 0) change({ region: [0, 0, 0, 0] });
  },
  exposure: (step) => expose((exposure ?? state.exposure) + step),
  camera: () => change({ camera: state.camera + 1 < state.cameras.length ? state.camera + 1 : -1 }),
  variant: () => next($("variant")),
  tonemap: () => next($("tonemap")),
  panel: () => next($("panel")),
  subpixels: () => { if (state.panel) change({ subpixels: !state.subpixels }); },
  magnifier: () => magnify(!magnifier.on),
  shift: (x, y) => magnifier.shift(x, y),
  save: (what) => $(`save-${what}`).click(),
  copy,
  help: () => ($("keys").open ? $("keys").close() : $("keys").showModal()),
  orbit: (x, y) => change({ orbit: [x, y] }),
  pan: (x, y) => change({ pan: [x, y] }),
  zoom: (factor) => change({ zoom: factor }),
};
for (const id of ["pause", "reset", "region", "copy", "help"]) $(id).addEventListener("click", () => actions[id]());
for (const each of document.querySelectorAll("[data-key]")) each.title = each.dataset.key;
listenToKeys(actions, () => state !== null);
follow(show);
