// Commands to the server. If the server refuses a command, a banner says so.

import { signal } from '@preact/signals';
import { short_wall_time } from '../wall_time';
import type { Answer, Api } from '../server/api';
import type { Timers } from '../server/connection';
import { follow_job } from '../server/follow_job';
import type { Problem, SceneObject, SignalValue } from '../server/messages';
import { kText } from '../strings';
import { SpeedOverride } from './speed_override';
import type { Store } from './store';

const kWords = kText.command;

export class Actions {
  /** The last refusal, until the user dismisses it. */
  readonly refusal = signal<string | null>(null);
  /** True while a stop is sent and not answered yet. */
  readonly stopping = signal(false);
  /** The speed override that the user sets. */
  readonly speed: SpeedOverride;

  constructor(
    private readonly api_: Api, private readonly store_: Store, private readonly timers_: Timers,
    readonly retry_connection: () => void,
  ) {
    this.speed = new SpeedOverride((arm, share) => this.ask(kWords.speed(arm), this.api_.set_speed_override(arm, share)), timers_);
  }

  /** Polls a job until it ends or the returned function is called. */
  follow_job(id: string): () => void {
    return follow_job(id, this.api_, this.store_, this.timers_);
  }

  /**
   * Stops all arms. The stop is sent even if the connection seems lost, because the page may only
   * be unable to receive.
   */
  async stop(): Promise<void> {
    this.stopping.value = true;
    if (await this.ask(kWords.stop_all, this.api_.stop())) this.store_.set_stopped(true);
    this.stopping.value = false;
  }

  async resume(): Promise<void> {
    if (await this.ask(kWords.resume, this.api_.resume())) this.store_.set_stopped(false);
  }

  async stop_arm(name: string): Promise<void> {
    await this.ask(kWords.stop_arm(name), this.api_.stop_arm(name));
  }

  async resume_arm(name: string): Promise<void> {
    await this.ask(kWords.resume_arm(name), this.api_.resume_arm(name));
  }

  async change_policy(policy: string): Promise<void> {
    await this.ask(kWords.policy(policy), this.api_.change_policy(policy));
  }

  /**
   * Sends the arm to a named state on a planned path. `speed` is the share of the arm's speed (0 to
   * 1).
   */
  async send_to(name: string, state: string, speed: number): Promise<void> {
    const job = { name: kWords.job_name(name, state), arm: name, move_to: { named: state }, velocity_scaling_factor: speed };
    await this.ask(kWords.send(name, state), this.api_.post_job(JSON.stringify(job)));
  }

  async move_object(object: SceneObject, xyz: [number, number, number]): Promise<boolean> {
    return this.ask(kWords.move(object.name), this.api_.put_object({ ...object, xyz }));
  }

  async set_signal(name: string, value: SignalValue): Promise<void> {
    await this.ask(kWords.signal(name), this.api_.set_signal(name, value));
  }

  async replan(id: string): Promise<void> {
    await this.ask(kWords.replan(id), this.api_.replan_job(id));
  }

  /** Changes the priority of a job, at once. Jobs with larger priority go first. */
  async set_priority(id: string, priority: number): Promise<void> {
    await this.ask(kWords.priority(id, priority), this.api_.amend_job(id, { priority }));
  }

  async cancel(id: string): Promise<void> {
    await this.ask(kWords.cancel(id), this.api_.cancel_job(id));
  }

  async ask(what: string, answer: Promise<Answer<unknown>>): Promise<boolean> {
    const got = await answer;
    this.refusal.value = got.ok ? null : why_not(what, got.problem);
    return got.ok;
  }
}

/**
 * Returns the text for a refused command. Status 0 means that no answer came, so the server may or
 * may not have received the command.
 */
function why_not(what: string, problem: Problem): string {
  if (problem.status !== 0) return kText.server.was_refused(what, problem.detail ?? problem.title);
  return kText.server.was_not_answered(what, short_wall_time(Date.now(), Date.now()));
}
