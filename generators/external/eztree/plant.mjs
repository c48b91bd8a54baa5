// Values and a seed become the arrays of a plant: z up, in metres, arrays (n, 3) as rows x, y, z.

import { optionsOf, usual } from './options.mjs';
import { Skeleton } from './skeleton.mjs';

const METRES = 0.25; // in a unit of ez-tree: its usual tree is 10 m high

// An example of all values.
export function example() {
  return { metres: METRES, ...usual() };
}

// Arrays of the tree of `values` and `seed` under the names of a plant's fields.
export function grow({ metres = METRES, ...values }, seed) {
  const options = optionsOf(values);
  options.seed = seed % 2 ** 32; // its random numbers take no more bits
  for (const level in options.branch.segments) options.branch.segments[level] = 1; // the corners of rings are not kept
  const tree = new Skeleton(options);
  tree.generate();
  return { ...wood(tree, metres), ...foliage(tree.quads, metres, options.leaves.billboard === 'double') };
}

function wood({ rings, parents, levels }, metres) {
  const count = parents.length;
  const position = new Float32Array(3 * count);
  const radius = new Float32Array(count);
  for (let i = 0; i < count; i += 1) {
    const at = 4 * i;
    write(position, i, metres * rings[at], metres * rings[at + 1], metres * rings[at + 2]);
    radius[i] = metres * rings[at + 3];
  }
  return {
    position: { data: position, shape: [count, 3] },
    radius: { data: radius, shape: [count] },
    parent: { data: Int32Array.from(parents), shape: [count] },
    level: { data: Int32Array.from(levels), shape: [count] },
  };
}

// Leaves of `quads`. Two crossed ones have the same axis; the normal of the second is the width of the first.
function foliage(quads, metres, crossed) {
  const single = quads.length / 10;
  const count = crossed ? 2 * single : single;
  const [position, axis, normal] = Array.from({ length: 3 }, () => new Float32Array(3 * count));
  const size = new Float32Array(2 * count);
  for (let leaf = 0; leaf < count; leaf += 1) {
    const at = 10 * (leaf % single);
    const [ax, ay, az] = [quads[at + 3], quads[at + 4], quads[at + 5]];
    const [bx, by, bz] = [quads[at + 6], quads[at + 7], quads[at + 8]];
    write(position, leaf, metres * quads[at], metres * quads[at + 1], metres * quads[at + 2]);
    write(axis, leaf, bx, by, bz);
    if (leaf < single) write(normal, leaf, ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx);
    else write(normal, leaf, ax, ay, az);
    size[leaf] = metres * quads[at + 9];
    size[count + leaf] = size[leaf];
  }
  return {
    leaf_position: { data: position, shape: [count, 3] },
    leaf_axis: { data: axis, shape: [count, 3] },
    leaf_normal: { data: normal, shape: [count, 3] },
    leaf_size: { data: size, shape: [count, 2] },
  };
}

// Write a vector of ez-tree, whose y is up, into rows x, y, z whose z is up: a quarter turn about x.
function write(rows, i, x, y, z) {
  const count = rows.length / 3;
  rows[i] = x;
  rows[count + i] = -z;
  rows[2 * count + i] = y;
}
