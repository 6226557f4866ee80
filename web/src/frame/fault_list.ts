// The present faults of simulated arms, also those that other clients injected.

import { signal } from '@preact/signals';
import type { Answer, Api } from '../server/api';
import type { Fault, FaultRequest } from '../server/messages';

export class FaultList {
  private readonly known_ = signal<readonly Fault[]>([]);
  private readonly is_whole_ = signal(true);

  constructor(private readonly api_: Pick<Api, 'faults' | 'inject' | 'remove_fault'>) {}

  /** The present faults. If not `is_whole`, only those that were injected through this object. */
  get all(): readonly Fault[] { return this.known_.value; }
  /** False if the server cannot list faults. */
  get is_whole(): boolean { return this.is_whole_.value; }

  /** Fetches the list. If the server does not answer, the last list stays. */
  async refresh(): Promise<void> {
    if (!this.is_whole_.peek()) return;
    const answer = await this.api_.faults();
    if (answer.ok && answer.value !== null) this.known_.value = answer.value;
    if (answer.ok) this.is_whole_.value = answer.value !== null;
  }

  async inject(request: FaultRequest): Promise<Answer<Fault>> {
    const answer = await this.api_.inject(request);
    if (answer.ok) this.known_.value = [...this.known_.peek(), answer.value];
    await this.refresh();
    return answer;
  }

  async remove(id: string): Promise<Answer<unknown>> {
    const answer = await this.api_.remove_fault(id);
    if (answer.ok || answer.problem.status === 404) this.known_.value = this.known_.peek().filter((fault) => fault.id !== id);
    await this.refresh();
    return answer;
  }
}
