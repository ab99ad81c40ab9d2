// A packed mesh (host/show/page_mesh.h) as arrays for the GPU.

async function bytesOf(packed) {
  const text = atob(document.getElementById(packed.id).textContent);
  const stored = Uint8Array.from(text, (c) => c.charCodeAt(0));
  if (!packed.deflated) return stored;
  const stream = new Blob([stored]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Reads numbers whose bytes stand in streams of their own, the lowest first.
function reader(bytes) {
  let at = 0;
  return (count, width) => {
    const numbers = new Uint32Array(count);
    for (let byte = 0; byte < width; ++byte, at += count) {
      for (let i = 0; i < count; ++i) numbers[i] |= bytes[at + i] << (8 * byte);
    }
    return numbers;
  };
}

const step = (code) => (code & 1 ? -((code + 1) >> 1) : code >> 1);

function undoDifferences(codes, stride, mask) {
  const last = new Array(stride).fill(0);
  for (let i = 0; i < codes.length; ++i) {
    last[i % stride] = (last[i % stride] + step(codes[i])) & mask;
    codes[i] = last[i % stride];
  }
  return codes;
}

function undoCorners(codes) {
  let known = 0;
  for (let i = 0; i < codes.length; ++i) {
    const isNew = codes[i] === 0;
    codes[i] = known - codes[i];
    if (isNew) ++known;
  }
  return codes;
}

const word = new DataView(new ArrayBuffer(4));
function floatOf(bits) {
  word.setUint32(0, bits);
  return word.getFloat32(0);
}

// Distances at corners: each is stored as its difference from the one before at its vertex.
function readDistances(codes, corners, vertices, unit) {
  const known = new Int32Array(vertices).fill(-1);
  const distances = new Float64Array(codes.length);
  let last = 0;
  for (let i = 0; i < codes.length; ++i) {
    const before = known[corners[i]] < 0 ? last : known[corners[i]];
    last = known[corners[i]] = (before + step(codes[i])) & 0xffffff;
    distances[i] = floatOf((last >>> 1) << 8) * unit * (last & 1 ? -1 : 1);
  }
  return distances;
}

/// {positions, distances, widths, flags}: three points a face, in units of `frame`, so that both meshes lie as they are; three distances a face, in the
/// files' unit, and how far they may be off; 1 for a face that is not resolved, 2 for one without a side, 4 for one that is left out. `spacing`: about how far points are apart, in
/// units of `frame`, or 0; a point is a face whose corners are one.
export async function readMesh(packed, frame) {
  const read = reader(await bytesOf(packed));
  const corners = undoCorners(read(3 * packed.faces, 3));
  const points = undoDifferences(read(3 * packed.vertices, 2), 3, 0xffff);
  const distances = readDistances(read(3 * packed.faces, 3), corners, packed.vertices, packed.unit);
  const widths = Float64Array.from(undoDifferences(read(packed.faces, 2), 1, 0xffff), (bits) => floatOf(bits << 15) * packed.unit);
  const flags = read(packed.faces, 1);
  const scale = frame.size > 0 ? packed.size / frame.size / 65535 : 0;
  const shift = packed.lo.map((lo, i) => (frame.size > 0 ? (lo - frame.lo[i]) / frame.size : 0));
  const positions = new Float32Array(9 * packed.faces);
  for (let corner = 0; corner < 3 * packed.faces; ++corner) {
    for (let axis = 0; axis < 3; ++axis) positions[3 * corner + axis] = points[3 * corners[corner] + axis] * scale + shift[axis];
  }
  return { positions, distances, widths, flags, spacing: packed.spacing * scale * 65535 };
}
