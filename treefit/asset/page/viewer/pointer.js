// Pointer: drag to turn, with shift or two fingers to move, wheel or pinch to come closer, wherever on the stage.

function listen(surface) {
  const held = new Map();
  let spread = 0, wiping = false, moved = 0;
  surface.addEventListener("contextmenu", function (event) { event.preventDefault(); });
  surface.addEventListener("pointerdown", function (event) {
    surface.setPointerCapture(event.pointerId);
    held.set(event.pointerId, [event.clientX, event.clientY]);
    spread = moved = 0;
    const range = wipeRange(cells[0]), edge = stage.getBoundingClientRect().left + range.left + state.overlay * (range.right - range.left);
    wiping = state.mode === "over" && state.show === "wipe" && Math.abs(event.clientX - edge) < 16;
  });
  surface.addEventListener("pointermove", function (event) {
    const last = held.get(event.pointerId), dx = last ? event.clientX - last[0] : 0, dy = last ? event.clientY - last[1] : 0;
    if (!last) { return; }
    held.set(event.pointerId, [event.clientX, event.clientY]);
    moved += Math.abs(dx) + Math.abs(dy);
    if (wiping) {
      const range = wipeRange(cells[0]);
      state.overlay = clip(state.overlay + dx / Math.max(range.right - range.left, 1), 0, 1);
      byId("overlay").value = state.overlay;
    } else if (held.size === 2) {
      const two = Array.from(held.values()), now = Math.hypot(two[0][0] - two[1][0], two[0][1] - two[1][1]);
      if (spread > 0 && now > 0) { closer(now / spread, (two[0][0] + two[1][0]) / 2, (two[0][1] + two[1][1]) / 2); }
      spread = now;
      move(dx / 2, dy / 2);
    } else if (event.shiftKey || event.buttons === 4 || event.buttons === 2) { move(dx, dy); } else { turn(dx, dy); }
    draw();
  });
  ["pointerup", "pointercancel"].forEach(function (kind) {
    surface.addEventListener(kind, function (event) {
      held.delete(event.pointerId);
      spread = 0;
      const cell = cellAt(event.clientX, event.clientY);
      if (moved < 4 && state.mode === "all" && cell && cell.tree !== null && cell.tree !== state.tree) { state.tree = cell.tree; refresh(); }
      writeAddress();
    });
  });
  surface.addEventListener("wheel", function (event) {
    event.preventDefault();
    closer(Math.exp(-clip(event.deltaY, -200, 200) * 0.0015), event.clientX, event.clientY);
    draw();
  }, { passive: false });
  surface.addEventListener("dblclick", front);
}

function turn(dx, dy) {
  state.yaw -= dx * 0.008;
  state.pitch = clip(state.pitch + dy * 0.006, -0.05, 1.5);
}

function move(dx, dy) { state.panX += dx; state.panY += dy; }

function closer(by, x, y) {  // what is under the pointer stays under it, in every cell
  const box = stage.getBoundingClientRect(), px = x - box.left, py = y - box.top;
  const cell = cellAt(x, y), zoom = clip(state.zoom * by, 0.2, 40), step = zoom / state.zoom;
  if (!cell) { return; }
  state.panX += (px - cell.x - cell.w / 2 - state.panX) * (1 - step);
  state.panY += (py - cell.y - cell.h / 2 - state.panY) * (1 - step);
  state.zoom = zoom;
}

function cellAt(x, y) {
  const box = stage.getBoundingClientRect(), px = x - box.left, py = y - box.top;
  return cells.find(function (one) { return px >= one.x && px < one.x + one.w && py >= one.y && py < one.y + one.h; });
}

function front() { Object.assign(state, FRONT, { spin: false }); refresh(); }

function key(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || /^(INPUT|TEXTAREA)$/.test(event.target.tagName) && event.target.type !== "range") { return; }
  const number = Number(event.key) - 1, tree = TREES[state.tree], levels = tree.nodes ? tree.nodes.length : 1;
  if (event.key !== " " && Number.isInteger(number) && number >= 0 && number < TREES.length) { state.tree = number; }
  else if (event.key === "v") { state.mode = next(MODES, state.mode); }
  else if (event.key === "w") { state.surface = next(SURFACES, state.surface); }
  else if (event.key === "l") { state.level = (Math.min(state.level, levels - 1) + 1) % levels; }
  else if (event.key === "b") { state.wind = !state.wind; }
  else if (event.key === " " && event.target.tagName !== "BUTTON") { state.spin = !state.spin; event.preventDefault(); }
  else if (event.key === "f") { front(); return; }
  else { return; }
  refresh();
}
