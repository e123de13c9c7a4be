/**
 * Draws a Seafoam frame plan with three.js: each pass is a RawShaderMaterial with the plan's own GLSL, each target a
 * WebGLRenderTarget. It draws every plan whose passes fill their targets; boats and spray, which have meshes, are refused.
 */
import * as THREE from "three";
import { evaluate } from "./rules.js";

/** Array, format, type and channels of the plan's texture formats. */
const TEXTURES = {
  R8: [Uint8Array, THREE.RedFormat, THREE.UnsignedByteType, 1],
  R8UI: [Uint8Array, THREE.RedIntegerFormat, THREE.UnsignedByteType, 1],
  R16UI: [Uint16Array, THREE.RedIntegerFormat, THREE.UnsignedShortType, 1],
  RG32UI: [Uint32Array, THREE.RGIntegerFormat, THREE.UnsignedIntType, 2],
  R16F: [Uint16Array, THREE.RedFormat, THREE.HalfFloatType, 1],
  R32F: [Float32Array, THREE.RedFormat, THREE.FloatType, 1],
  RG32F: [Float32Array, THREE.RGFormat, THREE.FloatType, 2],
  RGBA16F: [Uint16Array, THREE.RGBAFormat, THREE.HalfFloatType, 4],
  RGBA32F: [Float32Array, THREE.RGBAFormat, THREE.FloatType, 4],
};
const FILTERS = { nearest: THREE.NearestFilter, linear: THREE.LinearFilter, linear_mipmap_linear: THREE.LinearMipmapLinearFilter };
const WRAPS = { repeat: THREE.RepeatWrapping, clamp_to_edge: THREE.ClampToEdgeWrapping };

const sampling = ({ filter, wrap }) => ({
  minFilter: FILTERS[filter],
  magFilter: filter === "nearest" ? THREE.NearestFilter : THREE.LinearFilter,
  wrapS: WRAPS[wrap],
  wrapT: WRAPS[wrap],
});

/** The bytes hold all levels, the finest first. */
async function loadTexture(spec, server) {
  const response = await fetch(new URL(`${spec.url.slice(1)}?sha256=${spec.sha256}`, server));
  const bytes = await response.arrayBuffer();
  const [Pixels, format, type, channels] = TEXTURES[spec.format];
  const mipmaps = [];
  for (let level = 0, offset = 0; level < spec.levels; level++) {
    const [width, height] = [spec.width, spec.height].map((side) => Math.max(1, side >> level));
    const data = new Pixels(bytes, offset, width * height * channels);
    mipmaps.push({ data, width, height });
    offset += data.byteLength;
  }
  const texture = new THREE.DataTexture(mipmaps[0].data, spec.width, spec.height, format, type);
  if (spec.levels > 1) texture.mipmaps = mipmaps;
  texture.internalFormat = spec.format;
  return Object.assign(texture, sampling(spec), { unpackAlignment: 1, needsUpdate: true });
}

function makeTarget(spec, width, height) {
  const { size } = spec;
  let sides = [size.width, size.height];
  if (size.rule === "viewport") {
    sides = [Math.ceil((width * size.scale) / (size.part * size.narrow)), Math.ceil((height * size.scale) / size.part)];
    if (size.odd) sides = sides.map((side) => Math.max(3, side | 1));
  }
  const [, format, type] = TEXTURES[spec.format];
  const generateMipmaps = spec.filter === "linear_mipmap_linear";
  const options = { format, type, internalFormat: spec.format, depthBuffer: spec.depth, generateMipmaps, ...sampling(spec) };
  return new THREE.WebGLRenderTarget(...sides, options);
}

function makeMaterial({ vertex, fragment }, { blend, depth, equal }, uniforms) {
  // three.js writes the version itself, and defines of its own after it.
  const glsl = ({ text }) => text.replace("#version 300 es\n", "");
  const blending = blend === "none" ? THREE.NoBlending : THREE.CustomBlending;
  return new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3,
    vertexShader: glsl(vertex),
    fragmentShader: glsl(fragment),
    uniforms,
    blending,
    blendSrc: THREE.OneFactor,
    blendDst: blend === "add" ? THREE.OneFactor : THREE.OneMinusSrcAlphaFactor,
    depthTest: depth,
    depthWrite: depth,
    depthFunc: equal ? THREE.EqualDepth : THREE.LessDepth,
    side: THREE.DoubleSide,
  });
}

export class Water {
  #passes = [];
  #targets = new Map();
  #started = false;
  #stepped = false; // whether setup passes hang on steps of time: then this example draws all of them in every frame
  #size = [0, 0];
  #scene = new THREE.Scene();
  #camera = new THREE.Camera();

  /**
   * Loads plan and textures. `renderer`: a WebGLRenderer; `server`: its address, with a slash at the end; the plan of a preset comes from
   * `api/plans/NAME` there.
   */
  static async load(renderer, plan, server) {
    const textures = new Map();
    for (const [name, spec] of Object.entries(plan.textures)) textures.set(name, await loadTexture(spec, server));
    return new Water(renderer, plan, textures);
  }

  constructor(renderer, plan, textures) {
    this.renderer = renderer;
    this.plan = plan;
    renderer.autoClear = false;
    plan.passes.forEach((pass) => {
      if (pass.eye !== "any" && !pass.eye.includes("over")) return;
      if (pass.mesh.rule !== "fullscreen") throw new Error(`${pass.name}: this example draws no meshes.`);
      const uniforms = {};
      const program = plan.programs[pass.program];
      for (const [name, uniform] of Object.entries({ ...plan.uniforms, ...pass.uniforms })) {
        // three.js takes a number for a float and a list for an array of one.
        const declared = new RegExp(`uniform float ${name};`);
        uniforms[name] = { value: null, uniform, single: declared.test(program.vertex.text + program.fragment.text) };
      }
      for (const name of Object.keys(pass.inputs)) uniforms[name] = { value: null };
      if (pass.when === "setup") this.#stepped ||= Object.values(pass.uniforms).some(({ rules }) => rules.some(({ step }) => step));
      const material = makeMaterial(program, pass.state, uniforms);
      const triangle = new THREE.BufferGeometry();
      // The vertex shader makes the three corners from gl_VertexID.
      triangle.setDrawRange(0, 3);
      const mesh = new THREE.Mesh(triangle, material);
      mesh.frustumCulled = false;
      this.#passes.push({ pass, material, mesh });
    });
    this.textures = textures;
  }

  /** Draws a frame on the renderer's canvas. `camera`: position, yaw, pitch, roll, fov, as in the API; time in s. */
  draw({ time, camera }) {
    const { width, height } = this.renderer.domElement;
    this.#resize(width, height);
    for (const entry of this.#passes) {
      if (entry.pass.when === "setup" && this.#started && !this.#stepped) continue;
      this.#draw(entry, { time, camera, width, height });
    }
    this.#started = true;
  }

  #resize(width, height) {
    if (this.#size[0] === width && this.#size[1] === height) return;
    for (const target of this.#targets.values()) target.dispose();
    for (const [name, spec] of Object.entries(this.plan.targets)) this.#targets.set(name, makeTarget(spec, width, height));
    this.#size = [width, height];
    this.#started = false;
  }

  #draw({ pass, material, mesh }, frame) {
    const { renderer } = this;
    const target = pass.target === "screen" ? null : this.#targets.get(pass.target);
    for (const entry of Object.values(material.uniforms)) {
      if (!entry.uniform) continue;
      const values = entry.uniform.rules.flatMap((rule) => evaluate(rule, { ...frame, target: target ?? frame }));
      entry.value = entry.single ? values[0] : values;
    }
    for (const [name, source] of Object.entries(pass.inputs)) {
      material.uniforms[name].value = "texture" in source ? this.textures.get(source.texture) : this.#targets.get(source.target).texture;
    }
    renderer.setRenderTarget(target);
    if (pass.state.clear) {
      renderer.setClearColor(0, 0);
      renderer.clear();
    }
    this.#scene.clear().add(mesh);
    renderer.render(this.#scene, this.#camera);
  }
}
