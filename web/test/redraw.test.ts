import { describe, expect, it } from 'vitest';
import { Redraw } from '../src/state/redraw';

/** Simulates a page whose drawing takes `took_ms` and whose state changes every millisecond. */
function drawn_in(second_ms: number, took_ms: number): { drawings: number; busy_ms: number } {
  let now_ms = 0;
  let drawings = 0;
  let pending: { at_ms: number; run: () => void }[] = [];
  const redraw = new Redraw(() => { drawings += 1; now_ms += took_ms; }, {
    set: (run, delay_ms) => pending.push({ at_ms: now_ms + delay_ms, run }), clear: () => undefined,
  }, () => now_ms);
  while (now_ms < second_ms) {
    redraw.ask();
    const due = pending.filter(({ at_ms }) => at_ms <= now_ms);
    pending = pending.filter(({ at_ms }) => at_ms > now_ms);
    for (const { run } of due) run();
    now_ms += 1;
  }
  return { drawings, busy_ms: drawings * took_ms };
}

describe('Redraw', () => {
  it('happens once for a burst of changes', () => {
    expect(drawn_in(1000, 0).drawings).toBeLessThanOrEqual(33);
    expect(drawn_in(1000, 0).drawings).toBeGreaterThan(25);
  });

  it('takes at most half of the time, whatever its duration', () => {
    for (const took_ms of [20, 60, 200]) {
      const { drawings, busy_ms } = drawn_in(10_000, took_ms);
      expect(busy_ms).toBeLessThan(5_500);
      expect(drawings).toBeGreaterThan(10);
    }
  });

  it('never pauses for long', () => {
    expect(drawn_in(60_000, 3000).drawings).toBeGreaterThan(15);
  });
});
