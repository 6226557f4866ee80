import { describe, expect, it } from 'vitest';
import { KeptList, length_s_of, title_of_recording } from '../src/recordings/kept_list';
import { Player } from '../src/recordings/player';
import { of_blob, of_server, texts_of, type Source } from '../src/recordings/sources';
import { Router } from '../src/route/router';
import type { KeptRecording } from '../src/server/messages';
import { parse_message } from '../src/server/messages';
import { Store } from '../src/state/store';
import { arm_json, envelope, snapshot } from './samples';

const go_on = () => new Promise((done) => setTimeout(done));

async function all_of(source: Source, stop = new AbortController().signal) {
  const [texts, told]: [string[], number[]] = [[], []];
  for await (const text of texts_of(source, stop, (bytes) => told.push(bytes))) texts.push(text);
  return { text: texts.join(''), told, longest: Math.max(...texts.map(({ length }) => length)) };
}

describe('Recording source', () => {
  it('is read in small pieces, split anywhere', async () => {
    const text = 'é'.repeat(100_001);  // two bytes for each character, so that pieces end within characters
    const { text: read, told, longest } = await all_of(of_blob(new Blob([text])));
    expect(read).toBe(text);
    expect(told.reduce((a, b) => a + b)).toBe(200_002);
    expect(longest).toBeLessThanOrEqual(1 << 16);
  });

  it('fails if the server refuses it or reading is canceled', async () => {
    const refused = of_server('/x', 1, () => Promise.resolve(new Response('gone', { status: 404, statusText: 'Not Found' })));
    await expect(all_of(refused)).rejects.toThrow(/404 Not Found/);
    const stop = new AbortController();
    let pulled = 0;
    const endless = of_server('/x', 1, () => Promise.resolve(new Response(new ReadableStream({ pull: (to) => { pulled += 1; if (pulled === 3) stop.abort(); to.enqueue(new Uint8Array(10)); } }))));
    await expect(all_of(endless, stop.signal)).rejects.toThrow(/abort/i);
    expect(pulled).toBeLessThan(9);
  });
});

function player() {
  const store = new Store(() => 0);
  const parsed = parse_message(snapshot(1));
  if (parsed.kind === 'message') store.take(parsed.message);
  const did: string[] = [];
  const router = new Router({ read: () => '', push: () => undefined, replace: () => undefined, on_change: () => undefined }, () => store.stream);
  return { store, did, router, player: new Player(store, { stop: () => did.push('stop'), begin_anew: () => did.push('anew') }, router) };
}
const text = (text: string) => of_blob(new Blob([text]));

describe('Player', () => {
  it('opens a recording of events only, and returns to the live cell', async () => {
    const { store, player: one, did, router } = player();
    await one.open_sources('run', { states: null, events: text([3, 8].map((seq) => envelope('arm', seq, arm_json('left'), { stream: 'x' })).join('\n')) });
    expect(one.opened.value).toMatchObject({ name: 'run', frames: 0, events: 2, first_s: 3, last_s: 8 });
    expect([one.fault.value, one.reading.value, store.link, router.address.value.t_s]).toEqual([null, null, { status: 'recording', name: 'run' }, 3]);
    one.close();
    expect([did, one.opened.value]).toEqual([['stop', 'anew'], null]);
  });

  it('says why a recording cannot be opened, and keeps the live cell', async () => {
    const { store, player: one, did } = player();
    const fault = async (states: string | null, events: string | null) => {
      await one.open_sources('run', { states: states === null ? null : text(states), events: events === null ? null : text(events) });
      return one.fault.value;
    };
    expect(await fault(null, null)).toMatch(/neither a states.csv nor an events.jsonl/);
    expect(await fault(null, '')).toMatch(/is empty/);
    expect(await fault('time_s,elbow\n0,1\n', '')).toMatch(/no joint elbow/);
    expect(await fault(null, envelope('arm', 1, arm_json('third')))).toMatch(/no arm third/);
    expect(await fault('hello\n', null)).toMatch(/hello/);
    await one.open_sources('run', { states: { bytes: 1, open: () => Promise.reject(new Error('cut')) }, events: null });
    expect(one.fault.value).toMatch(/cannot be read completely.*cut/);
    expect([did, store.link.status]).toEqual([[], 'connecting']);
  });

  it('reports progress and cancels on request', async () => {
    const { player: one } = player();
    let more: (text: string | null) => void = () => undefined;
    const stream = new ReadableStream<Uint8Array>({ start: (to) => { more = (text) => (text === null ? to.close() : to.enqueue(new TextEncoder().encode(text))); } });
    const opened = one.open_sources('run', { states: { bytes: 100, open: () => Promise.resolve(stream) }, events: null });
    more('x'.repeat(40));
    await go_on();
    expect(one.reading.value).toEqual({ name: 'run', bytes: 40, of_bytes: 100 });
    one.stop();
    expect(one.reading.value).toBeNull();
    more('y');
    await opened;
    expect([one.fault.value, one.opened.value]).toEqual([null, null]);
  });
});

describe('Recordings of the server', () => {
  const recording: KeptRecording = { name: 'data', begun_at: '2026-11-21T09:33:00.000Z', written_at: '2026-11-21T09:34:30.000Z', running: false, has_states: false, files: [{ name: 'events.jsonl', bytes: 7 }] };
  const kept = new KeptList({ recordings: () => Promise.resolve({ ok: true, value: { kept: true, recordings: [recording] } }), recording_address: (name, file) => `/at/${name}/${file}` });

  it('are listed on request, with their sources', async () => {
    expect(kept.list.value).toBeNull();
    await kept.look();
    expect(kept.list.value?.recordings).toEqual([recording]);
    expect(kept.sources_of(recording)).toEqual({ states: null, events: { bytes: 7, open: expect.any(Function) } });
    expect(kept.address_of(recording, 'cell.json')).toBe('/at/data/cell.json');
  });

  it('have a length and a title if their begin is known', () => {
    expect(length_s_of(recording)).toBe(90);
    expect(length_s_of({ ...recording, begun_at: null })).toBeNull();
    expect(title_of_recording({ ...recording, begun_at: null })).toBe('data');
    expect(title_of_recording(recording)).toMatch(/^2026-11-21 /);
  });
});
