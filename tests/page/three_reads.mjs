// What three.js reads of out.ply and out.glb, as JSON; see readers_test.py.
//
// usage: node three_reads.mjs FOLDER, beside node_modules with three
import { readFileSync } from 'node:fs';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { PLYLoader } from 'three/examples/jsm/loaders/PLYLoader.js';

globalThis.self = globalThis; // the loaders expect a browser's
const folder = process.argv[2];
const bytes = (name) => {
  const read = readFileSync(`${folder}/${name}`);
  return read.buffer.slice(read.byteOffset, read.byteOffset + read.byteLength);
};
const arrays = (geometry) => Object.fromEntries(Object.entries(geometry.attributes).map(
  ([name, { array, itemSize, normalized }]) => [name, { values: [...array], itemSize, normalized }]));

const loader = new PLYLoader();
loader.setCustomPropertyNameMapping({ quality: ['quality'] });
const ply = loader.parse(bytes('out.ply'));
const glb = await new GLTFLoader().parseAsync(bytes('out.glb'), '');
glb.scene.updateMatrixWorld(true);
let mesh = null;
glb.scene.traverse((node) => { mesh = node.isMesh ? node : mesh; });
console.log(JSON.stringify({
  ply: { arrays: arrays(ply), corners: ply.index && [...ply.index.array] },
  glb: { arrays: arrays(mesh.geometry), placed: mesh.matrixWorld.elements, extras: mesh.userData },
}));
