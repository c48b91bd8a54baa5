// ez-tree's options as a flat table: branch.length.0 is the length of the trunk.

import * as THREE from 'three';

// The package loads its textures when it is imported, which needs a browser's page; no skeleton needs them.
THREE.TextureLoader.prototype.load = () => new THREE.Texture();
export const { Tree } = await import('@dgreenheck/ez-tree');

const USUAL = structuredClone(new Tree().options);
const UNSEEN = /^(seed|bark|trellis|branch\.segments|leaves\.(type|tint|alphaTest))/;

// The usual values of all options that shape a tree, by name.
export function usual() {
  return Object.fromEntries(flat(USUAL).filter(([name]) => !UNSEEN.test(name)));
}

// ez-tree's options with `values` by name, all others as usual.
export function optionsOf(values) {
  const options = structuredClone(USUAL);
  for (const [name, value] of Object.entries(values)) put(options, name, value);
  return options;
}

function flat(table, before = '') {
  return Object.entries(table).flatMap(([key, value]) =>
    typeof value === 'object' ? flat(value, `${before}${key}.`) : [[before + key, value]]);
}

function put(options, name, value) {
  const keys = name.split('.');
  const last = keys.pop();
  const table = keys.reduce((inner, key) => inner?.[key], options);
  const was = table?.[last];
  if (was === undefined || typeof was === 'object') throw new Error(`values: ez-tree has no option ${name}`);
  if (typeof value !== typeof was) throw new Error(`values.${name}: must be a ${typeof was}, got ${value}`);
  table[last] = value;
}
