import { describe, expect, it } from 'vitest';
import { from_now, Pulse } from '../src/state/pulse';

function watched() {
  let now_ms = 0;
  const pulse = new Pulse(() => now_ms);
  const told = { changes: 0, frames: 0, beats: 0 };
  const off = (['changes', 'frames', 'beats'] as const).map((what) => from_now(pulse[what], () => { told[what] += 1; }));
  return { pulse, told, off, at: (ms: number) => { now_ms = ms; } };
}

describe('Pulse', () => {
  it('calls a listener for later changes only', () => {
    const { told } = watched();
    expect(told).toEqual({ changes: 0, frames: 0, beats: 0 });
  });

  it('beats a few times per second, however often poses arrive', () => {
    const { pulse, told, at } = watched();
    for (let ms = 0; ms <= 1600; ms += 16) {
      at(ms);
      pulse.frame();
    }
    expect(told.frames).toBe(101);
    expect(told.beats).toBe(11);
  });

  it('reports many changes as one, with a pose', () => {
    const { pulse, told } = watched();
    pulse.at_once(() => {
      for (let i = 0; i < 100; i++) pulse.change();
      expect(pulse.is_quiet).toBe(true);
      expect(told.changes).toBe(0);
    });
    expect(pulse.is_quiet).toBe(false);
    expect(told).toEqual({ changes: 1, frames: 1, beats: 1 });
  });

  it('does not call removed listeners', () => {
    const { pulse, told, off } = watched();
    off.forEach((end) => end());
    pulse.change();
    pulse.frame();
    expect(told).toEqual({ changes: 0, frames: 0, beats: 0 });
  });
});
