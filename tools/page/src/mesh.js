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

function undoDifferences(codes, stride) {
  const last = new Array(stride).fill(0);
  for (let i = 0; i < codes.length; ++i) {
    last[i % stride] = (last[i % stride] + step(codes[i])) & 0xffff;
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

/// {positions, steps}: nine numbers each a face (within, beyond, and whether it is known coarsely, thrice), in units of `frame`, so that both meshes lie as
/// they are.
export async function readMesh(packed, frame, isCoarse) {
  const read = reader(await bytesOf(packed));
  const corners = undoCorners(read(3 * packed.faces, 3));
  const points = undoDifferences(read(3 * packed.vertices, 2), 3);
  const within = undoDifferences(read(packed.faces, 2), 1);
  const gaps = read(packed.faces, 2);
  const scale = frame.size > 0 ? packed.size / frame.size / 65535 : 0;
  const shift = packed.lo.map((lo, i) => (frame.size > 0 ? (lo - frame.lo[i]) / frame.size : 0));
  const positions = new Float32Array(9 * packed.faces);
  const steps = new Float32Array(9 * packed.faces);
  for (let corner = 0; corner < 3 * packed.faces; ++corner) {
    for (let axis = 0; axis < 3; ++axis) {
      positions[3 * corner + axis] = points[3 * corners[corner] + axis] * scale + shift[axis];
    }
    const face = Math.floor(corner / 3);
    steps[3 * corner] = within[face];
    steps[3 * corner + 1] = within[face] - gaps[face];
    steps[3 * corner + 2] = isCoarse(within[face], within[face] - gaps[face]) ? 1 : 0;
  }
  return { positions, steps };
}
