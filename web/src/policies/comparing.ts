// The comparison of policies. The server runs it, and the page polls it while it runs.

import { signal } from '@preact/signals';
import type { Api } from '../server/api';
import type { Timers } from '../server/connection';
import type { Comparison } from '../server/messages';

const kAgain_ms = 400;

export class Comparing {
  /** The running or last comparison, or null if none is known. */
  readonly latest = signal<Comparison | null>(null);
  /** True if the server has no comparison. */
  readonly none_made = signal(false);
  readonly refusal = signal<string | null>(null);
  private timer_: number | null = null;

  constructor(
    private readonly api_: Pick<Api, 'comparison' | 'compare' | 'cancel_comparison'>,
    private readonly timers_: Timers,
  ) {}

  /** Fetches the comparison, even if another page started it. */
  async look(): Promise<void> {
    const answer = await this.api_.comparison();
    if (answer.ok) this.take(answer.value);
    else if (answer.problem.status === 404) {
      this.latest.value = null;
      this.none_made.value = true;
    }
    else if (this.latest.value?.state === 'running') this.again();  // tries again, because perhaps only the connection failed
  }

  async start(since_s: number | null): Promise<void> {
    const answer = await this.api_.compare(since_s === null ? {} : { since_s });
    this.refusal.value = answer.ok ? null : (answer.problem.detail ?? answer.problem.title);
    if (answer.ok) this.take(answer.value);
  }

  async cancel(): Promise<void> {
    const answer = await this.api_.cancel_comparison();
    if (answer.ok) this.take(answer.value);
  }

  private take(comparison: Comparison): void {
    this.latest.value = comparison;
    if (comparison.state === 'running') this.again();
  }

  private again(): void {
    this.timer_ ??= this.timers_.set(() => {
      this.timer_ = null;
      void this.look();
    }, kAgain_ms);
  }
}
