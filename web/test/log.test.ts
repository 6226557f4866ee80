import { describe, expect, it } from 'vitest';
import type { Arm, SequencedMessage } from '../src/server/messages';
import { HaltBook } from '../src/state/halts';
import { Log } from '../src/state/log';
import { counted, kNoNumbers } from '../src/state/numbers';
import { arm_json, envelope, kStream, snapshot } from './samples';

const message = (text: string) => JSON.parse(text) as SequencedMessage;
const told = (seq: number, t_s = seq, stream = kStream) => message(envelope('monitor', seq, {}, { t_s, stream }));
const seqs = (log: Log) => log.entries.map(({ seq }) => seq);

function log_of(count: number, every_s: number, most?: number) {
  const folds: number[] = [];
  const log = new Log((entries) => {
    folds.push(entries.length);
    return entries.at(-1) ?? null;
  }, most);
  for (let i = 1; i <= count; i++) log.push(told(i, i * every_s));
  return { log, folds };
}

describe('Event log', () => {
  it('counts events up to and including a time', () => {
    const { log } = log_of(10, 1);
    expect([0.9, 1, 5.5, 10, 99].map((t_s) => log.count_until(t_s))).toEqual([0, 1, 5, 10, 10]);
  });

  it('restarts with another server session', () => {
    const { log } = log_of(3, 1);
    const turn = log.turn;
    log.push(told(1, 0.5, 'another'));
    expect(seqs(log)).toEqual([1]);
    expect(log.turn).not.toBe(turn);
  });

  it('accepts earlier events, and reports that counts have changed', () => {
    const { log } = log_of(2, 10);
    const turn = log.turn;
    log.put_before([told(0, 5)]);
    expect([seqs(log), log.count_until(5), log.turn === turn]).toEqual([[0, 1, 2], 1, false]);
  });

  it('folds old entries into one, rarely', () => {
    const { log, folds } = log_of(600, 1);
    log.trim();
    expect([folds, log.entries.length]).toEqual([[], 600]);
    log.push(told(602, 602));
    log.trim();
    expect(folds).toEqual([302]);  // folded up to 302 s, which is 300 s before the last event
    expect([log.entries.length, log.entries[0]?.seq]).toEqual([300, 302]);
  });

  it('folds half of the entries if there are too many', () => {
    const { log, folds } = log_of(11, 0.001, 10);
    log.trim();
    expect(folds).toEqual([5]);
    expect(seqs(log)).toEqual([5, 6, 7, 8, 9, 10, 11]);
  });

  it('reports a gap where a snapshot says that events were missed', () => {
    const { log } = log_of(2, 1);
    log.push(message(snapshot(9, { gap: true })));
    expect([0, 1, 2, 3].map((count) => log.is_torn_after(count))).toEqual([false, false, true, false]);
  });
});

describe('Event numbers', () => {
  const count = (...all: ['snapshot' | 'job', number][]) => all.reduce((numbers, [type, seq]) => counted(numbers, { type, seq } as SequencedMessage), kNoNumbers);

  it('count missed and doubled events', () => {
    expect(count(['snapshot', 4], ['job', 5], ['job', 8], ['job', 8], ['job', 6])).toEqual({ last: 8, missed: 2, doubled: 2 });
  });
  it('restart with a snapshot', () => {
    expect(count(['job', 3], ['job', 3], ['snapshot', 20])).toEqual({ last: 20, missed: 0, doubled: 0 });
  });
});

describe('Stops of an arm', () => {
  const arm = (state: Arm['state'], t_s: number) => message(envelope('arm', 1, arm_json('left', { state }), { t_s }));
  const after = (...all: SequencedMessage[]) => {
    const book = new HaltBook();
    all.forEach((one) => book.take(one));
    return book.all.get('left')?.map(({ from_s, to_s }) => [from_s, to_s]) ?? [];
  };

  it('last from their report until the report of the end', () => {
    expect(after(arm('moving', 1), arm('stopped', 2), arm('stopped', 3), arm('idle', 5), arm('fault', 7))).toEqual([[2, 5], [7, null]]);
  });
  it('continue through a fault that follows a stop', () => {
    expect(after(arm('stopped', 2), arm('fault', 3), arm('idle', 4))).toEqual([[2, 4]]);
  });
  it('are also known from a snapshot', () => {
    expect(after(message(snapshot(3, { arms: [arm_json('left', { state: 'stopped' })] })), arm('idle', 6))).toEqual([[3, 6]]);
  });
});
