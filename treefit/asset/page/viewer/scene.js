// Scene: sun, sky, ground and one canvas in which every tree has a part.

const TINTS = { top: 0xbacfe3, low: 0xf1f2ef, lawn: 0xd0cdb8 };
const LIGHT = { sun: [2.4, 2.2, 1.85], sky: [0.74, 0.86, 1.02], ground: [0.3, 0.27, 0.2] };  // linear; occlusion dims all of it
let renderer = null, waiting = false, before = 0;

function begin(canvas) {
  renderer = new THREE.WebGLRenderer({ canvas: canvas, antialias: true, alpha: true });
  renderer.outputEncoding = THREE.sRGBEncoding;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.PCFSoftShadowMap;
  renderer.shadowMap.autoUpdate = false;
  renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
  renderer.setScissorTest(true);
  canvas.addEventListener("webglcontextrestored", function () { TREES.forEach(function (tree) { tree.stale = true; }); draw(); });
}

function sceneOf(tree) {
  if (tree.scene) { return tree.scene; }
  const scene = tree.scene = new THREE.Scene(), size = Math.max(tree.height, tree.wide);
  const sun = new THREE.DirectionalLight(light("sun")), shade = sun.shadow.camera, reach = 0.85 * size;
  scene.add(new THREE.HemisphereLight(light("sky"), light("ground")), sun, sun.target, tree.root);
  sun.castShadow = true;
  sun.shadow.mapSize.set(2048, 2048);
  sun.shadow.radius = 4;
  sun.shadow.bias = -0.0005;
  sun.shadow.normalBias = 0.0025 * size;
  sun.target.position.set(0, tree.height / 2, 0);
  sun.position.set(-0.38 * 2 * size, tree.height / 2 + 0.78 * 2 * size, 0.50 * 2 * size);
  shade.left = shade.bottom = -reach; shade.right = shade.top = reach;
  shade.near = 0.5 * size; shade.far = 4.5 * size;
  const shadow = new THREE.ShadowMaterial({ color: 0x2c3020, opacity: 0.36 });
  const ground = new THREE.Mesh(new THREE.PlaneGeometry(6 * size, 6 * size), shadow);
  ground.rotation.x = -Math.PI / 2;
  ground.receiveShadow = true;
  tree.backdrop = new THREE.Group();
  tree.backdrop.add(dome(size), lawn(size), ground);
  scene.add(tree.backdrop);
  return scene;
}

function light(name) { return new THREE.Color().setRGB(...LIGHT[name]); }

function dome(size) {  // the sky, wherever the camera is in the middle of it
  const material = new THREE.ShaderMaterial({
    side: THREE.BackSide, depthWrite: false, depthTest: false,
    uniforms: colours("top", "low"),
    vertexShader: "varying vec3 way; void main() { way = position; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
    fragmentShader: `varying vec3 way; uniform vec3 top, low;
      void main() { gl_FragColor = vec4(mix(low, top, smoothstep(-0.08, 0.32, normalize(way).y)), 1.0); }`,
  });
  const ball = new THREE.Mesh(new THREE.SphereGeometry(20 * size, 24, 16), material);
  ball.renderOrder = -1;
  ball.frustumCulled = false;
  ball.onBeforeRender = function (_, __, camera) { ball.position.copy(camera.position); ball.updateMatrixWorld(); ball.modelViewMatrix.multiplyMatrices(camera.matrixWorldInverse, ball.matrixWorld); };
  return ball;
}

function lawn(size) {  // ground that fades into the sky: a horizon would cut the crown
  const material = new THREE.ShaderMaterial({
    transparent: true, depthWrite: false, uniforms: colours("lawn"),
    vertexShader: "varying vec2 at; void main() { at = uv * 2.0 - 1.0; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
    fragmentShader: "varying vec2 at; uniform vec3 lawn; void main() { gl_FragColor = vec4(lawn, 1.0 - smoothstep(0.0, 1.0, length(at))); }",
  });
  const plane = new THREE.Mesh(new THREE.PlaneGeometry(5 * size, 5 * size), material);
  plane.rotation.x = -Math.PI / 2;
  plane.position.y = -0.001 * size;
  return plane;
}

function colours(...names) {
  return Object.fromEntries(names.map(function (name) { return [name, { value: new THREE.Color(TINTS[name]) }]; }));
}

function paintTree(tree, cell, options) {  // options: flat, bare (no backdrop), from and to (edges of what is drawn)
  const scene = sceneOf(tree), camera = look(tree, cell.w, cell.h, options.flat), down = renderer.domElement.clientHeight - cell.y - cell.h;
  const from = Math.round(options.from || 0), wide = Math.round(options.to || cell.w) - from;
  tree.backdrop.visible = !options.bare;
  renderer.setViewport(cell.x, down, cell.w, cell.h);
  renderer.setScissor(cell.x + from, down, Math.max(wide, 0), cell.h);
  renderer.shadowMap.needsUpdate = Boolean(tree.stale);
  tree.stale = false;
  if (wide >= 1) { renderer.render(scene, camera); }
}

function draw() {  // soon, once for all that changed
  if (waiting) { return; }
  waiting = true;
  requestAnimationFrame(frame);
}

function frame(now) {
  const seconds = clip((now - before) / 1000, 0, 0.05);
  before = now;
  waiting = false;
  if (state.spin) { state.yaw += 0.35 * seconds; }
  const moving = blow(seconds);
  drawCells(moving);
  if (state.spin || moving) { draw(); }
}
