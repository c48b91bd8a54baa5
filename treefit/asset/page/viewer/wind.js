// Wind: vertices sway by what the vertex colour says of them: bend (0 at the root), phase, flutter.

const GUST = { value: 0 }, CLOCK = { value: 0 };

function bend(material, tree) {
  const before = material.onBeforeCompile, tall = { value: tree.height };
  material.onBeforeCompile = function (shader, renderer) {
    before.call(material, shader, renderer);
    Object.assign(shader.uniforms, { gust: GUST, clock: CLOCK, tall: tall });
    shader.vertexShader = "attribute vec3 wind; uniform float gust, clock, tall;\n" + shader.vertexShader.replace(
      "#include <begin_vertex>", `#include <begin_vertex>
      float lean = wind.x * wind.x * (0.55 + 0.45 * sin(1.3 * clock + 6.283 * wind.y));
      transformed.xz += gust * tall * 0.055 * lean * vec2(1.0, 0.35 * sin(0.9 * clock + 12.57 * wind.y));
      transformed.y -= gust * tall * 0.012 * lean * lean;
      transformed += gust * tall * 0.004 * wind.z * sin(vec3(7.0, 9.0, 8.0) * clock + 25.0 * wind.y + 40.0 * position);`);
  };
  material.customProgramCacheKey = function () { return before.toString() + "wind"; };
}

function blow(seconds) {  // false when all is still
  if (!TREES.some(function (tree) { return tree.windy; })) { return false; }
  CLOCK.value += seconds;
  GUST.value += ((state.wind ? 1 : 0) - GUST.value) * Math.min(1, 2 * seconds);
  if (!state.wind && GUST.value < 0.01) { GUST.value = 0; return false; }
  return true;
}
