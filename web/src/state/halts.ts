// The periods in which each arm was stopped, had a fault or no link, whether it had a job or not.

import type { Arm, SequencedMessage } from '../server/messages';
import { remember, type Pause as JobPause } from './job_book';
import { is_halted } from './shown_state';

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

  private take_arm(arm: Arm, t_s: number): void {
    const { name } = arm;
    const known = this.halts_.get(name) ?? [];
    const last = known.at(-1);
    const halted = is_halted(arm);
    if (halted === (last?.to_s === null)) return;
    if (last && !halted) last.to_s = t_s;
    if (halted) remember(known, { from_s: t_s, to_s: null, stopped: true });
    this.halts_.set(name, known);
  }
}
