import { expect, test } from "vitest";
import { Clock } from "../../src/app/transport";

test("time goes on where it was after an hour in a hidden tab, where no animation frame comes", () => {
  const clock = new Clock();
  clock.playing = true;
  clock.advance(0.016);
  clock.advance(3600);
  expect(clock.time).toBeLessThan(0.5);
});

test("time stands while paused, and stays within its range", () => {
  const clock = new Clock();
  clock.advance(1);
  expect(clock.time).toBe(0);
  clock.seek(1e12);
  expect(clock.time).toBe(1e9);
  clock.seek(NaN);
  expect(clock.time).toBe(1e9);
});
