// What a click may ask of the server, with the answer shown where it concerns everyone.

import { signal } from '@preact/signals';
import type { Api, Answer } from '../api';
import type { Timers } from '../connection';
import { follow_job } from '../follow_job';
import type { Store } from '../store';

/**
 * What stands in the drawer beside the cell: the form for a new job, a job's details, the
 * coordination diagram of two jobs (a across, b up), or nothing.
 */
export type Drawer =
  | { show: 'nothing' } | { show: 'new' } | { show: 'job'; id: string }
  | { show: 'diagram'; a: string; b: string };

export class Actions {
  readonly drawer = signal<Drawer>({ show: 'nothing' });
  /** The last thing that the server refused, until it is put away. */
  readonly refusal = signal<string | null>(null);

  constructor(
    readonly api: Api, private readonly store_: Store, private readonly timers_: Timers,
    readonly retry_connection: () => void,
  ) {}

  /** Keeps a job's details fresh until it ends or the answer is called. */
  follow_job(id: string): () => void {
    return follow_job(id, this.api, this.store_, this.timers_);
  }

  async stop(): Promise<void> {
    if (await this.ask('Stop', this.api.stop())) this.store_.set_stopped(true);
  }

  async resume(): Promise<void> {
    if (await this.ask('Resume', this.api.resume())) this.store_.set_stopped(false);
  }

  async cancel(id: string): Promise<void> {
    await this.ask(`Cancel ${id}`, this.api.cancel_job(id));
  }

  private async ask(what: string, answer: Promise<Answer<unknown>>): Promise<boolean> {
    const got = await answer;
    this.refusal.value = got.ok ? null : `${what} was refused: ${got.problem.detail ?? got.problem.title}`;
    return got.ok;
  }
}
