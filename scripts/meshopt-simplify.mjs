// The part of scripts/meshopt-simplify that needs node. First argument: the folder of the package.
import { readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { pathToFileURL } from 'node:url';

const flagNames = ['Permissive', 'Prune', 'Regularize', 'RegularizeLight', 'LockBorder'];

class Failure extends Error {
  constructor(code, message) {
    super(message);
    this.code = code;
  }
}
const misuse = (message) => new Failure(2, `${message} (see scripts/meshopt-simplify --help)`);

function parseNumber(name, text, isGood) {
  const x = text === undefined || text.trim() === '' ? NaN : Number(text);
  if (!isGood(x)) throw misuse(`${name} '${text ?? ''}' is not a number as wanted`);
  return x;
}

function parseFlags(text) {
  const flags = (text ?? '').split(',').filter((flag) => flag !== '');
  for (const flag of flags)
    if (!flagNames.includes(flag)) throw misuse(`'${flag}' is none of ${flagNames.join(', ')}`);
  return flags;
}

function parseArguments(words) {
  const out = { weight: 10, flags: [], protect: false, update: false, quiet: false };
  const taking = {
    '--faces': (text) => (out.faces = parseNumber('--faces', text, (x) => Number.isInteger(x) && x > 0)),
    '--weight': (text) => (out.weight = parseNumber('--weight', text, (x) => x >= 0 && x <= 1e6)),
    '--flags': (text) => (out.flags = parseFlags(text)),
    '-o': (text) => (out.output = text),
  };
  const bare = { '--protect': 'protect', '--update': 'update', '-q': 'quiet' };
  for (let i = 0; i < words.length; ++i) {
    if (words[i] in taking) taking[words[i]](words[++i]);
    else if (words[i] in bare) out[bare[words[i]]] = true;
    else if (words[i].startsWith('-') || out.mesh !== undefined) throw misuse(`'${words[i]}' has no meaning here`);
    else out.mesh = words[i];
  }
  for (const [name, value] of [['MESH', out.mesh], ['--faces', out.faces], ['-o', out.output]])
    if (!value) throw misuse(`${name} is missing`);
  if (out.protect && !out.flags.includes('Permissive')) throw misuse('--protect is for --flags Permissive');
  return out;
}

// Corners of triangles, three after three, each [position, texture coordinate], from 0.
function readObj(file) {
  let text;
  try {
    text = readFileSync(file, 'latin1');
  } catch {
    throw new Failure(1, `${file}: cannot be read`);
  }
  const mesh = { positions: [], texcoords: [], corners: [] };
  text.split('\n').forEach((line, i) => {
    const words = line.trim().split(/\s+/);
    const fault = (what) => new Failure(1, `${file}: line ${i + 1}: ${what}`);
    const numbers = (n) => {
      const out = words.slice(1, n + 1).map((word) => Math.fround(Number(word)));
      if (out.length < n || !out.every(Number.isFinite)) throw fault(`are not ${n} numbers`);
      return out;
    };
    const index = (word, n) => {
      const k = Number(word);
      const place = k < 0 ? n + k : k - 1;
      if (!Number.isInteger(k) || k === 0 || place < 0 || place >= n) throw fault(`'${word}' is no index of the file's`);
      return place;
    };
    if (words[0] === 'v') mesh.positions.push(numbers(3));
    else if (words[0] === 'vt') mesh.texcoords.push(numbers(2));
    else if (words[0] === 'f') {
      const face = words.slice(1).map((word) => {
        const [v, vt] = word.split('/');
        if (!vt) throw fault('a corner has no texture coordinate');
        return [index(v, mesh.positions.length), index(vt, mesh.texcoords.length)];
      });
      if (face.length < 3) throw fault('a face has fewer than three corners');
      for (let k = 2; k < face.length; ++k) mesh.corners.push(face[0], face[k - 1], face[k]);
    }
  });
  if (mesh.corners.length === 0) throw new Failure(1, `${file}: has no faces`);
  return mesh;
}

// The place of each value in the order of first appearance.
class Places {
  map = new Map();
  values = [];
  of(value) {
    const key = value.join(' ');
    let place = this.map.get(key);
    if (place === undefined) {
      place = this.values.push(value) - 1;
      this.map.set(key, place);
    }
    return place;
  }
}

// One vertex for each pair of position and texture coordinate.
function weld(mesh) {
  const vertices = new Places();
  const indices = Uint32Array.from(mesh.corners, ([v, vt]) => vertices.of([...mesh.positions[v], ...mesh.texcoords[vt]]));
  return {
    indices,
    positions: Float32Array.from(vertices.values.flatMap((x) => x.slice(0, 3))),
    texcoords: Float32Array.from(vertices.values.flatMap((x) => x.slice(3))),
  };
}

// 2 where a position has several texture coordinates: protected [PR 930 of the library].
function findSeams(positions) {
  const places = new Places();
  const place = [];
  for (let i = 0; i < positions.length; i += 3) place.push(places.of([...positions.subarray(i, i + 3)]));
  const count = new Uint32Array(places.values.length);
  for (const p of place) ++count[p];
  return Uint8Array.from(place, (p) => (count[p] > 1 ? 2 : 0));
}

function simplify(simplifier, mesh, options) {
  const lock = options.protect ? findSeams(mesh.positions) : null;
  const rest = [mesh.positions, 3, mesh.texcoords, 2, [options.weight, options.weight], lock, 3 * options.faces, 1e9, options.flags];
  if (!options.update) {
    const [indices, error] = simplifier.simplifyWithAttributes(mesh.indices, ...rest);
    return { ...mesh, indices, error };
  }
  const [n, error] = simplifier.simplifyWithUpdate(mesh.indices, ...rest);
  return { ...mesh, indices: mesh.indices.subarray(0, n), error };
}

function formatObj(mesh, comment) {
  const positions = new Places();
  const texcoords = new Places();
  const faces = [];
  for (let i = 0; i < mesh.indices.length; i += 3) {
    const corners = Array.from(mesh.indices.subarray(i, i + 3), (v) => {
      const p = positions.of([...mesh.positions.subarray(3 * v, 3 * v + 3)]);
      const t = texcoords.of([...mesh.texcoords.subarray(2 * v, 2 * v + 2)]);
      return `${p + 1}/${t + 1}`;
    });
    faces.push(`f ${corners.join(' ')}`);
  }
  const line = (keyword) => (value) => `${keyword} ${value.map((x) => Number(x.toPrecision(9))).join(' ')}`;
  return [`# ${comment}`, ...positions.values.map(line('v')), ...texcoords.values.map(line('vt')), ...faces, ''].join('\n');
}

function writeWhole(file, text) {
  const part = join(dirname(file), `.tmp-${process.pid}.obj`);
  try {
    writeFileSync(part, text);
    renameSync(part, file);
  } catch (error) {
    rmSync(part, { force: true });
    throw new Failure(3, `cannot write ${file}: ${error.code}`);
  }
}

async function main(folder, words) {
  const options = parseArguments(words);
  const { version } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
  const { MeshoptSimplifier } = await import(pathToFileURL(join(folder, 'meshopt_simplifier.js')));
  await MeshoptSimplifier.ready;
  const mesh = weld(readObj(options.mesh));
  const simple = simplify(MeshoptSimplifier, mesh, options);
  const n = simple.indices.length / 3;
  const name = options.update ? 'simplifyWithUpdate' : 'simplifyWithAttributes';
  writeWhole(options.output, formatObj(simple, `meshoptimizer ${version} ${name} weight ${options.weight} flags ` +
    `${options.flags.join(',') || 'none'}${options.protect ? ' seams protected' : ''}, ${options.faces} faces asked`));
  if (!options.quiet) console.error(`meshopt-simplify: ${n} faces, error ${simple.error.toPrecision(4)}`);
  if (n <= options.faces) return 0;
  console.error(`meshopt-simplify: ${options.mesh}: ${options.faces} faces were asked for, it stops at ${n}`);
  return 5;
}

try {
  process.exitCode = await main(process.argv[2], process.argv.slice(3));
} catch (error) {
  console.error(`meshopt-simplify: ${error.message}`);
  process.exitCode = error instanceof Failure ? error.code : 4;
}
