// The ocean example of three.js with nothing but its water and its sky: the yardstick of `python -m bench --only yardstick`.
// Numbers are the example's (examples/webgl_shaders_ocean.html); its box, controls and panel are left out, and its file of
// normals, which the package does not bring, is made here.
import * as THREE from "three";
import { Sky } from "three/addons/objects/Sky.js";
import { Water } from "three/addons/objects/Water.js";

const MIRROR = 512;
const NORMALS = 1024;
const SECONDS = 1 / 60;

const renderer = new THREE.WebGLRenderer();
renderer.setPixelRatio(1);
renderer.setSize(window.innerWidth, window.innerHeight);
renderer.toneMapping = THREE.ACESFilmicToneMapping;
renderer.toneMappingExposure = 0.5;
document.body.appendChild(renderer.domElement);

const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(55, window.innerWidth / window.innerHeight, 1, 20000);
camera.position.set(30, 30, 100);
camera.lookAt(0, 10, 0);

const water = new Water(new THREE.PlaneGeometry(10000, 10000), {
  textureWidth: MIRROR,
  textureHeight: MIRROR,
  waterNormals: normals(NORMALS),
  sunDirection: new THREE.Vector3(),
  sunColor: 0xffffff,
  waterColor: 0x001e0f,
  distortionScale: 3.7,
});
water.rotation.x = -Math.PI / 2;
scene.add(water);

const sky = new Sky();
sky.scale.setScalar(10000);
scene.add(sky);
const air = sky.material.uniforms;
air.turbidity.value = 10;
air.rayleigh.value = 2;
air.mieCoefficient.value = 0.005;
air.mieDirectionalG.value = 0.8;
const sun = new THREE.Vector3().setFromSphericalCoords(1, THREE.MathUtils.degToRad(88), THREE.MathUtils.degToRad(180));
air.sunPosition.value.copy(sun);
water.material.uniforms.sunDirection.value.copy(sun).normalize();

const gl = renderer.getContext();
const pixel = new Uint8Array(4);

/** A tile of normals, side x side, that repeats: 64 sines of whole periods, 2 to 32 of them to a side. */
function normals(side) {
  const steep = 0.09;
  const slopes = new Float32Array(2 * side * side);
  let seed = 1;
  const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
  for (let i = 0; i < 64; ++i) {
    const k = 2 + 30 * random();
    const angle = 2 * Math.PI * random();
    const u = Math.round(k * Math.cos(angle));
    const v = Math.round(k * Math.sin(angle));
    const phase = 2 * Math.PI * random();
    const turn = (periods, place) => (2 * Math.PI * periods * place) / side;
    const along = Array.from({ length: side }, (_, x) => [Math.cos(turn(u, x) + phase), Math.sin(turn(u, x) + phase)]);
    for (let y = 0; y < side; ++y) {
      const [c, s] = [Math.cos(turn(v, y)), Math.sin(turn(v, y))];
      for (let x = 0; x < side; ++x) {
        const slope = (steep * (along[x][0] * c - along[x][1] * s)) / k;
        slopes[2 * (y * side + x)] += slope * u;
        slopes[2 * (y * side + x) + 1] += slope * v;
      }
    }
  }
  const bytes = new Uint8Array(4 * side * side);
  for (let i = 0; i < side * side; ++i) {
    const x = -slopes[2 * i];
    const y = -slopes[2 * i + 1];
    const scale = 127.5 / Math.hypot(x, y, 1);
    bytes.set([127.5 + scale * x, 127.5 + scale * y, 127.5 + scale, 255], 4 * i);
  }
  const texture = new THREE.DataTexture(bytes, side, side);
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.magFilter = THREE.LinearFilter;
  texture.minFilter = THREE.LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.needsUpdate = true;
  return texture;
}

function draw() {
  water.material.uniforms.time.value += SECONDS;
  renderer.render(scene, camera);
}

/** Draws so many frames one after the other; milliseconds of each, from the first call until a pixel of it has been read. */
function frames(count) {
  const taken = [];
  for (let i = 0; i < count; ++i) {
    const began = performance.now();
    draw();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    taken.push(performance.now() - began);
  }
  return taken;
}

/** Waits until what was drawn is on the screen and nothing is left to do. */
async function rest() {
  for (let i = 0; i < 3; ++i) {
    await new Promise((resolve) => requestAnimationFrame(resolve));
  }
}

/** The standard deviation of all values of a frame drawn now, levels: of an empty picture it is 0. */
function variety() {
  draw();
  const all = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
  gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, all);
  const colours = all.filter((_, i) => i % 4 < 3);
  const mean = colours.reduce((sum, value) => sum + value, 0) / colours.length;
  return Math.sqrt(colours.reduce((sum, value) => sum + (value - mean) ** 2, 0) / colours.length);
}

const debug = gl.getExtension("WEBGL_debug_renderer_info");
window.yardstick = {
  frames,
  rest,
  draw,
  variety,
  revision: THREE.REVISION,
  renderer: gl.getParameter(debug ? debug.UNMASKED_RENDERER_WEBGL : gl.RENDERER),
  width: gl.drawingBufferWidth,
  height: gl.drawingBufferHeight,
};
