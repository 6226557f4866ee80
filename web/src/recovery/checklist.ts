// The checklist that a user must confirm before stopped arms move again. Each stop clears it. The
// page offers no way around it.

import { computed, signal } from '@preact/signals';
import type { Store } from '../state/store';
import { kText } from '../strings';
import { cause_of, waiting_arms } from './needs';

export const kChecks: readonly string[] = kText.recovery.checks;

export class Checklist {
  private readonly ticked_ = signal<ReadonlySet<number>>(new Set());
  /** Identifies the stop for which the items are ticked; null if no arm is stopped. */
  private of_: string | null = null;
  private readonly left_ = computed(() => kChecks.length - this.ticked_.value.size);

  constructor(private readonly store_: Pick<Store, 'arms' | 'job_of' | 'events' | 'stream'>) {}

  /**
   * Clears the ticks after another stop, or when no arm is stopped any more. Must be called after
   * each change of the store.
   */
  follow(): void {
    const stop = waiting_arms(this.store_).length === 0 ? null : `${this.store_.stream} ${cause_of(this.store_.events)?.key ?? ''}`;
    if (stop === this.of_) return;
    this.of_ = stop;
    if (this.ticked_.peek().size > 0) this.ticked_.value = new Set();
  }

  tick(check: number, yes: boolean): void {
    const ticked = new Set(this.ticked_.peek());
    if (yes) ticked.add(check);
    else ticked.delete(check);
    this.ticked_.value = ticked;
  }

  is_ticked(check: number): boolean {
    return this.ticked_.value.has(check);
  }

  /** The number of items still to be confirmed. */
  get left(): number {
    return this.left_.value;
  }
}
