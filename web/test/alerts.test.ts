import { describe, expect, it } from 'vitest';
import { AlertList } from '../src/alerts/alert_list';
import { id_of, reported_until } from '../src/alerts/alerts';
import type { Notice } from '../src/state/notices';
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

describe('Alerts', () => {
  it('are listed up to the shown time; alerts older than all notices are always listed', () => {
    const notice = (seq: number, t_s: number) => ({ stream: 's', seq, t_s }) as Notice;
    const known = { stream: 's', notices: [notice(9, 30), notice(4, 12)] };
    const all = [alert('s:9'), alert('s:4'), alert('former:7')];
    expect(reported_until(all, null, known)).toEqual(all);
    expect(reported_until(all, 20, known).map(({ id }) => id)).toEqual(['s:4', 'former:7']);
    expect(reported_until(all, 5, known).map(({ id }) => id)).toEqual(['former:7']);
  });

  it('are open until the server reports an acknowledgement', async () => {
    const { list } = server_of([alert('s:2'), alert('s:1', 'Bob')]);
    await list.refresh();
    expect(list.open.map(({ id }) => id)).toEqual(['s:2']);
    await list.acknowledge(list.open, 'Ada');
    expect(list.open).toEqual([]);
    expect(list.of('s:2')?.acknowledged?.who).toBe('Ada');
    expect(list.of('s:1')?.acknowledged?.who).toBe('Bob');
  });

  it('are requested once for alerts that arrive together', async () => {
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

  it('use the id that the server derives from their event', () => {
    expect(id_of({ stream: 's', seq: 7 })).toBe('s:7');
  });
});
