import { describe, expect, it } from 'vitest';
import { write_mcap } from '../src/recordings/mcap';
import { EventsReader } from '../src/recordings/read_events';
import { read_mcap } from '../src/recordings/read_mcap';
import { parse_message } from '../src/server/messages';
import { Store } from '../src/state/store';
import { envelope, frame, job_json, snapshot } from './samples';

function heard(): Store {
  const store = new Store(() => 0);
  const job = { submitted_s: 9, started_s: 10 };
  for (const text of [
    snapshot(5), frame(6, { left_panda_joint1: 0.1, left_panda_joint2: -1.2 }), envelope('job', 10, job_json('a', { ...job, state: 'running' })),
    frame(12.5, { left_panda_joint1: 0.4, left_panda_joint2: -1 }), envelope('job', 20, job_json('a', { ...job, state: 'succeeded', ended_s: 20 })),
    envelope('alert', 21, { level: 'warning', text: 'Somebody stands there' }),
  ]) {
    const parsed = parse_message(text);
    if (parsed.kind === 'message') store.take(parsed.message);
  }
  return store;
}

function messages_in(text: string) {
  const reader = new EventsReader();
  reader.take(text);
  return reader.end().messages;
}

describe('Exported MCAP file', () => {
  it('is read back with positions at cell times and all events', async () => {
    const store = heard();
    const read = await read_mcap(new Blob([await write_mcap(store, () => undefined)]));
    if (!read.ok) throw new Error(read.fault);
    const { frames, events } = read.mcap;
    expect(frames.names).toEqual(['left_panda_joint1', 'left_panda_joint2']);
    expect(frames.t_s.map((t_s) => Number(t_s.toFixed(4)))).toEqual([6, 12.5]);
    expect(frames.q[1]).toEqual([expect.closeTo(0.4), expect.closeTo(-1)]);
    const again = new Store(() => 0);
    again.show_recording('it', messages_in(events), frames);
    expect(again.jobs('finished').map(({ id }) => id)).toEqual(['a']);
    expect(again.events.map(({ text }) => text)).toEqual(['Somebody stands there']);
    expect(again.log.entries).toEqual(store.log.entries);
    expect([again.trace.first_s, again.trace.last_s]).toEqual([expect.closeTo(6), expect.closeTo(12.5)]);
  });

  it('is refused if it is something else', async () => {
    expect(await read_mcap(new Blob(['hello']))).toEqual({ ok: false, fault: expect.stringMatching(/joint_states|not MCAP/) });
    expect(await read_mcap(new Blob(['x'.repeat(100)]))).toEqual({ ok: false, fault: expect.stringMatching(/not MCAP/) });
  });
});
