// Builds snapshots of a session at a time, in the server's format. Pure.

import type { Arm, SequencedMessage } from '../server/messages';
import { Facts } from './facts';
import { ended_from } from './job_book';

type ToldSnapshot = Extract<SequencedMessage, { type: 'snapshot' }>;
/** `ended_from_s` is only in the page's own snapshots (see JobBook). */
export type Snapshot = ToldSnapshot & { data: { ended_from_s?: number | null } };

/**
 * Combines entries into one snapshot. Returns null if the first is not a snapshot, because the
 * state is then unknown.
 */
export function folded(entries: readonly SequencedMessage[]): Snapshot | null {
  const [first, last] = [entries[0], entries.at(-1)];
  if (first?.type !== 'snapshot' || !last) return null;
  const facts = new Facts();
  for (const message of entries) facts.apply(message);
  return {
    stream: last.stream, seq: last.seq, type: 'snapshot', t_s: last.t_s, at: last.at,
    data: {
      cell: first.data.cell, policy: facts.policy, speed: facts.speed, stopped: facts.stopped, arms: [...facts.arms.values()],
      jobs: facts.all_jobs(), queue: facts.book.order, objects: facts.objects,
      ended_from_s: facts.book.ended_from_s,
    },
  };
}

/**
 * Returns the state before the events `led`, which led to a snapshot: everything they do not
 * mention was as in the snapshot.
 */
export function before_all({ data, ...first }: ToldSnapshot, led: readonly SequencedMessage[]): Snapshot {
  const arms = new Set(led.flatMap((message) => (message.type === 'arm' ? [message.data.name] : [])));
  const jobs = new Set(led.flatMap((message) => (message.type === 'job' ? [message.data.id] : [])));
  const [next] = led;
  // The events begin with the session, when every arm was idle.
  const is_whole = next?.seq === 1;
  // The events contain all jobs that ended meanwhile; the snapshot the jobs before.
  const from_s = ended_from(data.jobs);
  const idle = data.arms.map((arm) => (arms.has(arm.name) ? at_rest(arm) : arm));
  return {
    ...first, type: 'snapshot', seq: (next?.seq ?? 1) - 1, t_s: is_whole ? 0 : next?.t_s ?? first.t_s, at: next?.at ?? first.at,
    data: {
      ...data, gap: false, stopped: false, arms: is_whole ? idle : data.arms.filter(({ name }) => !arms.has(name)),
      jobs: data.jobs.filter(({ id }) => !jobs.has(id)),
      ended_from_s: is_whole || from_s === null ? null : Math.min(from_s, next?.t_s ?? from_s),
    },
  };
}

/** Returns the first state of a session. */
export function beginning_of({ stream, at }: Pick<SequencedMessage, 'stream' | 'at'>, t_s: number, cell: Pick<Snapshot['data'], 'cell' | 'policy' | 'speed' | 'arms' | 'objects'>): Snapshot {
  const queue = { stopped: false, queued: [], backlog: [], scheduled: [], running: [] };
  return { stream, at, seq: 0, type: 'snapshot', t_s, data: { ...cell, stopped: false, jobs: [], queue } };
}

/** Returns an arm before its first motion. */
export function at_rest(arm: Arm): Arm {
  return { ...arm, state: 'idle', job: null, progress: 0 };
}
