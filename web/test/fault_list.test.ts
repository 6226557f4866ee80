import { describe, expect, it } from 'vitest';
import { FaultList } from '../src/frame/fault_list';
import { Api } from '../src/server/api';
import type { Fault } from '../src/server/messages';

const fault = (id: string, over: Partial<Fault> = {}): Fault => ({ id, arm: 'left', kind: 'stall', at_s: null, for_s: null, value: 0, ...over });

/** A server that keeps faults. It refuses to list them if the status `refuses` is not null. */
function server(faults: Fault[], refuses: number | null = null) {
  const answer = (status: number, value: unknown) => new Response(status === 204 ? null : JSON.stringify(value), { status });
  const asked: string[] = [];
  const api = new Api('', (url, { method, body } = {}) => {
    asked.push(`${method} ${url}`);
    const id = url.split('/').at(3) ?? '';
    if (method === 'GET') return Promise.resolve(refuses === null ? answer(200, { faults }) : answer(refuses, {}));
    if (method === 'POST') return Promise.resolve(answer(201, faults[faults.push(fault(String(faults.length + 1), JSON.parse(String(body)) as Partial<Fault>)) - 1]));
    const found = faults.findIndex((known) => known.id === id);
    if (found >= 0) faults.splice(found, 1);
    return Promise.resolve(answer(found < 0 ? 404 : 204, {}));
  });
  return { asked, list: new FaultList(api), ids: (list: FaultList) => list.all.map(({ id }) => id) };
}

describe('Fault list', () => {
  it('has the faults of other clients, until they end', async () => {
    const faults = [fault('1'), fault('2', { kind: 'noise', value: 0.01 })];
    const { list, ids } = server(faults);
    await list.refresh();
    expect([ids(list), list.is_whole]).toEqual([['1', '2'], true]);
    await list.remove('1');
    expect(ids(list)).toEqual(['2']);
    await list.inject({ arm: 'right', kind: 'slow', value: 0.5 });
    expect(list.all.at(-1)).toMatchObject({ id: '2', arm: 'right', kind: 'slow', value: 0.5 });
    faults.length = 0;
    await list.refresh();
    expect(ids(list)).toEqual([]);
  });

  it.each([404, 405])('has only its own faults if the server cannot list them (%i)', async (status) => {
    const { asked, list, ids } = server([fault('1')], status);
    await list.refresh();
    expect([ids(list), list.is_whole]).toEqual([[], false]);
    await list.inject({ arm: 'left', kind: 'cut' });
    expect(ids(list)).toEqual(['2']);
    await list.remove('2');
    await list.remove('1');
    expect(ids(list)).toEqual([]);
    expect(asked.filter((request) => request.startsWith('GET'))).toHaveLength(1);
  });

  it('keeps the last list if the server fails to answer, and a fault that could not be removed', async () => {
    const list = new FaultList({
      faults: () => Promise.resolve({ ok: false, problem: { type: '', title: '', status: 0, detail: '' } }),
      inject: () => Promise.resolve({ ok: true, value: fault('7') }),
      remove_fault: () => Promise.resolve({ ok: false, problem: { type: '', title: '', status: 403, detail: '' } }),
    });
    await list.inject({ arm: 'left', kind: 'stall' });
    expect((await list.remove('7')).ok).toBe(false);
    expect([list.all, list.is_whole]).toEqual([[fault('7')], true]);
  });

  it('says where a list is wrong', async () => {
    const api = new Api('', () => Promise.resolve(new Response('{"faults": [{"id": 3}]}')));
    const answer = await api.faults();
    expect(!answer.ok && answer.problem).toMatchObject({ title: 'The list of faults cannot be read', detail: expect.stringMatching(/^\/faults\/0/) });
  });
});
