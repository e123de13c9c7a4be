/** Power of planes by frequency. */

type Numbers = readonly [re: Float64Array, im: Float64Array]; // Complex numbers

const zeros = (length: number): Numbers => [new Float64Array(length), new Float64Array(length)];

/** The transform of every line of a plane, of `length` numbers; lines and columns change places. */
function transformed([fromRe, fromIm]: Numbers, length: number): Numbers {
  const lines = fromRe.length / length;
  const cosines = Float64Array.from({ length }, (_, i) => Math.cos((2 * Math.PI * i) / length));
  const sines = Float64Array.from({ length }, (_, i) => -Math.sin((2 * Math.PI * i) / length));
  const [re, im] = zeros(length);
  const [toRe, toIm] = zeros(fromRe.length);
  // By halves while a count is even (Cooley and Tukey), else by the definition: sides are of any length.
  const transform = (at: number, stride: number, start: number, count: number): void => {
    if (count % 2 === 1) {
      for (let k = 0; k < count; k++) define(at, stride, start + k, k, count);
      return;
    }
    const half = count / 2;
    transform(at, 2 * stride, start, half);
    transform(at + stride, 2 * stride, start + half, half);
    for (let a = start, b = start + half, turn = 0; a < start + half; a++, b++, turn += stride) {
      const x = (re[b] ?? 0) * (cosines[turn] ?? 0) - (im[b] ?? 0) * (sines[turn] ?? 0);
      const y = (re[b] ?? 0) * (sines[turn] ?? 0) + (im[b] ?? 0) * (cosines[turn] ?? 0);
      re[b] = (re[a] ?? 0) - x;
      im[b] = (im[a] ?? 0) - y;
      re[a] = (re[a] ?? 0) + x;
      im[a] = (im[a] ?? 0) + y;
    }
  };
  const define = (at: number, stride: number, to: number, k: number, count: number): void => {
    re[to] = im[to] = 0;
    for (let i = 0, turn = 0; i < count; i++, turn = (turn + k * stride) % length) {
      const [x, y] = [fromRe[at + i * stride] ?? 0, fromIm[at + i * stride] ?? 0];
      re[to] = (re[to] ?? 0) + x * (cosines[turn] ?? 0) - y * (sines[turn] ?? 0);
      im[to] = (im[to] ?? 0) + x * (sines[turn] ?? 0) + y * (cosines[turn] ?? 0);
    }
  };
  for (let line = 0; line < lines; line++) {
    transform(line * length, 1, 0, length);
    for (let k = 0; k < length; k++) {
      toRe[k * lines + line] = re[k] ?? 0;
      toIm[k * lines + line] = im[k] ?? 0;
    }
  }
  return [toRe, toIm];
}

/** |DFT|² / N² of real values, (height, width): it sums to the mean square (Parseval). */
function planePower(values: Float64Array, width: number): Float64Array {
  const [re, im] = transformed(transformed([values, new Float64Array(values.length)], width), values.length / width);
  return re.map((x, i) => (x * x + (im[i] ?? 0) ** 2) / values.length ** 2);
}

/**
 * Mean power of rings of frequencies, each as wide as a bin of the shorter side; the mean of the values, at the frequency 0, is in
 * none. `weight`: of the bin in a column and row.
 */
export function ringPower(values: Float64Array, width: number, rings: number, weight: (x: number, y: number) => number = () => 1): number[] {
  const height = values.length / width;
  const side = Math.min(width, height);
  const [sums, weights] = zeros(rings + 1);
  planePower(values, width).forEach((power, i) => {
    const [x, y] = [i % width, Math.floor(i / width)];
    const ring = Math.round(side * Math.hypot(Math.min(x, width - x) / width, Math.min(y, height - y) / height));
    if (ring > rings) return;
    sums[ring] = (sums[ring] ?? 0) + weight(x, y) * power;
    weights[ring] = (weights[ring] ?? 0) + weight(x, y);
  });
  return Array.from(sums.subarray(1), (sum, i) => sum / (weights[i + 1] ?? 1));
}
