/**
 * FLIP for pictures of low dynamic range: the difference that an observer sees when two pictures alternate, 0 to 1.
 * Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild 2020, "FLIP: A Difference Evaluator for Alternating Images",
 * with 67 pixels a degree, as the server measures it.
 */

const PIXELS_PER_DEGREE = 67;
/** Contrast sensitivity of the channels Y, Cx and Cz: sums of Gaussians a √(π/b) exp(−π² x²/b), x in degrees. */
const SENSITIVITY: readonly (readonly (readonly [a: number, b: number])[])[] = [
  [[1, 0.0047]],
  [[1, 0.0053]],
  [[34.1, 0.04], [13.5, 0.025]],
];
/** From the widest of these Gaussians, three deviations. */
const SENSITIVITY_RADIUS = Math.ceil(3 * Math.sqrt(0.04 / (2 * Math.PI ** 2)) * PIXELS_PER_DEGREE);
const FEATURE_WIDTH = 0.082; // Width of detected edges and points, degrees
const FEATURE_DEVIATION = 0.5 * FEATURE_WIDTH * PIXELS_PER_DEGREE;
const FEATURE_RADIUS = Math.ceil(3 * FEATURE_DEVIATION);
/** Exponents of colour and feature differences; the share of the greatest difference that maps to 0.95. */
const COLOUR_EXPONENT = 0.7;
const FEATURE_EXPONENT = 0.5;
const KNEE = 0.4;
const KNEE_ERROR = 0.95;

/** Linear RGB to XYZ, and the white of D65 that it implies. */
const TO_XYZ = [
  [10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794],
  [2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897],
  [1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382],
] as const;
const WHITE = TO_XYZ.map(([r, g, b]) => r + g + b) as [number, number, number];
const FROM_XYZ = inverse(TO_XYZ);

/** The greatest difference of colours, green against blue. */
const GREATEST = hyab(hunt([0, 1, 0]), hunt([0, 0, 1])) ** COLOUR_EXPONENT;

type Triple = [number, number, number];
type Plane = Float64Array;
type Planes = [Plane, Plane, Plane];

/** Of one picture. */
interface Analysis {
  lab: Planes; // Hunt-adjusted L*a*b* of the filtered picture
  /** Magnitudes of its edges and points. */
  edges: Plane;
  points: Plane;
}

/** Compares pictures with one reference; both sRGB in [0, 1], three values a pixel. */
export class Flip {
  private readonly reference: Analysis;

  constructor(reference: Float64Array, private readonly width: number, private readonly height: number) {
    this.reference = analyse(reference, width, height);
  }

  /** The mean over all pixels. */
  mean(picture: Float64Array): number {
    const a = this.reference;
    const b = analyse(picture, this.width, this.height);
    let sum = 0;
    for (let i = 0; i < a.edges.length; i++) {
      const lab = (one: Analysis) => at(one.lab, i);
      const colour = redistribute(hyab(lab(a), lab(b)) ** COLOUR_EXPONENT);
      const edge = Math.abs((a.edges[i] ?? 0) - (b.edges[i] ?? 0));
      const point = Math.abs((a.points[i] ?? 0) - (b.points[i] ?? 0));
      const feature = Math.min(1, Math.max(edge, point) / Math.SQRT2) ** FEATURE_EXPONENT;
      sum += colour ** (1 - feature);
    }
    return sum / a.edges.length;
  }
}

const at = ([a, b, c]: Planes, i: number): Triple => [a[i] ?? 0, b[i] ?? 0, c[i] ?? 0];
const put = (planes: Planes, i: number, values: Triple) => planes.forEach((plane, c) => (plane[i] = values[c] ?? 0));

function analyse(picture: Float64Array, width: number, height: number): Analysis {
  const count = width * height;
  const opponent: Planes = [new Float64Array(count), new Float64Array(count), new Float64Array(count)];
  for (let i = 0; i < count; i++) {
    const [x, y, z] = relative([linear(picture[3 * i] ?? 0), linear(picture[3 * i + 1] ?? 0), linear(picture[3 * i + 2] ?? 0)]);
    put(opponent, i, [116 * y - 16, 500 * (x - y), 200 * (y - z)]);
  }
  const grey = opponent[0].map((y) => (y + 16) / 116);
  const [edges, points] = [features(grey, width, height, edgeKernel()), features(grey, width, height, pointKernel())];
  const filtered = opponent.map((plane, c) => contrastFilter(plane, width, height, SENSITIVITY[c] ?? [])) as Planes;
  for (let i = 0; i < count; i++) put(filtered, i, hunt(fromOpponent(at(filtered, i))));
  return { lab: filtered, edges, points };
}

/** The plane under a sum of Gaussians, each separable; their weights sum to 1. */
function contrastFilter(plane: Plane, width: number, height: number, gaussians: readonly (readonly [number, number])[]): Plane {
  const kernels = gaussians.map(([a, b]) => {
    const taps = kernel(SENSITIVITY_RADIUS, (x) => Math.exp((-(Math.PI ** 2) * (x / PIXELS_PER_DEGREE) ** 2) / b));
    const sum = taps.reduce((total, tap) => total + tap, 0);
    return { taps: taps.map((tap) => tap / sum), weight: a * Math.sqrt(Math.PI / b) * sum * sum };
  });
  const total = kernels.reduce((sum, { weight }) => sum + weight, 0);
  return kernels.reduce((result, { taps, weight }) => {
    const part = convolve(plane, width, height, taps, taps);
    return result.map((value, i) => value + (weight / total) * (part[i] ?? 0));
  }, new Float64Array(plane.length));
}

/** Magnitude of the responses along x and along y. */
function features(grey: Plane, width: number, height: number, along: Plane): Plane {
  const across = kernel(FEATURE_RADIUS, gaussian);
  const sum = across.reduce((total, tap) => total + tap, 0);
  const smooth = across.map((tap) => tap / sum);
  const x = convolve(grey, width, height, along, smooth);
  const y = convolve(grey, width, height, smooth, along);
  return x.map((value, i) => Math.hypot(value, y[i] ?? 0));
}

const gaussian = (x: number) => Math.exp((-x * x) / (2 * FEATURE_DEVIATION ** 2));
const edgeKernel = () => balanced(kernel(FEATURE_RADIUS, (x) => -x * gaussian(x)));
const pointKernel = () => balanced(kernel(FEATURE_RADIUS, (x) => ((x / FEATURE_DEVIATION) ** 2 - 1) * gaussian(x)));

const kernel = (radius: number, value: (x: number) => number): Plane => Float64Array.from({ length: 2 * radius + 1 }, (_, i) => value(i - radius));

/** Positive taps sum to 1, negative ones to −1. */
function balanced(taps: Plane): Plane {
  const sum = (sign: number) => taps.reduce((total, tap) => total + Math.max(0, sign * tap), 0);
  const [above, below] = [sum(1), sum(-1)];
  return taps.map((tap) => tap / (tap > 0 ? above : below));
}

/** Separable convolution as a correlation; beyond the border, the border's values. */
function convolve(plane: Plane, width: number, height: number, alongX: Plane, alongY: Plane): Plane {
  return pass(pass(plane, width, height, alongX, 1), width, height, alongY, width);
}

/** Along rows (`stride` 1) or along columns (`stride` the width). */
function pass(plane: Plane, width: number, height: number, taps: Plane, stride: number): Plane {
  const radius = (taps.length - 1) / 2;
  const [length, lines, step] = stride === 1 ? [width, height, width] : [height, width, 1];
  const result = new Float64Array(plane.length);
  const padded = new Float64Array(length + 2 * radius);
  for (let line = 0; line < lines; line++) {
    for (let i = 0; i < padded.length; i++) {
      const at = Math.min(length - 1, Math.max(0, i - radius));
      padded[i] = plane[line * step + at * stride] ?? 0;
    }
    for (let i = 0; i < length; i++) {
      let sum = 0;
      for (let t = 0; t < taps.length; t++) sum += (taps[t] ?? 0) * (padded[i + t] ?? 0);
      result[line * step + i * stride] = sum;
    }
  }
  return result;
}

/** Colour differences to [0, 1]: linear up to the knee, compressed above. */
function redistribute(power: number): number {
  const knee = KNEE * GREATEST;
  return power < knee ? (KNEE_ERROR / knee) * power : KNEE_ERROR + ((power - knee) / (GREATEST - knee)) * (1 - KNEE_ERROR);
}

/** Distance of Abasi, Tehran and Fairchild: city-block in lightness, Euclidean in colour. */
function hyab(a: Triple, b: Triple): number {
  return Math.abs(a[0] - b[0]) + Math.hypot(a[1] - b[1], a[2] - b[2]);
}

/** L*a*b* of linear RGB; colours are weaker where it is dark (Hunt). */
function hunt(rgb: Triple): Triple {
  const [x, y, z] = relative(rgb);
  const [fx, fy, fz] = [cubeRoot(x), cubeRoot(y), cubeRoot(z)];
  const lightness = 116 * fy - 16;
  return [lightness, 0.01 * lightness * 500 * (fx - fy), 0.01 * lightness * 200 * (fy - fz)];
}

function cubeRoot(t: number): number {
  const delta = 6 / 29;
  return t > delta ** 3 ? Math.cbrt(t) : t / (3 * delta * delta) + 4 / 29;
}

/** XYZ relative to white. */
function relative(rgb: Triple): Triple {
  const [x, y, z] = multiply(TO_XYZ, rgb);
  return [x / WHITE[0], y / WHITE[1], z / WHITE[2]];
}

/** Linear RGB in [0, 1]. */
function fromOpponent([first, cx, cz]: Triple): Triple {
  const y = (first + 16) / 116;
  const [r, g, b] = multiply(FROM_XYZ, [WHITE[0] * (y + cx / 500), WHITE[1] * y, WHITE[2] * (y - cz / 200)]);
  return [unit(r), unit(g), unit(b)];
}

const unit = (value: number) => Math.min(1, Math.max(0, value));

const linear = (value: number) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);

type Matrix = readonly [Readonly<Triple>, Readonly<Triple>, Readonly<Triple>];

function multiply([a, b, c]: Matrix, [x, y, z]: Triple): Triple {
  return [a[0] * x + a[1] * y + a[2] * z, b[0] * x + b[1] * y + b[2] * z, c[0] * x + c[1] * y + c[2] * z];
}

/** By cofactors. */
function inverse([[a, b, c], [d, e, f], [g, h, i]]: Matrix): Matrix {
  const determinant = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
  const row = (...values: Triple) => values.map((value) => value / determinant) as Triple;
  return [row(e * i - f * h, c * h - b * i, b * f - c * e), row(f * g - d * i, a * i - c * g, c * d - a * f), row(d * h - e * g, b * g - a * h, a * e - b * d)];
}
