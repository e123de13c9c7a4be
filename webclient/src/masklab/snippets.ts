/** Code that samples a mask as it must be sampled: linear data, 16 bits, nearest, repeating. */

export interface Snippet {
  name: string;
  /** File to download for it. */
  file: string;
  /** Whether a test of this project runs it. */
  tested: boolean;
  note: string;
  code: string;
}

const THREE = (url: string, size: number) => `import { DataTexture, FloatType, GLSL3, NearestFilter, RawShaderMaterial, RedFormat, RepeatWrapping } from "three";

const MASK = ${JSON.stringify(url)};
const SIZE = ${size};

// One threshold a texel, as float32: WebGL2 has no 16-bit normalised format, and 8 bits would band.
export async function loadMask() {
  const values = new Uint16Array(await (await fetch(MASK)).arrayBuffer());
  const thresholds = Float32Array.from(values, (value) => (value + 0.5) / 65536);
  const texture = new DataTexture(thresholds, SIZE, SIZE, RedFormat, FloatType);
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.generateMipmaps = false;
  texture.needsUpdate = true;
  return texture;
}

// u_tiles: how often the mask repeats over the surface.
export function foamMaterial(mask, saturation = 0.25, tiles = 1) {
  return new RawShaderMaterial({
    glslVersion: GLSL3,
    uniforms: { u_mask: { value: mask }, u_saturation: { value: saturation }, u_tiles: { value: tiles } },
    vertexShader: \`
      in vec3 position;
      in vec2 uv;
      uniform mat4 modelViewMatrix, projectionMatrix;
      out vec2 v_uv;
      void main() {
        v_uv = uv;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }\`,
    fragmentShader: \`
      precision highp float;
      uniform highp sampler2D u_mask;
      uniform float u_saturation, u_tiles;
      in vec2 v_uv;
      out vec4 o_color;
      void main() {
        float foam = u_saturation > texture(u_mask, v_uv * u_tiles).r ? 1.0 : 0.0;
        o_color = vec4(vec3(foam), 1.0);
      }\`,
  });
}
`;

const GODOT = `// Godot 4, spatial shader. Image.load of the 16-bit PNG keeps 8 bits only, so load the raw file:
//   var data := FileAccess.get_file_as_bytes("res://mask.u16")
//   var floats := PackedFloat32Array()
//   for i in data.size() / 2: floats.append((data.decode_u16(2 * i) + 0.5) / 65536.0)
//   var side := int(sqrt(floats.size()))
//   var image := Image.create_from_data(side, side, false, Image.FORMAT_RF, floats.to_byte_array())
//   material.set_shader_parameter("mask", ImageTexture.create_from_image(image))
shader_type spatial;
uniform sampler2D mask : filter_nearest, repeat_enable; // no source_color: thresholds are data
uniform float saturation : hint_range(0.0, 1.0) = 0.25;
uniform float tiles = 8.0;

void fragment() {
    float foam = saturation > texture(mask, UV * tiles).r ? 1.0 : 0.0;
    ALBEDO = vec3(foam);
}
`;

const UNITY = (size: number) => `// Unity. Load the raw file once:
//   var texture = new Texture2D(${size}, ${size}, TextureFormat.R16, false, true); // linear, no mipmaps
//   texture.filterMode = FilterMode.Point;
//   texture.wrapMode = TextureWrapMode.Repeat;
//   texture.LoadRawTextureData(File.ReadAllBytes(path));
//   texture.Apply(false, true);
// HLSL, in the shader:
Texture2D _Mask;
SamplerState sampler_Mask; // the texture's own: point, repeat
float _Saturation, _Tiles;

float Foam(float2 uv)
{
    // A normalised texel is v / 65535; its threshold is (v + 0.5) / 65536.
    float threshold = (_Mask.Sample(sampler_Mask, uv * _Tiles).r * 65535.0 + 0.5) / 65536.0;
    return _Saturation > threshold ? 1.0 : 0.0;
}
`;

const UNREAL = `// Unreal Engine: import the 16-bit PNG as a texture with
//   Compression: Grayscale (G16) · sRGB: off · Filter: Nearest · Mip Gen: NoMipmaps · Tiling: Wrap
// Then a Custom node, output CMOT Float 1, inputs Mask (Texture Object), UV, Saturation, Tiles:
float threshold = (Texture2DSample(Mask, MaskSampler, UV * Tiles).r * 65535.0 + 0.5) / 65536.0;
return Saturation > threshold ? 1.0 : 0.0;
`;

const GLSL = (size: number) => `// GLSL 3.30 and later. The raw file as GL_R16: glTexImage2D(GL_TEXTURE_2D, 0, GL_R16, ${size}, ${size}, 0, GL_RED,
// GL_UNSIGNED_SHORT, data) with GL_NEAREST and GL_REPEAT. GLSL ES 3.00: GL_R32F with thresholds as float32.
uniform sampler2D u_mask;

// saturation: 0 to 1; at: texels.
float foam(float saturation, vec2 at) {
    ivec2 texel = ivec2(floor(at)) & ${size - 1};
    float threshold = (texelFetch(u_mask, texel, 0).r * 65535.0 + 0.5) / 65536.0;
    return saturation > threshold ? 1.0 : 0.0;
}
`;

/** `url`: of the raw mask; `size`: its side, texels. */
export function snippets(url: string, size: number): Snippet[] {
  const untested = { tested: false, note: "Written for the engine's published interface; not run here." };
  return [
    { name: "three.js", file: "data.u16", tested: true, note: "Run in this project's tests, with three.js 0.187.", code: THREE(url, size) },
    { name: "Godot", file: "data.u16", ...untested, code: GODOT },
    { name: "Unity", file: "data.u16", ...untested, code: UNITY(size) },
    { name: "Unreal", file: "data.png", ...untested, code: UNREAL },
    { name: "GLSL", file: "data.u16", tested: false, note: "Plain GLSL; not run here.", code: GLSL(size) },
  ];
}

/** Every form in which the server gives a mask. */
export const FORMATS = [
  { resource: "data.png", title: "16-bit PNG", note: "floor(rank 65536 / N)" },
  { resource: "data.u16", title: "raw", note: "uint16, little-endian" },
  { resource: "data.npy", title: "NumPy", note: "float32 (rank + 0.5) / N" },
  { resource: "data.dds", title: "DDS", note: "R16_UNORM" },
  { resource: "data8.png", title: "8-bit PNG", note: "for quick use" },
  { resource: "sidecar", title: "JSON", note: "parameters, hash, spectrum" },
] as const;
