import { describe, expect, it } from 'vitest';
import { stacked, within_room } from '../src/view/stacking';

const at = (x: number, y: number, width_px = 80) => ({ x, y, width_px });

describe('Labels close to each other', () => {
  it('are stacked from left to right; others stay', () => {
    expect(stacked([at(100, 50), at(110, 55), at(400, 52), at(120, 60)], 22, 4)).toEqual([50, 72, 52, 94]);
  });

  // Finds a y whose sum with 22 is rounded down, so that the sum is less than 22 away from y. The
  // sum is above 256, where floating-point numbers are coarser.
  it('are placed in finite time despite rounding', () => {
    const rounded = Array.from({ length: 20_000 }, (_, i) => 234 + i * 0.0011).find((y) => y + 22 - y < 22);
    expect(rounded).toBeDefined();
    const y = rounded ?? 0;
    expect(stacked([at(100, y), at(101, y + 1)], 22, 4)).toEqual([y, y + 22]);
  });

  it('are placed in finite time for any eight positions', () => {
    let seed = 7;
    const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
    for (let run = 0; run < 2000; run++) {
      const labels = Array.from({ length: 8 }, () => at(40 * random(), 500 * random()));
      const y = stacked(labels, 22, 4).sort((a, b) => a - b);
      for (let i = 1; i < y.length; i++) expect((y[i] ?? 0) - (y[i - 1] ?? 0)).toBeGreaterThan(22 - 1e-9);
    }
  });

  it('are placed in finite time if one has no position', () => {
    expect(stacked([at(NaN, NaN), at(0, 0), at(0, Infinity)], 22, 4)).toHaveLength(3);
  });
});

describe('Labels in a view', () => {
  const room = { width_px: 400, height_px: 300 };
  const label = (x: number, y: number, must = true) => ({ ...at(x, y), must });
  const places = (labels: ReturnType<typeof label>[]) => within_room(labels, stacked(labels, 22, 4), room, 22, 30);

  it('stay inside', () => {
    expect(places([label(10, -5), label(395, 299)])).toEqual([{ x: 40, y: 0 }, { x: 360, y: 278 }]);
  });

  it('are hidden if they would seem to belong to others, unless required', () => {
    const crowd = [label(100, 100, false), label(101, 101, false), label(102, 102, false), label(103, 103)];
    expect(places(crowd).map((place) => place?.y ?? null)).toEqual([100, 122, null, 166]);
  });
});
