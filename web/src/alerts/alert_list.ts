// The alerts that the server keeps, with their acknowledgements: the same in every browser.

import { signal } from '@preact/signals';
import type { Answer, Api } from '../server/api';
import type { Timers } from '../server/connection';
import type { KeptAlert } from '../server/messages';

const kTogether_ms = 150;  // alerts published together need one request

export class AlertList {
  private readonly known_ = signal<readonly KeptAlert[]>([]);
  private timer_: number | null = null;

  constructor(private readonly api_: Pick<Api, 'alerts' | 'acknowledge'>, private readonly timers_: Timers) {}

  /** Newest first. */
  get all(): readonly KeptAlert[] {
    return this.known_.value;
  }

  get open(): KeptAlert[] {
    return this.all.filter(({ acknowledged }) => acknowledged === null);
  }

  of(id: string): KeptAlert | null {
    return this.all.find((alert) => alert.id === id) ?? null;
  }

  /** Requests the list soon. Call it when an alert may have been raised or acknowledged. */
  refresh_soon(): void {
    this.timer_ ??= this.timers_.set(() => {
      this.timer_ = null;
      void this.refresh();
    }, kTogether_ms);
  }

  async refresh(): Promise<void> {
    const answer = await this.api_.alerts();
    if (answer.ok) this.known_.value = answer.value.alerts;
  }

  async acknowledge(some: readonly KeptAlert[], who: string): Promise<Answer<unknown>> {
    const answer = await this.api_.acknowledge(some.map(({ id }) => id), who);
    await this.refresh();
    return answer;
  }
}
