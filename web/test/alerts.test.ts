import { describe, expect, it } from 'vitest';
import { AlertList } from '../src/alerts/alert_list';
import { id_of } from '../src/alerts/alerts';
import type { KeptAlert } from '../src/server/messages';

const alert = (id: string, who: string | null = null): KeptAlert => ({
  id, at: '2026-11-23T04:00:00Z', level: 'warning', text: 'stopped', acknowledged: who === null ? null : { who, at: '2026-11-23T04:01:00Z' },
});

function server_of(alerts: KeptAlert[]) {
  const timers: (() => void)[] = [];
  const api = {
    asked: 0,
    alerts: () => { api.asked += 1; return Promise.resolve({ ok: true as const, value: { alerts } }); },
    acknowledge: (ids: readonly string[], who: string) => {
      alerts = alerts.map((known) => (ids.includes(known.id) ? alert(known.id, who) : known));
      return Promise.resolve({ ok: true as const, value: null });
    },
  };
  const list = new AlertList(api, { set: (callback) => timers.push(callback), clear: () => undefined });
  return { api, timers, list };
}

describe('alerts', () => {
  it('are open until the server says that somebody has seen to them', async () => {
    const { list } = server_of([alert('s:2'), alert('s:1', 'Bob')]);
    await list.refresh();
    expect(list.open.map(({ id }) => id)).toEqual(['s:2']);
    await list.acknowledge(list.open, 'Ada');
    expect(list.open).toEqual([]);
    expect(list.of('s:2')?.acknowledged?.who).toBe('Ada');
    expect(list.of('s:1')?.acknowledged?.who).toBe('Bob');
  });

  it('that are told together are asked for once', async () => {
    const { api, timers, list } = server_of([alert('s:1')]);
    list.refresh_soon();
    list.refresh_soon();
    expect(timers).toHaveLength(1);
    timers[0]?.();
    await Promise.resolve();
    expect(api.asked).toBe(1);
    list.refresh_soon();
    expect(timers).toHaveLength(2);
  });

  it('have the name that the server gives to their event', () => {
    expect(id_of({ stream: 's', seq: 7 })).toBe('s:7');
  });
});
