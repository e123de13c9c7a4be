/**
 * Uniform rules of a frame plan: constants, camera, and sums of time and place that are reduced in float64 before a
 * shader sees them as float32. docs/architecture.md traces one of them from the API to GLSL.
 */
const TURN = 2 * Math.PI;

const modulo = (x, period) => {
  const rest = x % period;
  if (rest >= 0) return rest;
  return rest + period >= period ? 0 : rest + period;
};

/** To [-π, π]. */
const phase = (x) => {
  const rest = x % TURN;
  return rest > Math.PI ? rest - TURN : rest < -Math.PI ? rest + TURN : rest;
};

/** Right, up and forward: yaw from −z toward +x, then pitch, then roll; rad. */
export function axes({ yaw, pitch, roll }) {
  const [cy, sy, cp, sp] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
  const [cr, sr] = [Math.cos(roll), Math.sin(roll)];
  const [right, up] = [[cy, 0, sy], [-sy * sp, cp, cy * sp]];
  return {
    right: right.map((r, i) => cr * r + sr * up[i]),
    up: up.map((u, i) => cr * u - sr * right[i]),
    forward: [sy * cp, sp, -cy * cp],
  };
}

function ofCamera({ what, top }, { camera, width, height }) {
  const { position: [, y], fov } = camera;
  const q = Math.tan(fov / 2);
  const aspect = width / height;
  const { right, up, forward } = axes(camera);
  const scaled = (vector, factor) => vector.map((c) => c * factor);
  if (what === "eye_height") return [y];
  if (what === "ray_x") return scaled(right, q * aspect);
  if (what === "ray_y") return scaled(up, q);
  if (what === "ray_z") return forward;
  // Projection times view, the far plane at infinity.
  const near = Math.max(0.02, 0.5 * (y - top));
  const rows = [
    [...scaled(right, 1 / (q * aspect)), (-right[1] * y) / (q * aspect)],
    [...scaled(up, 1 / q), (-up[1] * y) / q],
    [...forward, -forward[1] * y - 2 * near],
    [...forward, -forward[1] * y],
  ];
  return [0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column]));
}

/** Numbers of one rule. `frame`: time, camera, width, height, target (its width and height). */
export function evaluate(rule, frame) {
  const [x, , z] = frame.camera.position;
  const sum = () => rule.offset + (rule.rate ?? 0) * frame.time + (rule.k[0] * x + rule.k[1] * z);
  switch (rule.rule) {
    case "constant":
      return rule.value;
    case "phase":
      return [phase(sum())];
    case "wrap":
      return [modulo(sum(), rule.period)];
    case "loop":
      return [modulo(frame.time - (rule.step ? modulo(frame.time, rule.step) : 0) + rule.offset, rule.period)];
    case "clamp":
      return [Math.min(Math.max(sum(), rule.low), rule.high)];
    case "camera":
      return ofCamera(rule, frame);
    case "viewport": {
      const { width, height } = rule.of === "picture" ? frame : frame.target;
      return [rule.times * width, rule.times * height];
    }
    default:
      throw new Error(`Unknown rule ${rule.rule}.`);
  }
}
