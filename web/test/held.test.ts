import { beforeEach, describe, expect, it } from 'vitest';
import { EventsReader } from '../src/recordings/read_events';
import { parse_message, type SequencedMessage } from '../src/server/messages';
import { events_until, state_after } from '../src/state/as_of';
import { folded } from '../src/state/snapshots';
import { Store } from '../src/state/store';
import { envelope, held_json, scene_json, snapshot } from './samples';

let store: Store;

function read(text: string): SequencedMessage {
  const parsed = parse_message(text);
  if (parsed.kind !== 'message') throw new Error(JSON.stringify(parsed));
  return parsed.message as SequencedMessage;
}
const take = (...texts: string[]) => { for (const text of texts) store.take(read(text)); };
const scene = (seq: number, objects: string[], held: Record<string, string>) => envelope('scene', seq, scene_json(objects, held));
/** Returns the place of each object: in the scene, or held by an arm. */
const places = (of: Store = store) => [
  ...of.objects.map(({ name }) => `${name} in the scene`), ...of.held.map(({ object, arm }) => `${object.name} held by ${arm}`),
].sort();
const at = (t_s: number) => state_after(events_until(t_s, null, store), store);

beforeEach(() => { store = new Store(() => 0); });

describe('Held objects', () => {
  it('follow the scene events: picked up, handed over, put down', () => {
    take(snapshot(1), scene(2, ['table', 'part'], {}), scene(3, ['table'], { part: 'left' }));
    expect(places()).toEqual(['part held by left', 'table in the scene']);
    expect([store.holds('left'), store.holds('right')]).toEqual([['part'], []]);
    take(scene(4, ['table'], { part: 'right' }));
    expect([store.holds('left'), store.holds('right')]).toEqual([[], ['part']]);
    take(scene(5, ['table', 'part'], {}));
    expect(places()).toEqual(['part in the scene', 'table in the scene']);
  });

  it('are shown with each arm that holds them', () => {
    const held = [{ ...held_json('part', 'left'), shared_with: [{ link: 'right_hand', arm: 'right' }] }];
    take(snapshot(1), envelope('scene', 2, { ...scene_json(['table'], {}), held }));
    expect([store.holds('left'), store.holds('right')]).toEqual([['part'], ['part']]);
  });

  it('are known at past times', () => {
    take(snapshot(1), scene(2, ['table', 'part'], {}), scene(5, ['table'], { part: 'left' }), scene(9, ['table', 'part'], {}));
    expect(places(at(3))).toEqual(['part in the scene', 'table in the scene']);
    expect(places(at(6))).toEqual(['part held by left', 'table in the scene']);
    expect(places(at(9))).toEqual(['part in the scene', 'table in the scene']);
    take(scene(10, ['table'], { part: 'left' }));
    expect(at(0.5).held, 'not known before the first data').toEqual([]);
  });

  it('are forgotten with the session', () => {
    take(snapshot(1), scene(2, ['table'], { part: 'left' }));
    take(snapshot(1, {}, { stream: '11111111-6f0e-4d55-9b1c-0d3a54c7a001' }));
    expect(store.held).toEqual([]);
    take(scene(2, ['table'], { part: 'left' }));
    store.forget_all();
    expect(store.held).toEqual([]);
  });

  it('are taken from a snapshot that has them', () => {
    const whole = folded([snapshot(1), scene(2, ['table'], { part: 'left' })].map(read));
    if (!whole) throw new Error('not folded');
    store.take(whole);
    expect(store.holds('left')).toEqual(['part']);
  });

  it('are absent in the scene events of old recordings, which are still read', () => {
    const { held: _, ...old } = scene_json(['table', 'crate'], {});
    const reader = new EventsReader();
    reader.take(envelope('scene', 2, old));
    const { messages, unread } = reader.end();
    expect(unread).toBe(0);
    take(snapshot(1));
    for (const message of messages) store.take(message);
    expect(places()).toEqual(['crate in the scene', 'table in the scene']);
  });

  it('must have a pose, a link and an arm', () => {
    const { link: _, ...wrong } = held_json('part', 'left');
    expect(parse_message(envelope('scene', 2, { ...scene_json([], {}), held: [wrong] })).kind).toBe('malformed');
  });
});
