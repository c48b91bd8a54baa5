// Cells: the parts of the stage, one for the picture and one for each tree that is shown.

const stage = byId("stage"), cellsBox = byId("cells"), labels = made("div"), paint = made("canvas");
const photo = new Image();
let cells = [];
labels.className = "labels";
paint.className = "paint";
photo.alt = "the picture";
photo.onload = function () { draw(); };
photo.src = PHOTO.picture;

function arrange() {  // cells by mode: what is in each and where it is
  const w = stage.clientWidth, h = stage.clientHeight;
  const chosen = state.mode === "all" ? TREES.map(function (_, i) { return i; }) : [state.tree];
  const parts = state.mode === "over" ? [{ photo: true, tree: state.tree }]
    : [{ photo: true, tree: null }].concat(chosen.map(function (i) { return { photo: false, tree: i }; }));
  const columns = bestColumns(parts.length, w, h), rows = Math.ceil(parts.length / columns);
  cells = parts.map(function (part, k) {
    const x = Math.round(w * (k % columns) / columns), y = Math.round(h * Math.floor(k / columns) / rows);
    const right = Math.round(w * (k % columns + 1) / columns), low = Math.round(h * (Math.floor(k / columns) + 1) / rows);
    return Object.assign(part, { x: x, y: y, w: right - x, h: low - y });
  });
  cellsBox.textContent = labels.textContent = "";
  cells.forEach(build);
}

function bestColumns(n, w, h) {  // so that the trees are as large as can be
  const reach = 2.15 * Math.max(PHOTO.reach, ...TREES.map(function (tree) { return tree.reach; }), 0.2);
  let best = 1, largest = 0;
  for (let columns = 1; columns <= n; columns++) {
    const size = Math.min(h / Math.ceil(n / columns) * 0.85, w / columns / reach);
    if (size > largest * 1.02) { best = columns; largest = size; }
  }
  return best;
}

function build(cell) {
  const box = made("div", cellsBox);
  box.className = "cell";
  Object.assign(box.style, { left: cell.x + "px", top: cell.y + "px", width: cell.w + "px", height: cell.h + "px" });
  if (cell.photo) { box.appendChild(photo); }
  if (cell.tree !== null && renderer === null && state.mode !== "over" && TREES[cell.tree].picture) {
    const flat = made("img", box);
    flat.className = "alone";
    flat.alt = "";
    flat.src = TREES[cell.tree].picture;
  }
  const words = state.mode === "over" ? "picture and " + TREES[cell.tree].name : cell.photo ? "picture" : TREES[cell.tree].name;
  const label = made("span", labels, words);
  label.className = state.mode === "all" && cell.tree === state.tree ? "here" : "";
  Object.assign(label.style, { left: cell.x + 10 + "px", top: cell.y + 10 + "px", maxWidth: cell.w - 20 + "px" });
}

function placePhoto(cell) {
  const at = placing(cell.w, cell.h), high = at.tall / (PHOTO.bottom - PHOTO.top), wide = high * PHOTO.ratio;
  Object.assign(photo.style, { width: wide + "px", height: high + "px",
    transform: "translate(" + (at.x - PHOTO.base * wide) + "px," + (at.y - PHOTO.bottom * high) + "px)" });
}

function drawCells(moving) {
  const w = stage.clientWidth, h = stage.clientHeight;
  if (!w || !h) { return; }
  if (!cells.length || w !== arrange.w || h !== arrange.h) { arrange(); arrange.w = w; arrange.h = h; }
  if (renderer !== null) {
    const size = renderer.getSize(new THREE.Vector2());
    if (size.x !== w || size.y !== h) { renderer.setSize(w, h); }
    renderer.setScissor(0, 0, w, h);
    renderer.setClearColor(0, 0);
    renderer.clear();
  }
  cells.forEach(function (cell) {
    if (cell.photo) { placePhoto(cell); }
    const tree = cell.tree === null ? null : TREES[cell.tree];
    if (state.mode === "over") { drawOver(tree, cell); return; }
    if (tree === null || renderer === null || !tree.nodes) { return; }
    tree.stale = tree.stale || moving;
    paintTree(tree, cell, {});
  });
  if (state.mode !== "over") { paint.hidden = true; if (renderer) { renderer.domElement.style.opacity = 1; } }
  tell();
}

function wipeRange(cell) {  // the part of a cell that the picture fills, left to right
  const at = placing(cell.w, cell.h), wide = at.tall / (PHOTO.bottom - PHOTO.top) * PHOTO.ratio, left = at.x - PHOTO.base * wide;
  return { left: clip(left, 0, cell.w), right: clip(left + wide, 0, cell.w) };
}

function drawOver(tree, cell) {
  const solid = state.show === "tree" || state.show === "wipe", there = renderer !== null && tree.nodes;
  paint.hidden = solid;
  paint.style.opacity = state.overlay;
  photo.style.filter = state.show === "outline" || state.show === "difference" ? "grayscale(1) contrast(.75) brightness(1.1)" : "";
  if (renderer !== null) { renderer.domElement.style.opacity = state.show === "tree" ? state.overlay : solid ? 1 : 0; }
  const wiped = wipeRange(cell), edgeAt = wiped.left + state.overlay * (wiped.right - wiped.left);
  if (solid && there) {
    paintTree(tree, cell, state.show === "tree" ? { flat: true, bare: true } : { from: edgeAt, to: wiped.right });
  }
  if (!solid) { legend(paintOverlay(paint, tree, cell)); } else { legend(null); }
  let edge = labels.querySelector("i");
  if (state.show !== "wipe") { if (edge) { edge.remove(); } return; }
  edge = edge || made("i", labels);
  edge.style.left = cell.x + edgeAt - 1 + "px";
}

function tell() {  // what is drawn, for tests and for those who script the page
  const tree = TREES[state.tree], level = tree.nodes ? Math.min(state.level, tree.nodes.length - 1) : 0;
  document.body.dataset.mode = state.mode;
  document.body.dataset.drawn = cells.filter(function (cell) { return cell.tree !== null && TREES[cell.tree].nodes; }).length;
  document.body.dataset.triangles = tree.counts ? tree.counts[level] : "";
  document.body.dataset.textures = tree.nodes ? texturesOf(tree.nodes[level]) : "";
}

function texturesOf(node) {  // how many there are, with their pixels
  const found = new Set();
  meshesOf(node).forEach(function (mesh) {
    const own = mesh.userData.full;
    [own.map, own.normalMap, own.roughnessMap].forEach(function (map) { if (map && map.image && map.image.width) { found.add(map); } });
  });
  return found.size;
}
