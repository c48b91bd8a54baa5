// Camera: the tree stands in its cell where the tree of the picture stands in its own, at the same scale.

const PHOTO = FACTS.picture;
const NEAR_FOOT = 0.1, NEAR_TOP = 0.05;  // shares of a cell's height under and over the tree
const lens = { near: new THREE.PerspectiveCamera(), far: new THREE.OrthographicCamera() };

function placing(w, h) {  // pixels of the tree's height, and where its foot is, in a cell of w x h pixels
  const seen = state.mode === "all" ? TREES : [TREES[state.tree]];
  const reach = Math.max(PHOTO.reach, ...seen.map(function (tree) { return tree.reach; }), 0.2);
  const tall = Math.min(h * (1 - NEAR_FOOT - NEAR_TOP), w * 0.47 / reach);
  const foot = h / 2 + (tall / 2) + h * (NEAR_TOP - NEAR_FOOT) / 2;
  return { tall: tall * state.zoom, x: w / 2 + state.panX, y: h / 2 + (foot - h / 2) * state.zoom + state.panY };
}

function look(tree, w, h, flat) {  // the camera for a tree; flat: without perspective, as the search sees it
  const at = placing(w, h), half = tree.height / 2, away = 3.2 * Math.max(tree.height, 0.7 * tree.wide);
  const camera = flat ? lens.far : lens.near;
  let under = at.tall / 2;  // pixels from the middle of the tree down to its foot
  if (flat) {
    const scale = at.tall / tree.height;
    camera.left = -w / 2 / scale; camera.right = -camera.left;
    camera.top = h / 2 / scale; camera.bottom = -camera.top;
  } else {
    const low = half * Math.cos(TILT) / (away + half * Math.sin(TILT)), high = half * Math.cos(TILT) / (away - half * Math.sin(TILT));
    const focal = at.tall / (low + high);
    under = focal * low;
    camera.aspect = w / h;
    camera.fov = 2 * Math.atan(h / 2 / focal) * 180 / Math.PI;
  }
  const pitch = flat && state.pitch === TILT ? 0 : state.pitch, level = Math.cos(pitch) * away;
  camera.near = 0.02 * away;
  camera.far = 60 * away;
  camera.position.set(Math.sin(state.yaw) * level, half + Math.sin(pitch) * away, Math.cos(state.yaw) * level);
  camera.lookAt(0, half, 0);
  camera.setViewOffset(w, h, w / 2 - at.x, h / 2 - (at.y - under), w, h);
  return camera;
}
