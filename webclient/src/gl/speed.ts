/** Whether this browser draws at a processor's speed: measured with a small program before those of a plan are compiled. */
import { whenDone } from "./program";

/** Texels drawn along each side, and fetches for each of them: of these a GPU makes thousands of millions a second, a processor hundreds at most. */
const WORK = { size: 256, fetches: 192 };
const IMAGE_SIDE = 8;
/** A draw takes a small GPU some 12 ms with the wait for its fence; llvmpipe on two fast cores 32 ms or more, SwiftShader 70. */
const LONGEST = 20;
const DRAWS = 3; // What else the page does may delay one or the other
const ENOUGH = 200; // No further draw after this time, ms
/** The link and the first draw compile, which says nothing of the draws after it: some compilers of GPUs take longer than a processor's. */
const COMPILED = 2000;

const VERTEX = `#version 300 es
void main() {
  gl_Position = vec4(4.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0, 0.0, 1.0);
}`;
const FRAGMENT = `#version 300 es
precision highp float;
uniform sampler2D u_image;
out vec4 color;
void main() {
  vec2 at = gl_FragCoord.xy / ${WORK.size}.0;
  color = vec4(at, at);
  // No constant, and no derivatives below: a compiler that unrolls the loop would take longer than the draws.
  int fetches = ${WORK.fetches / IMAGE_SIDE} * textureSize(u_image, 0).x;
  // Each fetch lies where the one before it says, so none is left out.
  for (int i = 0; i < fetches; i++) color = 0.5 * color + textureLod(u_image, color.xy + at, 0.0);
}`;

/** Takes up to some 400 ms of the driver's time on a processor, some 10 on a GPU; nothing else may be drawn meanwhile. */
export async function drawsSlowly(gl: WebGL2RenderingContext): Promise<boolean> {
  const program = gl.createProgram();
  const shaders = ([[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]] as const).map(([type, text]) => {
    const shader = gl.createShader(type) as WebGLShader;
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    return shader;
  });
  gl.linkProgram(program);
  // Whatever asks for the program before it is linked waits for it.
  await whenDone(gl, COMPILED);
  const [image, target] = [IMAGE_SIDE, WORK.size].map((side) => {
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, side, side);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    return texture;
  }) as [WebGLTexture, WebGLTexture];
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target, 0);
  gl.activeTexture(gl.TEXTURE0);
  gl.bindTexture(gl.TEXTURE_2D, image);
  gl.useProgram(program);
  gl.viewport(0, 0, WORK.size, WORK.size);
  const drawn = async (timeout: number): Promise<number> => {
    const submitted = performance.now();
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    await whenDone(gl, timeout);
    return performance.now() - submitted;
  };
  let least = await drawn(COMPILED);
  const began = performance.now();
  for (let draw = 0; draw < DRAWS && least > LONGEST && performance.now() - began < ENOUGH; draw++) least = Math.min(least, await drawn(ENOUGH));
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  gl.useProgram(null);
  gl.bindTexture(gl.TEXTURE_2D, null);
  gl.deleteFramebuffer(framebuffer);
  for (const texture of [image, target]) gl.deleteTexture(texture);
  for (const shader of shaders) gl.deleteShader(shader);
  gl.deleteProgram(program);
  return least > LONGEST;
}
