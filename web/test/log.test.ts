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

describe('what the server told', () => {
  it('is counted until an instant, that instant included', () => {
    const { log } = log_of(10, 1);
    expect([0.9, 1, 5.5, 10, 99].map((t_s) => log.count_until(t_s))).toEqual([0, 1, 5, 10, 10]);
  });

  it('begins anew with another run of the server', () => {
    const { log } = log_of(3, 1);
    const turn = log.turn;
    log.push(told(1, 0.5, 'another'));
    expect(seqs(log)).toEqual([1]);
    expect(log.turn).not.toBe(turn);
  });

  it('has what was before its first put before it, and says that counts have changed', () => {
    const { log } = log_of(2, 10);
    const turn = log.turn;
    log.put_before([told(0, 5)]);
    expect([seqs(log), log.count_until(5), log.turn === turn]).toEqual([[0, 1, 2], 1, false]);
  });

  it('is folded seldom: not before it reaches back twice as long as is kept, and then into one', () => {
    const { log, folds } = log_of(600, 1);
    log.trim();
    expect([folds, log.entries.length]).toEqual([[], 600]);
    log.push(told(602, 602));
    log.trim();
    expect(folds).toEqual([302]);  // until 302 s: 300 s before the last one
    expect([log.entries.length, log.entries[0]?.seq]).toEqual([300, 302]);
  });

  it('is folded by half where there is too much of it, however new', () => {
    const { log, folds } = log_of(11, 0.001, 10);
    log.trim();
    expect(folds).toEqual([5]);
    expect(seqs(log)).toEqual([5, 6, 7, 8, 9, 10, 11]);
  });

  it('is torn where a snapshot says that events before it were never heard', () => {
    const { log } = log_of(2, 1);
    log.push(message(snapshot(9, { gap: true })));
    expect([0, 1, 2, 3].map((count) => log.is_torn_after(count))).toEqual([false, false, true, false]);
  });
});

describe('the numbers of events', () => {
  const count = (...all: ['snapshot' | 'job', number][]) => all.reduce((numbers, [type, seq]) => counted(numbers, { type, seq } as SequencedMessage), kNoNumbers);

  it('tell what was left out, and what came twice', () => {
    expect(count(['snapshot', 4], ['job', 5], ['job', 8], ['job', 8], ['job', 6])).toEqual({ last: 8, missed: 2, doubled: 2 });
  });
  it('begin anew with a snapshot, which holds all until its own', () => {
    expect(count(['job', 3], ['job', 3], ['snapshot', 20])).toEqual({ last: 20, missed: 0, doubled: 0 });
  });
});

describe('when an arm was stopped', () => {
  const arm = (state: Arm['state'], t_s: number) => message(envelope('arm', 1, arm_json('left', { state }), { t_s }));
  const after = (...all: SequencedMessage[]) => {
    const book = new HaltBook();
    all.forEach((one) => book.take(one));
    return book.all.get('left')?.map(({ from_s, to_s }) => [from_s, to_s]) ?? [];
  };

  it('is from when it is told until it is told otherwise, each time', () => {
    expect(after(arm('moving', 1), arm('stopped', 2), arm('stopped', 3), arm('idle', 5), arm('fault', 7))).toEqual([[2, 5], [7, null]]);
  });
  it('goes on through a fault that follows a stop', () => {
    expect(after(arm('stopped', 2), arm('fault', 3), arm('idle', 4))).toEqual([[2, 4]]);
  });
  it('is known from a snapshot, too', () => {
    expect(after(message(snapshot(3, { arms: [arm_json('left', { state: 'stopped' })] })), arm('idle', 6))).toEqual([[3, 6]]);
  });
});
