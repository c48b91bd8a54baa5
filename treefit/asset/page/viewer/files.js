// Files: GLB and preset are saved from the page; where a frame forbids that, the page says where they lie.

const FRAMED = window.parent !== window;

function filesOf(tree) {
  const box = byId("files"), i = TREES.indexOf(tree);
  box.textContent = "";
  const size = (glbText(i).length * 0.75 / 1e6).toFixed(1) + " MB";
  const save = function (words, name, kind, content) {
    const button = made("button", box, words);
    button.title = "save " + name;
    button.addEventListener("click", function () {
      Promise.resolve(content()).then(function (bytes) { download(new Blob([bytes], { type: kind }), name); });
      if (FRAMED) { where.className = "warn"; }
    });
  };
  const stem = "tree_" + (i + 1);
  save("Save GLB", stem + ".glb", "model/gltf-binary", function () { return glbBytes(i); });
  byId("files").lastChild.title += ", " + size + " packed";
  if (tree.preset) { save("Save preset", stem + ".yaml", "text/yaml", function () { return tree.preset; }); }
  const files = [tree.glb, tree.preset && "preset.yaml"].filter(Boolean).join(", ");
  const where = made("p", box, tree.folder ? "Also in " + tree.folder + "/: " + files : "");
  if (FRAMED && tree.folder) { where.textContent = "If this frame lets nothing be saved: the files are in " + tree.folder + "/ (" + files + ")"; }
}

function download(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  document.body.appendChild(link);
  link.click();
  link.remove();
  setTimeout(function () { URL.revokeObjectURL(link.href); }, 60000);
}
