// The periods in which each arm was stopped or had a fault, whether it had a job or not.

import type { Arm, SequencedMessage } from '../server/messages';
import { remember, type Pause as JobPause } from './job_book';

type Halt = Omit<JobPause, 'why'>;

export type Halts = ReadonlyMap<string, readonly Halt[]>;

export class HaltBook {
  private readonly halts_ = new Map<string, Halt[]>();

  get all(): Halts { return this.halts_; }

  clear(): void {
    this.halts_.clear();
  }

  take(message: SequencedMessage): void {
    if (message.type === 'arm') this.take_arm(message.data, message.t_s);
    if (message.type === 'snapshot') for (const arm of message.data.arms) this.take_arm(arm, message.t_s);
  }

  private take_arm({ name, state }: Arm, t_s: number): void {
    const known = this.halts_.get(name) ?? [];
    const last = known.at(-1);
    const is_halted = state === 'stopped' || state === 'fault';
    if (is_halted === (last?.to_s === null)) return;
    if (last && !is_halted) last.to_s = t_s;
    if (is_halted) remember(known, { from_s: t_s, to_s: null, stopped: true });
    this.halts_.set(name, known);
  }
}
