// Changes of the speed override, of the cell (null) or of an arm. While the user drags a slider, one
// request is open at a time, and the next one has the newest value. Until the server has confirmed
// the value, the slider shows what the user set; then it shows the server's value, which another
// client may also change.

import { signal } from '@preact/signals';
import type { Timers } from '../server/connection';

type Target = string | null;
interface Wanted { readonly share: number; sent: boolean }

/** Time after which the server's value is shown, even if no event with the new value has come. */
export const kConfirmed_ms = 1000;

export class SpeedOverride {
  private readonly wanted_ = signal<ReadonlyMap<Target, Wanted>>(new Map());

  constructor(private readonly send_: (target: Target, share: number) => Promise<boolean>, private readonly timers_: Timers) {}

  /** Returns the value to show. `told` is the server's value. */
  shown(target: Target, told: number): number {
    return this.wanted_.value.get(target)?.share ?? told;
  }

  set(target: Target, share: number): void {
    const before = this.wanted_.value.get(target);
    if (before?.share === share) return;
    const is_open = before?.sent ?? false;
    this.want(target, { share, sent: is_open });
    if (!is_open) void this.send(target);
  }

  /** Call when the server has told a value. */
  confirm(target: Target, told: number): void {
    const wanted = this.wanted_.peek().get(target);
    if (wanted && !wanted.sent && wanted.share === told) this.want(target, null);
  }

  private async send(target: Target): Promise<void> {
    for (;;) {
      const wanted = this.wanted_.peek().get(target);
      if (!wanted) return;
      this.want(target, { share: wanted.share, sent: true });
      const accepted = await this.send_(target, wanted.share);
      const now = this.wanted_.peek().get(target);
      if (!accepted || !now) return this.want(target, null);
      if (now.share !== wanted.share) continue;
      const answered = { share: now.share, sent: false };
      this.want(target, answered);
      this.timers_.set(() => {
        if (this.wanted_.peek().get(target) === answered) this.want(target, null);
      }, kConfirmed_ms);
      return;
    }
  }

  private want(target: Target, wanted: Wanted | null): void {
    const next = new Map(this.wanted_.peek());
    if (wanted) next.set(target, wanted);
    else next.delete(target);
    this.wanted_.value = next;
  }
}
