// Controls: buttons, keys and thumbnails change the state; `refresh` shows it.

function choices(id, name, change) {
  byId(id).addEventListener("click", function (event) {
    const button = event.target.closest("button");
    if (button) { state[name] = typeof state[name] === "number" ? Number(button.value) : button.value; change(); }
  });
}

function pressed(id, value) {
  Array.from(byId(id).children).forEach(function (button) { button.setAttribute("aria-pressed", String(button.value === String(value))); });
}

function next(words, now) { return words[(words.indexOf(now) + 1) % words.length]; }

function filmStrip() {
  TREES.forEach(function (tree, i) {
    const button = made("button", byId("film"));
    button.setAttribute("role", "tab");
    button.title = tree.name;
    if (tree.picture) { const thumb = made("img", button); thumb.alt = ""; thumb.src = tree.picture; }
    const words = made("span", button);
    made("b", words, tree.name);
    made("small", words, tree.note);
    if (TREES.length > 1 && i < 9) { made("kbd", words, String(i + 1)); }
    button.addEventListener("click", function () { state.tree = i; refresh(); });
  });
}

function refresh() {  // everything but the drawing follows the state at once; trees when they are loaded
  const tree = TREES[state.tree], aside = document.querySelector("aside");
  document.body.dataset.mode = state.mode;
  ["mode", "surface", "show", "side"].forEach(function (name) { pressed(name, state[name]); });
  byId("spin").setAttribute("aria-pressed", String(state.spin));
  byId("wind").setAttribute("aria-pressed", String(state.wind && tree.windy !== false));
  byId("wind").disabled = tree.windy === false;
  byId("overlay").value = state.overlay;
  Array.from(byId("film").children).forEach(function (tab, i) { tab.setAttribute("aria-selected", String(i === state.tree)); });
  byId("name").textContent = tree.name;
  byId("note").textContent = tree.note;
  byId("side").querySelector("[value=parameters]").hidden = !FACTS.parameters.length;
  byId("side").querySelector("[value=preset]").hidden = !tree.preset;
  aside.className = state.side === "parameters" || (state.mode === "all" && TREES.length > 2) ? "wide" : "";
  filesOf(tree);
  levelButtons(tree);
  sidePanel(tree);
  photo.style.filter = "";
  arrange();
  writeAddress();
  wanted();
  draw();
}

function sidePanel(tree) {
  const panel = byId("panel");
  panel.textContent = "";
  if (state.side === "parameters") { parameterPanel(panel); return; }
  if (state.side === "preset") { made("pre", panel, tree.preset); return; }
  factTables().forEach(function (table) { panel.appendChild(tabulate(table)); });
  const levels = levelTable();
  if (levels.rows.length > 1) { panel.appendChild(tabulate(levels)); }
}

function levelButtons(tree) {
  const box = byId("levels"), n = tree.nodes ? tree.nodes.length : tree.levels.length;
  box.textContent = "";
  for (let k = 0; k < n && n > 1; k++) {
    const button = made("button", box, "LOD " + k), known = tree.levels[k] || {};
    button.value = String(k);
    const triangles = tree.counts ? tree.counts[k] : known.triangles;
    button.title = [triangles.toLocaleString("en") + " triangles", typeof known.iou === "number" && "silhouette IoU " + known.iou.toFixed(3)].filter(Boolean).join(", ");
  }
  pressed("levels", Math.min(state.level, Math.max(n - 1, 0)));
}

function wanted() {  // load the trees that are to be seen
  if (renderer === null) { return; }
  cells.forEach(function (cell) {
    if (cell.tree === null) { return; }
    const tree = TREES[cell.tree], known = Boolean(tree.nodes);
    load(cell.tree).then(function () {
      dress(tree);
      if (!known && cell.tree === state.tree) { levelButtons(tree); byId("wind").disabled = !tree.windy; if (state.side === "facts") { sidePanel(tree); } }
      draw();
    }, function (error) { byId("hint").textContent = "This tree cannot be shown: " + (error && error.message || error); });
  });
}

function legend(counts) {
  const box = byId("legend"), parts = [];
  box.textContent = "";
  if (state.show === "classes") { parts.push([BRANCHES, "branches"], [LEAVES, "leaves"]); }
  if (state.show === "difference" && counts) {
    const either = Math.max(counts.both + counts.picture + counts.tree, 1), share = function (n) { return " " + (100 * n / either).toFixed(0) + " %"; };
    parts.push([BOTH, "both" + share(counts.both)], [PICTURE_ONLY, "picture only" + share(counts.picture)], [TREE_ONLY, "tree only" + share(counts.tree)]);
  }
  if (state.show === "outline") { parts.push([PICTURE_ONLY, "picture"], [TREE_ONLY, "tree"]); }
  parts.forEach(function (part) {
    const word = made("span", box);
    made("i", word).style.background = "rgb(" + part[0] + ")";
    word.append(part[1]);
  });
}
