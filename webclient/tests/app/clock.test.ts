import { expect, test } from "vitest";
import { Clock } from "../../src/app/transport";

test("time runs as fast as is asked for, and goes on where it was after an hour in a hidden tab, where no animation frame comes", () => {
  const clock = new Clock();
  clock.playing = true;
  clock.setSpeed(4);
  clock.advance(0.1);
  expect(clock.time).toBeCloseTo(0.4);
  clock.advance(3600);
  expect(clock.time).toBeLessThan(2.1);
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
