import { describe, expect, it } from 'vitest';
import type { Forecast } from '../src/server/messages';
import { follow_timeline } from '../src/server/follow_timeline';
import type { Store } from '../src/state/store';

const kForecast = { now_s: 1, horizon_steps: 6, arms: [] } as unknown as Forecast;
const settled = () => new Promise((done) => setTimeout(done));

function page() {
  const told: (Forecast | null)[] = [];
  const store = { link: { status: 'open' }, set_forecast: (forecast: Forecast | null) => told.push(forecast) };
  const state = { asked: 0, visible: true, ok: true, cleared: 0, next: null as (() => void) | null };
  const api = {
    timeline: () => {
      state.asked += 1;
      return Promise.resolve(state.ok ? { ok: true as const, value: kForecast } : { ok: false as const, problem: { type: '', title: 'no', status: 503 } });
    },
  };
  const timers = { set: (callback: () => void) => { state.next = callback; return 1; }, clear: () => { state.cleared += 1; state.next = null; } };
  const off = follow_timeline(api as never, store as unknown as Store, timers, () => state.visible);
  return { told, store, state, off, wait: async () => { state.next?.(); await settled(); } };
}

describe('follow_timeline', () => {
  it('polls repeatedly, one request after the other', async () => {
    const { told, state, wait } = page();
    expect(state.next).toBeNull();  // no poll is planned before the answer arrives
    await settled();
    await wait();
    expect([state.asked, told]).toEqual([2, [kForecast, kForecast]]);
  });

  it('does not poll while the page is hidden', async () => {
    const { state, wait } = page();
    await settled();
    state.visible = false;
    await wait();
    expect(state.asked).toBe(1);
    state.visible = true;
    await wait();
    expect(state.asked).toBe(2);
  });

  it('clears the forecast without a connection or an answer', async () => {
    const { told, store, state, wait } = page();
    await settled();
    store.link.status = 'lost';
    await wait();
    expect([state.asked, told.at(-1)]).toEqual([1, null]);
    store.link.status = 'open';
    state.ok = false;
    await wait();
    expect([state.asked, told.at(-1)]).toEqual([2, null]);
  });

  it('drops late answers after it has ended', async () => {
    const { told, state, off } = page();
    off();
    await settled();
    expect([told, state.next]).toEqual([[], null]);
    const other = page();
    await settled();
    other.off();
    expect(other.state.cleared).toBe(1);
  });
});
