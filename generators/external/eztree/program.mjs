// Child program: grows trees by ez-tree; one JSON line in, one tree into an npz file, one JSON line out.

import { createInterface } from 'node:readline';
import { writeFileSync } from 'node:fs';
import { npz } from '../npz.mjs';
import { example, grow } from './plant.mjs';

for await (const line of createInterface({ input: process.stdin })) {
  if (line.trim()) process.stdout.write(`${JSON.stringify(answer(line))}\n`);
}

function answer(line) {
  let id = null;
  try {
    const request = JSON.parse(line);
    id = request.id;
    if (request.ask === 'preset') return { id, ok: true, values: example() };
    if (request.ask !== undefined) throw new Error(`ask: knows preset, got ${request.ask}`);
    writeFileSync(place(request.out), npz(grow(request.values, request.seed)));
    return { id, ok: true };
  } catch (error) {
    return { id, ok: false, error: error.message };
  }
}

function place(out) {
  if (/\.(glb|gltf)$/.test(out)) throw new Error(`out: this program writes .npz only, got ${out}`);
  return out.endsWith('.npz') ? out : `${out}.npz`;
}
