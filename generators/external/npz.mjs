// Arrays as the bytes of an npz file: a zip with one uncompressed .npy member an array.

import * as zlib from 'node:zlib';

const TYPES = new Map([[Float32Array, '<f4'], [Int32Array, '<i4']]);
const LOCAL = 30;
const ENTRY = 46;
const END = 22;

// Bytes of the npz file that holds `arrays`: name -> { data, shape }, the data in Fortran's order.
export function npz(arrays) {
  const members = Object.entries(arrays).map(([name, array]) => member(`${name}.npy`, array));
  const body = members.reduce((sum, { name, size }) => sum + LOCAL + name.length + size, 0);
  const index = members.reduce((sum, { name }) => sum + ENTRY + name.length, 0);
  const file = Buffer.alloc(body + index + END);
  let at = 0;
  let entry = body;
  for (const one of members) {
    entry = writeEntry(file, entry, one, at);
    at = writeMember(file, at, one);
  }
  file.writeUInt32LE(0x06054b50, entry);
  file.writeUInt16LE(members.length, entry + 8);
  file.writeUInt16LE(members.length, entry + 10);
  file.writeUInt32LE(index, entry + 12);
  file.writeUInt32LE(body, entry + 16);
  return file;
}

function member(file, { data, shape }) {
  const head = header(TYPES.get(data.constructor), shape);
  const bytes = Buffer.from(data.buffer, data.byteOffset, data.byteLength);
  const crc = crc32(bytes, crc32(head));
  return { name: Buffer.from(file, 'latin1'), head, bytes, crc, size: head.length + bytes.length };
}

// Header of an npy file of version 1: its length is a multiple of 64.
function header(type, shape) {
  const shown = shape.length === 1 ? `(${shape[0]},)` : `(${shape.join(', ')})`;
  const text = `{'descr': '${type}', 'fortran_order': True, 'shape': ${shown}, }`;
  const length = Math.ceil((10 + text.length + 1) / 64) * 64;
  const head = Buffer.from(`\x93NUMPY\x01\x00\x00\x00${text.padEnd(length - 11)}\n`, 'latin1');
  head.writeUInt16LE(length - 10, 8);
  return head;
}

function writeMember(file, at, { name, head, bytes, crc, size }) {
  file.writeUInt32LE(0x04034b50, at);
  writeFacts(file, at + 4, name, crc, size);
  let next = at + LOCAL;
  for (const part of [name, head, bytes]) next += part.copy(file, next);
  return next;
}

function writeEntry(file, at, { name, crc, size }, offset) {
  file.writeUInt32LE(0x02014b50, at);
  file.writeUInt16LE(20, at + 4);
  writeFacts(file, at + 6, name, crc, size);
  file.writeUInt32LE(offset, at + 42);
  return at + ENTRY + name.copy(file, at + ENTRY);
}

// What the head of a member and its entry in the index share. The date is that of 1980: same tree, same bytes.
function writeFacts(file, at, name, crc, size) {
  file.writeUInt16LE(20, at);
  file.writeUInt16LE(0x21, at + 8);
  file.writeUInt32LE(crc, at + 10);
  file.writeUInt32LE(size, at + 14);
  file.writeUInt32LE(size, at + 18);
  file.writeUInt16LE(name.length, at + 22);
}

function crc32(bytes, before = 0) {
  if (zlib.crc32) return zlib.crc32(bytes, before);
  let crc = ~before; // Node before 20.15 has none
  for (const byte of bytes) crc = TABLE[(crc ^ byte) & 255] ^ (crc >>> 8);
  return ~crc >>> 0;
}

const TABLE = Int32Array.from({ length: 256 }, (_, byte) => {
  let crc = byte;
  for (let bit = 0; bit < 8; bit += 1) crc = crc & 1 ? 0xedb88320 ^ (crc >>> 1) : crc >>> 1;
  return crc;
});
