// State: what the page shows; it is in the address after '#', so that a view can be linked to.

const FACTS = JSON.parse(document.getElementById("facts").textContent);
const TREES = FACTS.trees;
const MODES = ["beside", "over", "all"], SURFACES = ["full", "clay", "wire"];
const SHOWN = ["tree", "outline", "difference", "classes", "wipe"], SIDES = ["facts", "parameters", "preset"];
const TILT = 0.06;  // radians that the front view looks down
const FRONT = { yaw: 0, pitch: TILT, zoom: 1, panX: 0, panY: 0 };
const state = Object.assign({
  tree: 0, mode: "beside", surface: "full", level: 0, show: "tree", overlay: 0.7, side: "facts", spin: false, wind: false,
}, FRONT);

function byId(id) { return document.getElementById(id); }
function clip(x, low, high) { return Math.min(Math.max(x, low), high); }

function made(kind, into, text) {  // text is only ever text
  const element = document.createElement(kind);
  if (text !== undefined) { element.textContent = text; }
  if (into) { into.appendChild(element); }
  return element;
}

function readAddress() {
  const given = new URLSearchParams(location.hash.slice(1));
  const word = function (name, words) { const found = given.get(name); if (words.includes(found)) { state[name] = found; } };
  const number = function (name, low, high) {
    const found = given.has(name) ? Number(given.get(name)) : NaN;
    if (isFinite(found)) { state[name] = clip(found, low, high); }
  };
  word("mode", MODES); word("surface", SURFACES); word("show", SHOWN); word("side", SIDES);
  if (given.has("overlay") && !given.has("mode")) { state.mode = "over"; }
  if (given.has("wire")) { state.surface = given.get("wire") === "0" ? "full" : "wire"; }
  number("overlay", 0, 1); number("zoom", 0.2, 40); number("panX", -1e4, 1e4); number("panY", -1e4, 1e4);
  if (given.has("lod")) { state.level = clip(Math.round(Number(given.get("lod"))) || 0, 0, 99); }
  if (given.has("tree")) { state.tree = clip(Math.round(Number(given.get("tree"))) - 1 || 0, 0, TREES.length - 1); }
  if (given.has("yaw")) { state.yaw = (Number(given.get("yaw")) || 0) * Math.PI / 180; }
  if (given.has("pitch")) { state.pitch = clip((Number(given.get("pitch")) || 0) * Math.PI / 180, -0.1, 1.5); }
  state.spin = given.get("turn") === "1" || (state.spin && !given.has("turn"));
  state.wind = given.get("wind") === "1" || (state.wind && !given.has("wind"));
}

let writing = 0;
function writeAddress() {
  clearTimeout(writing);
  writing = setTimeout(function () {
    const now = new URLSearchParams({ tree: state.tree + 1, mode: state.mode });
    if (state.level) { now.set("lod", state.level); }
    if (state.surface !== "full") { now.set("surface", state.surface); }
    if (state.mode === "over") { now.set("show", state.show); now.set("overlay", state.overlay); }
    if (state.side !== "facts") { now.set("side", state.side); }
    if (state.yaw) { now.set("yaw", Math.round(state.yaw * 180 / Math.PI)); }
    if (state.pitch !== TILT) { now.set("pitch", Math.round(state.pitch * 180 / Math.PI)); }
    try { history.replaceState(null, "", "#" + now); } catch (error) { /* not in a sandboxed frame */ }
  }, 300);
}
