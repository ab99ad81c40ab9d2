// The view: one mesh in the colours of its distances, drawn to scale when something changed.
import { BufferAttribute, BufferGeometry, DataTexture, DoubleSide, Mesh, OrthographicCamera, Points, Raycaster, Scene, ShaderMaterial, Sphere,
  Vector2, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { shareOf } from './palette.js';

const VERTEX = `
attribute vec2 look;
flat varying float flags;
varying float share;
varying vec3 place;
uniform float pointSize;
void main() {
  gl_PointSize = pointSize;
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  place = seen.xyz;
  share = look.x;
  flags = look.y;
  gl_Position = projectionMatrix * seen;
}`;
// The colours, the light and the stripes of pictures (host/show/raster.cpp, light.h). The tolerance is a part of the bar, from low to high.
const FRAGMENT = `
uniform sampler2D colours;
uniform float from, to, low, high, bands, stripe, pointSize, reach;
flat varying float flags;
varying float share;
varying vec3 place;
vec3 at(int i) { return texelFetch(colours, ivec2(i, 0), 0).rgb; }
vec3 between(int first, int count, float share) {
  float t = clamp(share, 0.0, 1.0) * float(count - 1);
  int i = min(int(t), count - 2);
  return mix(at(first + i), at(first + i + 1), t - float(i));
}
vec3 barColour(float share) {
  if (share < 0.0) return at(28);
  if (share > 1.0) return at(29);
  float x = bands > 0.0 ? (min(floor(share * bands), bands - 1.0) + 0.5) / bands : share;
  if (x < low) return between(0, 6, x / low);
  if (x > high) return between(22, 6, (x - high) / max(1.0 - high, 1e-6));
  return between(6, 16, to > from ? (x - from) / (to - from) : 0.0);
}
float lightOnFace() {
  vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
  vec3 towards = normalize(vec3(-0.32, 0.42, 0.85));
  float lit = min((1.0 + dot(normal, towards) * sign(normal.z)) / (1.0 + towards.z), 1.0);
  return 0.6 + 0.4 * lit * lit;
}
float lightOnPoint() {
  vec2 off = 2.0 * gl_PointCoord - 1.0;
  float r = dot(off, off);
  if (r > 1.0) discard;
  return (1.0 - 0.3 * r * r) * (0.78 + 0.22 * clamp((place.z + 2.0 * reach) / reach / 2.0 + 1.0, 0.0, 1.0));
}
void main() {
  int flag = int(flags + 0.5);
  vec3 colour = (flag & 4) != 0 ? at(31) : (flag & 2) != 0 ? at(30) : barColour(share);
  colour *= pointSize > 0.0 ? lightOnPoint() : lightOnFace();
  bool isStripe = fract((gl_FragCoord.x - gl_FragCoord.y) / (2.0 * stripe)) < 0.42;
  if ((flag & 1) != 0 && isStripe) colour = vec3(0.29, 0.25, 0.20);
  gl_FragColor = vec4(colour, 1.0);
}`;

const CORNER = [0.72, -1, 0.85];  // with z up, as the picture has it (host/show/camera.cpp)
const FLIGHT_MS = 500;
const NEAR_ZOOM = 2.4;  // of a place that is looked at

/// Asked before three.js is, which would complain in the console.
export function hasWebGL() {
  try {
    const context = document.createElement('canvas').getContext('webgl2');
    if (!context) return false;
    context.getExtension('WEBGL_lose_context')?.loseContext();
    return true;
  } catch {
    return false;
  }
}

export class View {
  /// `up`: "y" or "z", the axis that points up.
  constructor(canvas, up, onDrawn) {
    this.canvas = canvas;
    this.onDrawn = onDrawn;
    this.isYUp = up === 'y';
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.scene = new Scene();
    this.camera = new OrthographicCamera(-1, 1, 1, -1, 0, 100);
    this.camera.up.set(0, this.isYUp ? 1 : 0, this.isYUp ? 0 : 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => this.draw());
    this.controls.addEventListener('start', () => (this.flight = null));
    this.material = new ShaderMaterial({
      vertexShader: VERTEX, fragmentShader: FRAGMENT, side: DoubleSide,
      uniforms: { colours: { value: null }, from: { value: 0 }, to: { value: 1 }, low: { value: 0 }, high: { value: 1 }, bands: { value: 0 },
        stripe: { value: 4 * this.renderer.getPixelRatio() }, pointSize: { value: 0 }, reach: { value: 1 } },
    });
    this.mesh = new Mesh(new BufferGeometry(), this.material);
    this.points = new Points(new BufferGeometry(), this.material);
    for (const shown of [this.mesh, this.points]) {
      shown.frustumCulled = shown.visible = false;
      this.scene.add(shown);
    }
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    canvas.addEventListener('keydown', (event) => this.key(event));
    this.resize();
  }

  /// `scale`: the colours of the mesh's distances.
  setMesh({ positions, distances, flags, spacing }, scale) {
    const stride = spacing > 0 ? 3 : 1;  // the corners of a point are one
    const count = distances.length / stride;
    const places = spacing > 0 ? new Float32Array(3 * count) : positions;
    const looks = new Float32Array(2 * count);
    for (let i = 0; i < count; ++i) {
      if (spacing > 0) places.set(positions.subarray(9 * i, 9 * i + 3), 3 * i);
      looks[2 * i] = Math.min(Math.max(shareOf(scale, distances[stride * i]), -8), 8);
      looks[2 * i + 1] = flags[Math.floor((stride * i) / 3)];
    }
    this.spacing = spacing;
    this.shown = spacing > 0 ? this.points : this.mesh;
    this.mesh.visible = !(this.points.visible = spacing > 0);
    this.setColours(scale);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(places, 3));
    geometry.setAttribute('look', new BufferAttribute(looks, 2));
    geometry.computeBoundingBox();
    const ball = geometry.boundingBox.getBoundingSphere(new Sphere());
    this.ball = { centre: ball.center, radius: ball.radius || 0.5 };
    geometry.boundingSphere = ball;
    this.shown.geometry.dispose();
    this.shown.geometry = geometry;
    this.material.uniforms.reach.value = this.ball.radius;
    this.camera.near = 0;
    this.camera.far = this.ball.radius * 8;
    this.controls.minZoom = 0.2;
    this.controls.maxZoom = 1000;
    this.resize();
  }

  setColours(scale) {
    const colours = [...scale.colours, ...scale.outside];
    const bytes = new Uint8Array(4 * colours.length);
    colours.forEach((c, i) => bytes.set([...c, 255], 4 * i));
    const { uniforms } = this.material;
    uniforms.colours.value?.dispose();
    uniforms.colours.value = new DataTexture(bytes, colours.length, 1);
    uniforms.colours.value.needsUpdate = true;
    for (const name of ['from', 'to', 'bands']) uniforms[name].value = scale[name];
  }

  /// Colours what is below or above these shares of the bar as beyond the tolerance.
  setTolerance(low, high) {
    this.material.uniforms.low.value = low;
    this.material.uniforms.high.value = high;
    this.draw();
  }

  /// The direction from the mesh to the viewer of "corner", "+x" and so on.
  direction(name) {
    if (name === 'corner') return this.isYUp ? new Vector3(CORNER[0], CORNER[2], -CORNER[1]) : new Vector3(...CORNER);
    const way = new Vector3();
    way[name[1]] = name[0] === '+' ? 1 : -1;
    if (name[1] === (this.isYUp ? 'y' : 'z')) way[this.isYUp ? 'z' : 'y'] = this.isYUp ? 1e-4 : -1e-4;  // not along the axis that is up
    return way;
  }

  look(name, isAtOnce) {
    this.fly(this.ball.centre.clone(), this.direction(name), this.fittingZoom(this.direction(name)), isAtOnce);
  }

  /// Looks at a point of the mesh from outside, along its normal where it has one.
  show(point, normal) {
    const at = new Vector3(...point);
    const from = new Vector3(...normal);
    if (from.lengthSq() === 0) from.subVectors(at, this.ball.centre);
    if (from.lengthSq() === 0) from.copy(this.direction('corner'));
    from.normalize().addScaledVector(this.direction('corner').normalize(), 0.5);
    this.fly(at, from, NEAR_ZOOM);
  }

  // The zoom at which the mesh's box just fits, seen from a direction; 1 shows its ball.
  fittingZoom(direction) {
    const back = direction.clone().normalize();
    const right = new Vector3().crossVectors(this.camera.up, back).normalize();
    const up = new Vector3().crossVectors(back, right);
    const { min, max } = this.shown.geometry.boundingBox;
    const half = new Vector3().subVectors(max, min).multiplyScalar(0.5);
    const extent = (axis) => Math.abs(axis.x) * half.x + Math.abs(axis.y) * half.y + Math.abs(axis.z) * half.z;
    const { right: wide, top: high } = this.camera;
    return 0.86 / Math.max(extent(right) / wide, extent(up) / high, 1e-9);
  }

  fly(target, direction, zoom, isAtOnce) {
    const distance = 3 * this.ball.radius;
    const from = { target: this.controls.target.clone(), zoom: this.camera.zoom,
      way: this.camera.position.clone().sub(this.controls.target).normalize() };
    const to = direction.clone().normalize();
    const flight = (this.flight = {});
    const calm = isAtOnce || window.matchMedia('(prefers-reduced-motion: reduce)').matches;
    const start = performance.now();
    const move = (now) => {
      if (this.flight !== flight) return;
      const t = calm ? 1 : Math.min(Math.max((now - start) / FLIGHT_MS, 0), 1);
      const eased = t * t * (3 - 2 * t);
      this.controls.target.lerpVectors(from.target, target, eased);
      const way = from.way.clone().lerp(to, eased);
      if (way.lengthSq() < 1e-6 || t === 1) way.copy(to);
      this.camera.position.copy(this.controls.target).add(way.setLength(distance));
      this.camera.zoom = from.zoom * (zoom / from.zoom) ** eased;
      this.camera.updateProjectionMatrix();
      this.controls.update();
      this.draw();
      if (t < 1) requestAnimationFrame(move);
    };
    move(start);
  }

  key(event) {
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const nearer = { '+': 1 / 0.85, '=': 1 / 0.85, '-': 0.85 }[event.key];
    const turn = turns[event.key];
    if (!turn && !nearer) return;
    event.preventDefault();
    this.flight = null;
    const offset = this.camera.position.clone().sub(this.controls.target);
    if (nearer) this.camera.zoom *= nearer;
    if (turn) {
      const right = new Vector3().crossVectors(this.camera.up, offset).normalize();
      offset.applyAxisAngle(this.camera.up, turn[0] * 0.12).applyAxisAngle(right, turn[1] * 0.12);
    }
    this.camera.position.copy(this.controls.target).add(offset);
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  /// Where a point is in the canvas, in CSS pixels.
  pixel(point) {
    const p = new Vector3(...point).project(this.camera);
    return [((p.x + 1) / 2) * this.canvas.clientWidth, ((1 - p.y) / 2) * this.canvas.clientHeight];
  }

  /// {face, point} under a pixel of the canvas; null beside the mesh.
  hit(x, y) {
    if (!this.ball) return null;
    const at = new Vector2((2 * x) / this.canvas.clientWidth - 1, 1 - (2 * y) / this.canvas.clientHeight);
    const ray = new Raycaster();
    ray.setFromCamera(at, this.camera);
    ray.params.Points.threshold = (this.discSize() / 2) * this.unitsPerPixel();
    const [first] = ray.intersectObject(this.shown);
    if (!first) return null;
    if (!this.spacing) return { face: first.faceIndex, point: first.point.toArray() };
    return { face: first.index, point: [...this.shown.geometry.attributes.position.array.subarray(3 * first.index, 3 * first.index + 3)] };
  }

  /// The diameter of a point's disc in CSS pixels, as pictures have it (host/show/camera.h).
  discSize() {
    return this.spacing > 0 ? Math.min(Math.max((1.8 * this.spacing) / this.unitsPerPixel(), 1.4), 24) : 0;
  }

  /// The units of the mesh that a CSS pixel is wide.
  unitsPerPixel() {
    return (this.camera.right - this.camera.left) / this.camera.zoom / this.canvas.clientWidth;
  }

  /// The directions of x, y and z on the screen: right, up, and towards the viewer.
  axes() {
    const inverse = this.camera.quaternion.clone().invert();
    return [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => new Vector3(...axis).applyQuaternion(inverse).toArray());
  }

  setFrame(width, height) {
    const radius = this.ball?.radius ?? 1;
    const [wide, high] = [Math.max(width / height, 1), Math.max(height / width, 1)];
    Object.assign(this.camera, { left: -radius * wide, right: radius * wide, top: radius * high, bottom: -radius * high });
    this.camera.updateProjectionMatrix();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height) return;
    this.renderer.setSize(width, height, false);
    this.setFrame(width, height);
    this.draw();
  }

  /// A canvas of a mesh from its corner, in a size of its own.
  copy(width, height) {
    this.renderer.setSize(width, height, false);
    this.setFrame(width, height);
    this.look('corner', true);
    this.drawNow();
    const copy = document.createElement('canvas');
    copy.width = this.canvas.width;
    copy.height = this.canvas.height;
    copy.getContext('2d').drawImage(this.canvas, 0, 0);
    return copy;
  }

  draw() {
    if (this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => this.drawNow());
  }

  drawNow() {
    this.isWaiting = false;
    if (!this.material.uniforms.colours.value || !this.ball) return;
    this.camera.updateMatrixWorld();
    this.material.uniforms.pointSize.value = this.discSize() * this.renderer.getPixelRatio();
    this.renderer.render(this.scene, this.camera);
    this.onDrawn?.();
  }
}
