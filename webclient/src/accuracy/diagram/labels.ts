/** Places of labels in a diagram: beside their mark, over the fewest other marks and over no other label. */

type Spot = { id: string; x: number; y: number };
type Label = Spot & { text: string; anchor: "start" | "middle" | "end" };

/** Width of a letter, px. */
const LETTER = 6.4;

const OFFSETS: readonly [number, number, Label["anchor"]][] = [
  [11, 4, "start"],
  [-11, 4, "end"],
  [0, -12, "middle"],
  [0, 21, "middle"],
  [9, -9, "start"],
  [9, 17, "start"],
  [-9, -9, "end"],
  [-9, 17, "end"],
];

type Box = [left: number, top: number, right: number, bottom: number];

export function placeLabels(named: readonly (Spot & { text: string })[], all: readonly Spot[], width: number, height: number): Label[] {
  const placed: Box[] = [];
  return named.map(({ id, x, y, text }) => {
    const length = LETTER * text.length;
    const candidates = OFFSETS.map(([dx, dy, anchor]) => {
      const left = x + dx - { start: 0, middle: length / 2, end: length }[anchor];
      const box: Box = [left, y + dy - 11, left + length, y + dy + 3];
      const outside = box[0] < 4 || box[2] > width - 2 || box[1] < 4 || box[3] > height - 24;
      const crossed = placed.filter((b) => box[0] < b[2] && b[0] < box[2] && box[1] < b[3] && b[1] < box[3]).length;
      const covered = all.filter((m) => m.id !== id && m.x > box[0] - 5 && m.x < box[2] + 5 && m.y > box[1] - 5 && m.y < box[3] + 5).length;
      return { label: { id, text, anchor, x: x + dx, y: y + dy }, box, penalty: (outside ? 100 : 0) + 20 * crossed + covered };
    });
    const best = candidates.reduce((a, b) => (b.penalty < a.penalty ? b : a));
    placed.push(best.box);
    return best.label;
  });
}
