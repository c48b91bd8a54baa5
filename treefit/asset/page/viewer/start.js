// Start: put the page together and show what its address says.

const canvas = made("canvas");
stage.insertBefore(canvas, byId("hint"));
stage.insertBefore(paint, byId("hint"));
stage.insertBefore(labels, byId("hint"));
document.title = FACTS.title;
try {
  begin(canvas);
} catch (error) {
  renderer = null;
  document.body.dataset.flat = "true";
  byId("hint").textContent = "This browser shows no 3D graphics (WebGL): pictures of the trees instead.";
}
readAddress();
filmStrip();
choices("mode", "mode", refresh);
choices("surface", "surface", refresh);
choices("show", "show", refresh);
choices("side", "side", refresh);
choices("levels", "level", refresh);
["wind", "spin"].forEach(function (name) {
  byId(name).addEventListener("click", function () { state[name] = !state[name]; refresh(); });
});
byId("front").addEventListener("click", front);
byId("overlay").addEventListener("input", function () { state.overlay = Number(byId("overlay").value); writeAddress(); draw(); });
listen(canvas);
window.addEventListener("keydown", key);
new ResizeObserver(function () { frame(performance.now()); }).observe(stage);  // in time for what is shown next
window.addEventListener("hashchange", function () { readAddress(); refresh(); });
refresh();
