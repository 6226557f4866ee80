import { describe, expect, it } from 'vitest';
import { parse_address } from '../src/route/address';
import { parse_message } from '../src/server/messages';
import { instant_of, pose_at, why_unheard } from '../src/state/instant';
import { Store } from '../src/state/store';
import { envelope, frame, kStream, snapshot } from './samples';

describe('Shown time', () => {
  let now_ms = 0;
  const store = new Store(() => now_ms);
  const take = (text: string) => {
    const parsed = parse_message(text);
    if (parsed.kind === 'message') store.take(parsed.message);
  };
  const hear = (from_s: number, to_s: number) => {
    for (let t_s = from_s; t_s <= to_s; t_s += 0.5) {
      now_ms += 500;
      take(frame(t_s, { left_panda_joint1: t_s }));
    }
  };
  const at = (hash: string) => {
    const instant = instant_of(parse_address(hash), store);
    return [instant.kind === 'unheard' ? instant.why : instant.kind, pose_at(instant, store)?.['left_panda_joint1'] ?? null];
  };

  it('has the recorded pose and no other', () => {
    expect(at('#/?t=3')).toEqual(['nothing', null]);
    take(snapshot(1));
    hear(10, 20);
    expect(at('#/')).toEqual(['now', 20]);
    expect(at('#/?t=12.5')).toEqual(['kept', 12.5]);
    expect(at('#/job/a?t=3')).toEqual(['before', null]);
    expect(at('#/?t=300')).toEqual(['after', null]);
    expect(why_unheard('before', store)).toMatch(/begins at 0:00:10.0/);
  });

  it('has no pose while the connection or frames were lost', () => {
    store.set_link({ status: 'lost', attempt: 1, retry_in_ms: 250 });
    take(envelope('queue', 2, { stopped: false, queued: [], backlog: [], scheduled: [], running: [] }));
    hear(24, 26);
    expect(at('#/?t=22')).toEqual(['gap', null]);
    expect(at('#/?t=24')).toEqual(['kept', 24]);
    now_ms += 4000;
    hear(30, 31);
    expect(at('#/?t=28')).toEqual(['gap', null]);
    now_ms += 4000;  // the page was busy: it receives all frames, late
    take(frame(31.1, { left_panda_joint1: 31.1 }));
    expect(at('#/?t=31.05')).toEqual(['kept', 31]);
  });

  it('has no pose in another session', () => {
    expect(at(`#/?t=24&run=${kStream.slice(0, 8)}`)).toEqual(['kept', 24]);
    expect(at('#/?t=24&run=7997886f')).toEqual(['other-run', null]);
    take(snapshot(1, {}, { stream: '7997886f-351f-4aa0-babd-42ad4e6d6ef7' }));
    expect(at(`#/?t=24&run=${kStream.slice(0, 8)}`)).toEqual(['other-run', null]);
    expect(store.events.every(({ stream }) => stream === store.stream)).toBe(true);
  });
});
