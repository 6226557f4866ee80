// What a click may ask of the server, with the answer shown where it concerns everyone.

import { signal } from '@preact/signals';
import { short_wall_time } from '../wall_time';
import type { Answer, Api } from '../server/api';
import type { Timers } from '../server/connection';
import { follow_job } from '../server/follow_job';
import type { Problem, SceneObject } from '../server/messages';
import type { Store } from './store';

export class Actions {
  /** The last thing that the server refused, until it is put away. */
  readonly refusal = signal<string | null>(null);
  /** A stop was asked for and is not answered yet. */
  readonly stopping = signal(false);

  constructor(
    private readonly api_: Api, private readonly store_: Store, private readonly timers_: Timers,
    readonly retry_connection: () => void,
  ) {}

  /** Keeps a job's details fresh until it ends or the answer is called. */
  follow_job(id: string): () => void {
    return follow_job(id, this.api_, this.store_, this.timers_);
  }

  /** Asked even when the connection seems lost: it may be the page that hears nothing. */
  async stop(): Promise<void> {
    this.stopping.value = true;
    if (await this.ask('Stop all', this.api_.stop())) this.store_.set_stopped(true);
    this.stopping.value = false;
  }

  async resume(): Promise<void> {
    if (await this.ask('Resume', this.api_.resume())) this.store_.set_stopped(false);
  }

  async stop_arm(name: string): Promise<void> {
    await this.ask(`Stop ${name}`, this.api_.stop_arm(name));
  }

  async resume_arm(name: string): Promise<void> {
    await this.ask(`Resume ${name}`, this.api_.resume_arm(name));
  }

  async change_policy(policy: string): Promise<void> {
    await this.ask(`The policy ${policy}`, this.api_.change_policy(policy));
  }

  /** Along a way that the server plans, at this share of its speed. */
  async send_to(name: string, state: string, speed: number): Promise<void> {
    const job = { name: `${name} to ${state}`, arm: name, move_to: { named: state }, velocity_scaling_factor: speed };
    await this.ask(`Send ${name} to ${state}`, this.api_.post_job(JSON.stringify(job)));
  }

  async move_object(object: SceneObject, xyz: [number, number, number]): Promise<boolean> {
    return this.ask(`Move ${object.name}`, this.api_.put_object({ ...object, xyz }));
  }

  async replan(id: string): Promise<void> {
    await this.ask(`Another way for ${id}`, this.api_.replan_job(id));
  }

  /** Larger goes first; it counts at once. */
  async set_priority(id: string, priority: number): Promise<void> {
    await this.ask(`Priority ${priority} of ${id}`, this.api_.amend_job(id, { priority }));
  }

  async cancel(id: string): Promise<void> {
    await this.ask(`Cancel ${id}`, this.api_.cancel_job(id));
  }

  async ask(what: string, answer: Promise<Answer<unknown>>): Promise<boolean> {
    const got = await answer;
    this.refusal.value = got.ok ? null : why_not(what, got.problem);
    return got.ok;
  }
}

/** Status 0: nobody has answered, so that nobody knows whether it was heard. */
function why_not(what: string, problem: Problem): string {
  if (problem.status !== 0) return `${what} was refused: ${problem.detail ?? problem.title}`;
  return `${what} was not answered at ${short_wall_time(Date.now(), Date.now())}: the server may not have heard it, and arms may still move. Ask again, or use the cell's own emergency stop.`;
}
