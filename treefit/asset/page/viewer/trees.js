// Trees: the embedded GLB files become objects with levels of detail and surfaces.

const CLAY = new THREE.MeshStandardMaterial({ color: 0xcfcac0, roughness: 0.95, metalness: 0 });
const LINES = new THREE.LineBasicMaterial({ color: 0x20303a, transparent: true, opacity: 0.45 });

function glbText(i) { return document.getElementsByClassName("glb")[i].textContent; }

async function glbBytes(i) {
  const text = atob(glbText(i)), bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; k++) { bytes[k] = text.charCodeAt(k); }
  const inflated = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(inflated).arrayBuffer();
}

function load(i) {  // a promise of the loaded tree, the same one each time
  const tree = TREES[i];
  if (!tree.loading) { tree.loading = glbBytes(i).then(parse).then(function (gltf) { return ready(tree, gltf); }); }
  return tree.loading;
}

function parse(bytes) {
  return new Promise(function (done, failed) {
    const loader = new THREE.GLTFLoader();
    loader.register(function (parser) {  // images by <img>: it needs no request, which the page's policy forbids
      parser.textureLoader = new THREE.TextureLoader(parser.options.manager);
      return { name: "images" };
    });
    loader.parse(bytes, "", done, failed);
  });
}

function ready(tree, gltf) {
  const root = tree.root = gltf.scene;
  tree.windFirst = /bend/.test(((gltf.asset || {}).extras || {}).COLOR_0 || "");
  tree.nodes = levelsOf(root);
  tree.counts = tree.nodes.map(count);
  root.updateMatrixWorld(true);
  const box = new THREE.Box3().setFromObject(tree.nodes[0]);
  tree.height = tree.height || Math.max(box.max.y, 1e-3);
  tree.wide = 2 * Math.max(-box.min.x, box.max.x, -box.min.z, box.max.z, 1e-3);
  tree.reach = tree.reach || tree.wide / 2 / tree.height;
  tree.windy = false;
  meshesOf(root).forEach(function (mesh) { prepare(mesh, tree); });
  return tree;
}

function levelsOf(root) {
  const found = [];
  (function look(node) {
    if (/_?LOD\d+$/.test(node.name)) { found.push(node); } else { node.children.forEach(look); }
  }(root));
  return found.length ? found : [root];
}

function meshesOf(node) {
  const found = [];
  node.traverse(function (part) { if (part.isMesh) { found.push(part); } });
  return found;
}

function count(node) {
  return meshesOf(node).reduce(function (sum, mesh) {
    const shape = mesh.geometry;
    return sum + (shape.index ? shape.index.count : shape.attributes.position.count) / 3;
  }, 0);
}

function prepare(mesh, tree) {
  const shape = mesh.geometry, colours = [shape.attributes.color, shape.attributes.color_1];
  if (tree.windFirst) { colours.reverse(); }  // what moves a vertex is no shade
  if (colours[0]) { shape.setAttribute("color", colours[0]); } else { shape.deleteAttribute("color"); }
  if (colours[1]) { shape.setAttribute("wind", colours[1]); tree.windy = true; }
  mesh.castShadow = mesh.receiveShadow = true;
  const made = mesh.material.userData, sways = Boolean(colours[1]);
  if (!made.clay) { Object.assign(made, companions(mesh.material, Boolean(colours[0]), sways ? tree : null)); }
  mesh.userData = { full: mesh.material, clay: made.clay };
  mesh.customDepthMaterial = made.depth;
}

function companions(full, shaded, tree) {  // of one material: its clay, and what throws its shadow; all bend alike
  const clay = CLAY.clone(), cut = full.alphaTest > 0 && full.map;
  const depth = new THREE.MeshDepthMaterial({ depthPacking: THREE.RGBADepthPacking, map: cut ? full.map : null, alphaTest: full.alphaTest });
  full.vertexColors = clay.vertexColors = shaded;
  clay.side = full.side;
  full.shadowSide = clay.shadowSide = THREE.DoubleSide;
  full.needsUpdate = true;
  if (full.map) { full.map.anisotropy = 4; }
  if (full.side === THREE.DoubleSide) { letThrough(full); }
  if (cut) { clay.alphaTest = full.alphaTest; cutOut(clay, full.map); }
  if (tree) { [full, clay, depth].forEach(function (one) { bend(one, tree); }); }
  return { clay: clay, depth: depth };
}

function letThrough(leaf) {  // what of the sun comes through a leaf from behind, as in the pictures
  leaf.onBeforeCompile = function (shader) {
    shader.fragmentShader = shader.fragmentShader.replace("#include <lights_fragment_begin>", `#include <lights_fragment_begin>
      reflectedLight.directDiffuse += max(-dot(normal, directLight.direction), 0.0) * vec3(0.55, 0.62, 0.31) * directLight.color * material.diffuseColor;`);
  };
}

function cutOut(clay, map) {  // the leaf's outline without its colours
  clay.map = map;
  clay.onBeforeCompile = function (shader) {
    shader.fragmentShader = shader.fragmentShader.replace("#include <map_fragment>",
      "diffuseColor.a *= texture2D(map, vUv).a;");
  };
}

function dress(tree) {  // show one level of a loaded tree with the chosen surface
  const level = Math.min(state.level, tree.nodes.length - 1);
  tree.nodes.forEach(function (node, k) { node.visible = k === level; });
  meshesOf(tree.nodes[level]).forEach(function (mesh) {
    const own = mesh.userData;
    mesh.material = state.surface === "full" ? own.full : own.clay;
    if (state.surface === "wire" && !own.wire) {
      own.wire = new THREE.LineSegments(new THREE.WireframeGeometry(mesh.geometry), LINES);
      mesh.add(own.wire);
    }
    if (own.wire) { own.wire.visible = state.surface === "wire"; }
    own.clay.polygonOffset = state.surface === "wire";
    own.clay.polygonOffsetFactor = own.clay.polygonOffsetUnits = 1;
  });
  tree.stale = true;  // its shadow
}
