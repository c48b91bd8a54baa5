// A tree of ez-tree that notes rings along its stems and places of leaves while it grows, and makes no mesh.

import { Matrix4 } from 'three';
import { Tree } from './options.mjs';

// A branch that goes on at the end of another, as every one of deciduous trees does, is of the same stem here.
export class Skeleton extends Tree {
  rings = []; // x, y, z, radius of each
  parents = []; // the ring before each
  levels = []; // of the stem of each: 0 is the trunk with all that goes on at its end
  quads = []; // of leaves: x, y, z of the middle of the foot, unit vectors of the width and the axis, size
  #joints = new Map(); // of branches that wait: the ring they begin at, their level, whether they go on
  #sections = [];

  generateBranch(branch) {
    const joint = this.#joints.get(branch) ?? { ring: -1, level: 0, goesOn: false };
    const waiting = this.branchQueue.length;
    super.generateBranch(branch);
    const rings = this.#note(joint);
    this.branchQueue.slice(waiting).forEach((child, i) => {
      const goesOn = i === 0 && this.options.type === 'deciduous';
      const ring = goesOn ? rings.at(-1) : rings[this.#before(child.origin)];
      this.#joints.set(child, { ring, level: goesOn ? joint.level : joint.level + 1, goesOn });
    });
    this.#joints.delete(branch);
  }

  // Number of the ring at each section of the branch that has just grown.
  #note({ ring, level, goesOn }) {
    let before = ring;
    return this.#sections.map(({ origin, radius }, i) => {
      if (i === 0 && goesOn) return ring;
      this.rings.push(origin.x, origin.y, origin.z, radius);
      this.levels.push(level);
      before = this.parents.push(before) - 1;
      return before;
    });
  }

  // The section after which `origin` lies on the axis of the branch that has just grown.
  #before(origin) {
    let nearest = 0;
    let least = Infinity;
    for (let i = 0; i + 1 < this.#sections.length; i += 1) {
      const [a, b] = [this.#sections[i].origin, this.#sections[i + 1].origin];
      const detour = origin.distanceTo(a) + origin.distanceTo(b) - a.distanceTo(b);
      if (detour < least) [nearest, least] = [i, detour];
    }
    return nearest;
  }

  // The package hands the sections of each branch to one of these two.
  generateChildBranches(count, level, sections) {
    this.#sections = sections;
    super.generateChildBranches(count, level, sections);
  }

  generateLeaves(sections) {
    this.#sections = sections;
    super.generateLeaves(sections);
  }

  // A leaf is a square that stands on `origin`; in `orientation` x is along its width, y along its axis.
  generateLeaf(origin, orientation) {
    const { size, sizeVariance } = this.options.leaves;
    const length = size * (1 + this.rng.random(sizeVariance, -sizeVariance));
    const frame = FRAME.makeRotationFromEuler(orientation).elements;
    this.quads.push(origin.x, origin.y, origin.z, frame[0], frame[1], frame[2], frame[4], frame[5], frame[6], length);
  }

  generateBranchIndices() {}

  createBranchesGeometry() {}

  createLeavesGeometry() {}

  createTrellis() {}
}

const FRAME = new Matrix4();
