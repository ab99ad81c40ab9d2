// The view: one mesh, flat colours by face, drawn when something changed.
import { BufferAttribute, BufferGeometry, Color, DataTexture, DoubleSide, Mesh, PerspectiveCamera, Scene, ShaderMaterial, Sphere, Vector3,
  WebGLRenderer } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

const VERTEX = `
attribute vec2 steps;
flat varying vec2 faceSteps;
varying vec3 place;
void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  place = seen.xyz;
  faceSteps = steps;
  gl_Position = projectionMatrix * seen;
}`;
// A face is proven within the tolerance from its first step on, and beyond it before its second.
const FRAGMENT = `
uniform sampler2D colours;
uniform float tolerance;
uniform float stripe;
uniform bool distanceOnly;
uniform vec3 beyondColour;
flat varying vec2 faceSteps;
varying vec3 place;
void main() {
  vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
  float light = 0.5 + 0.5 * abs(dot(normal, normalize(place)));
  vec3 colour = texelFetch(colours, ivec2(int(faceSteps.x + 0.5), 0), 0).rgb;
  if (!distanceOnly && tolerance < faceSteps.y) {
    colour = beyondColour;
  } else if (!distanceOnly && tolerance < faceSteps.x) {
    colour = fract((gl_FragCoord.x + gl_FragCoord.y) / (2.0 * stripe)) < 0.5 ? vec3(1.0) : vec3(0.23, 0.26, 0.32);
  }
  gl_FragColor = vec4(colour * light, 1.0);
}`;

const START = new Vector3(0.55, 0.4, 1).normalize();
const FLIGHT_MS = 500;

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
  constructor(canvas, onDrawn) {
    this.canvas = canvas;
    this.onDrawn = onDrawn;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(28, 1, 0.001, 100);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => this.draw());
    this.controls.addEventListener('start', () => (this.flight = null));
    this.material = new ShaderMaterial({
      vertexShader: VERTEX, fragmentShader: FRAGMENT, side: DoubleSide,
      uniforms: { colours: { value: null }, tolerance: { value: 0 }, stripe: { value: 5 * this.renderer.getPixelRatio() },
        distanceOnly: { value: false }, beyondColour: { value: new Color().setRGB(0.839, 0.141, 0.431) } },
    });
    this.mesh = new Mesh(new BufferGeometry(), this.material);
    this.mesh.frustumCulled = false;
    this.scene.add(this.mesh);
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    canvas.addEventListener('keydown', (event) => this.key(event));
    this.resize();
  }

  setMesh({ positions, steps }) {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    geometry.setAttribute('steps', new BufferAttribute(steps, 2));
    geometry.computeBoundingBox();
    const ball = geometry.boundingBox.getBoundingSphere(new Sphere());
    this.ball = { centre: ball.center, radius: ball.radius || 0.5 };
    this.mesh.geometry.dispose();
    this.mesh.geometry = geometry;
    this.camera.near = this.ball.radius / 500;
    this.camera.far = this.ball.radius * 40;
    this.controls.maxDistance = this.ball.radius * 20;
    this.controls.minDistance = this.ball.radius / 100;
    this.draw();
  }

  /// One [red, green, blue] for each step, and one for faces within none.
  setColours(colours) {
    const bytes = new Uint8Array(4 * colours.length);
    colours.forEach((c, i) => bytes.set([...c, 255], 4 * i));
    this.material.uniforms.colours.value?.dispose();
    this.material.uniforms.colours.value = new DataTexture(bytes, colours.length, 1);
    this.material.uniforms.colours.value.needsUpdate = true;
    this.draw();
  }

  set(uniform, value) {
    this.material.uniforms[uniform].value = value;
    this.draw();
  }

  fitDistance() {
    const half = (this.camera.fov * Math.PI) / 360;
    const narrow = Math.min(1, this.camera.aspect);
    return (0.95 * this.ball.radius) / Math.sin(Math.atan(Math.tan(half) * narrow));
  }

  reset(isAtOnce) {
    this.fly(this.ball.centre.clone(), START.clone().multiplyScalar(this.fitDistance()), isAtOnce);
  }

  /// Looks at a point of the mesh from outside, along its normal where it has one.
  show(point, normal) {
    const at = new Vector3(...point);
    const from = new Vector3(...normal);
    if (from.lengthSq() === 0) from.subVectors(at, this.ball.centre);
    if (from.lengthSq() === 0) from.copy(START);
    if (Math.abs(from.y) > 0.98 * from.length()) from.z += 0.2 * from.length();
    this.fly(at, from.normalize().multiplyScalar(0.42 * this.fitDistance()));
  }

  fly(target, offset, isAtOnce) {
    const from = { target: this.controls.target.clone(), offset: this.camera.position.clone().sub(this.controls.target) };
    const flight = (this.flight = {});
    const calm = isAtOnce || window.matchMedia('(prefers-reduced-motion: reduce)').matches;
    const start = performance.now();
    const move = (now) => {
      if (this.flight !== flight) return;
      const t = calm ? 1 : Math.min(Math.max((now - start) / FLIGHT_MS, 0), 1);
      const eased = t * t * (3 - 2 * t);
      const length = from.offset.length() * (1 - eased) + offset.length() * eased;
      this.controls.target.lerpVectors(from.target, target, eased);
      const way = from.offset.clone().normalize().lerp(offset.clone().normalize(), eased);
      if (way.lengthSq() < 1e-6) way.copy(offset);
      this.camera.position.copy(this.controls.target).add(way.setLength(length));
      this.controls.update();
      this.draw();
      if (t < 1) requestAnimationFrame(move);
    };
    move(start);
  }

  key(event) {
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const nearer = { '+': 0.85, '=': 0.85, '-': 1 / 0.85 }[event.key];
    const turn = turns[event.key];
    if (!turn && !nearer) return;
    event.preventDefault();
    this.flight = null;
    const offset = this.camera.position.clone().sub(this.controls.target);
    if (nearer) offset.multiplyScalar(nearer);
    if (turn) {
      const right = new Vector3().crossVectors(this.camera.up, offset).normalize();
      offset.applyAxisAngle(this.camera.up, turn[0] * 0.12).applyAxisAngle(right, turn[1] * 0.12);
    }
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.draw();
  }

  /// Where a point is in the canvas, in CSS pixels; null behind the camera.
  pixel(point) {
    const p = new Vector3(...point).project(this.camera);
    if (p.z > 1) return null;
    return [((p.x + 1) / 2) * this.canvas.clientWidth, ((1 - p.y) / 2) * this.canvas.clientHeight];
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /// A canvas of the view as it stands, in a size of its own.
  copy(width, height) {
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.drawNow();
    const copy = document.createElement('canvas');
    copy.width = this.canvas.width;
    copy.height = this.canvas.height;
    copy.getContext('2d').drawImage(this.canvas, 0, 0);
    this.resize();
    return copy;
  }

  draw() {
    if (this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => this.drawNow());
  }

  drawNow() {
    this.isWaiting = false;
    if (!this.material.uniforms.colours.value) return;
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.scene, this.camera);
    this.onDrawn?.();
  }
}
