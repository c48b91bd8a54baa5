// Program of a test: the mesh that ez-tree itself makes, written as an npz file.

import { readFileSync, writeFileSync } from 'node:fs';
import { npz } from '../../../generators/external/npz.mjs';
import { Tree, optionsOf } from '../../../generators/external/eztree/options.mjs';

const { values, seed, out } = JSON.parse(readFileSync(0, 'utf8'));
const { metres, ...names } = values;
const tree = new Tree({ ...optionsOf(names), seed });
tree.generate();
writeFileSync(out, npz({ wood: rows(tree.branches.verts), triangles: indices(tree), leaves: rows(tree.leaves.verts) }));

// Vertices (3, n) in metres: z up.
function rows(verts) {
  const count = verts.length / 3;
  const data = new Float32Array(verts.length);
  for (let i = 0; i < count; i += 1) data.set([verts[3 * i], -verts[3 * i + 2], verts[3 * i + 1]].map((x) => metres * x), 3 * i);
  return { data, shape: [3, count] };
}

function indices({ branches }) {
  return { data: Int32Array.from(branches.indices), shape: [3, branches.indices.length / 3] };
}
