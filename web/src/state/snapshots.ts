// Builds snapshots of a session's state at a time, in the server's format. Pure.

import type { Arm, SequencedMessage } from '../server/messages';
import { Facts } from './facts';
import { ended_from } from './job_book';

type ToldSnapshot = Extract<SequencedMessage, { type: 'snapshot' }>;
/** A snapshot. Only snapshots that the page made itself have `ended_from_s` (see JobBook). */
export type Snapshot = ToldSnapshot & { data: { ended_from_s?: number | null } };

/**
 * Combines entries of the log into one snapshot. Returns null if the first entry is not a snapshot,
 * because the state is then unknown.
 */
export function folded(entries: readonly SequencedMessage[]): Snapshot | null {
  const [first, last] = [entries[0], entries.at(-1)];
  if (first?.type !== 'snapshot' || !last) return null;
  const facts = new Facts();
  for (const message of entries) facts.apply(message);
  return {
    stream: last.stream, seq: last.seq, type: 'snapshot', t_s: last.t_s, at: last.at,
    data: {
      cell: first.data.cell, policy: facts.policy, speed: facts.speed, stopped: facts.stopped, speed_override: facts.speed_override, arms: [...facts.arms.values()],
      jobs: facts.all_jobs(), queue: facts.book.order, objects: facts.objects, held: facts.held, io: facts.signals,
      ended_from_s: facts.book.ended_from_s,
    },
  };
}

/**
 * Returns the state before the events `led`, whose last state is the given snapshot. Arms and jobs
 * that the events do not mention are as in the snapshot.
 */
export function before_all({ data, ...first }: ToldSnapshot, led: readonly SequencedMessage[]): Snapshot {
  const arms = new Set(led.flatMap((message) => (message.type === 'arm' ? [message.data.name] : [])));
  const jobs = new Set(led.flatMap((message) => (message.type === 'job' ? [message.data.id] : [])));
  const [next] = led;
  // If the events begin with the session, every arm was idle before them.
  const is_whole = next?.seq === 1;
  // The events contain all jobs that ended during them. The snapshot contains the jobs that ended
  // before.
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

/** Returns the state at the beginning of a session, without jobs. */
export function beginning_of({ stream, at }: Pick<SequencedMessage, 'stream' | 'at'>, t_s: number, cell: Pick<Snapshot['data'], 'cell' | 'policy' | 'speed' | 'arms' | 'objects'>): Snapshot {
  const queue = { stopped: false, queued: [], backlog: [], scheduled: [], running: [] };
  return { stream, at, seq: 0, type: 'snapshot', t_s, data: { ...cell, stopped: false, jobs: [], queue } };
}

/** Returns the arm as it was before its first motion. */
export function at_rest(arm: Arm): Arm {
  return { ...arm, stop_cause: null, state: 'idle', job: null, progress: 0, link: 'up', link_detail: null, drives_on: true };
}
