import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { Fence } from '../src/view/fence';

/** Returns a graphics card whose commands complete when the test says so. */
function card() {
  const state = { done: false, open: 0 };
  const gl = {
    SYNC_GPU_COMMANDS_COMPLETE: 1, SYNC_STATUS: 2, SIGNALED: 3, flush: () => undefined,
    fenceSync: () => { state.open += 1; return {}; },
    deleteSync: () => { state.open -= 1; },
    getSyncParameter: () => (state.done ? 3 : 0),
  };
  return { state, fence: new Fence(gl as unknown as WebGL2RenderingContext) };
}

describe('Fence', () => {
  beforeEach(() => {
    vi.useFakeTimers();
    vi.stubGlobal('window', globalThis);
  });
  afterEach(() => {
    vi.useRealTimers();
    vi.unstubAllGlobals();
  });

  it('reports the drawing time once, after drawing', () => {
    const { state, fence } = card();
    const told: number[] = [];
    fence.put(performance.now() - 5, (took_ms) => told.push(took_ms));
    vi.advanceTimersByTime(60);
    expect([told, fence.is_up]).toEqual([[], true]);
    state.done = true;
    vi.advanceTimersByTime(60);
    expect(told).toHaveLength(1);
    expect(told[0]).toBeGreaterThanOrEqual(65);
    expect(told[0]).toBeLessThan(70);
    expect([fence.is_up, state.open]).toEqual([false, 0]);
  });

  it('gives up after a time limit', () => {
    const { state, fence } = card();
    const told: number[] = [];
    fence.put(performance.now(), (took_ms) => told.push(took_ms));
    vi.advanceTimersByTime(9_900);
    expect(fence.is_up).toBe(true);
    vi.advanceTimersByTime(200);
    expect([fence.is_up, told.length, state.open]).toEqual([false, 1, 0]);
  });

  it('reports nothing after the view is closed', () => {
    const { state, fence } = card();
    const told: number[] = [];
    fence.put(performance.now(), (took_ms) => told.push(took_ms));
    fence.close();
    state.done = true;
    vi.advanceTimersByTime(20_000);
    expect(told).toEqual([]);
  });
});
