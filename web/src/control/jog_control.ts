// Jogging (hold-to-run): who has control, and the motion that lasts while a button is held. The
// server stops the arm if it receives no renewal within the lease (half a second). The page renews
// several times per lease. When the button is released, the page cancels the motion at once.

import { signal } from '@preact/signals';
import { shown_name } from '../names';
import { kText } from '../strings';
import type { Answer, Api } from '../server/api';
import type { Timers } from '../server/connection';
import type { ControlHolder, Jog } from '../server/messages';

const kBeats = 4;  // renewals in the duration of a lease
const kFirst_ms = 100;

type JogApi = Pick<Api, 'control' | 'take_control' | 'release_control' | 'jog' | 'renew_jog' | 'cancel_job'>;

/**
 * The button that is held, from the press until the release or the end of the motion. `job` is null
 * until the server answers.
 */
export interface Pressed { arm: string; state: string; job: string | null }

export class JogControl {
  readonly holder = signal<ControlHolder | null>(null);
  /** This page's control key, or null if it has no control. */
  readonly key = signal<string | null>(null);
  readonly pressed = signal<Pressed | null>(null);
  readonly refusal = signal<string | null>(null);
  /** The control holder that the server returned when this page last took control. */
  private taken_: ControlHolder | null = null;
  private asked_ = 0;  // counts the presses and releases: a late answer belongs to an older number

  /**
   * `has_ended` returns true if the page knows that a job has ended. The lease of an ended job is
   * not renewed.
   */
  constructor(private readonly api_: JogApi, private readonly timers_: Timers, private readonly has_ended_: (job: string) => boolean = () => false) {}

  async look(): Promise<void> {
    const answer = await this.api_.control();
    if (!answer.ok) return;
    const { holder } = answer.value;
    this.holder.value = holder;
    const own = this.taken_;
    if (this.key.value === null || (own && holder?.who === own.who && holder.since_at === own.since_at)) return;
    // This page no longer has control. The server stops the motion, so no cancel is sent.
    this.key.value = null;
    this.pressed.value = null;
    ++this.asked_;
    if (holder) this.refusal.value = kText.jog.lost_control(shown_name(holder.who));
  }

  /** Takes control, even if another user has it. */
  async take(who: string): Promise<void> {
    const answer = await this.api_.take_control(who);
    if (!this.accepted(answer)) return;
    this.holder.value = answer.value.holder;
    this.taken_ = answer.value.holder;
    this.key.value = answer.value.key ?? null;
  }

  async release_control(): Promise<void> {
    this.release();
    const key = this.key.value;
    if (key === null) return;
    this.key.value = null;
    this.accepted(await this.api_.release_control(key));
    await this.look();
  }

  async press(arm: string, state: string): Promise<void> {
    const key = this.key.value;
    if (key === null || this.pressed.value) return;
    const asked = ++this.asked_;
    this.pressed.value = { arm, state, job: null };
    const answer = await this.api_.jog(arm, state, key);
    const is_pressed = this.asked_ === asked && this.pressed.value !== null;
    if (!this.accepted(answer)) {
      if (is_pressed) this.pressed.value = null;
      return this.lose_control(answer);
    }
    const { job, lease_s } = answer.value;
    if (!is_pressed) return void this.api_.cancel_job(job.id);  // the button was released before the server answered
    this.pressed.value = { arm, state, job: job.id };
    this.beat(asked, lease_s);
  }

  release(): void {
    const pressed = this.pressed.value;
    if (!pressed) return;
    ++this.asked_;
    this.pressed.value = null;
    if (pressed.job !== null && !this.has_ended_(pressed.job)) void this.api_.cancel_job(pressed.job);
  }

  private beat(asked: number, lease_s: number): void {
    const every_ms = lease_s > 0 ? (1000 * lease_s) / kBeats : kFirst_ms;
    this.timers_.set(() => {
      const pressed = this.pressed.value;
      const key = this.key.value;
      if (!pressed || key === null || this.asked_ !== asked) return;
      if (pressed.job !== null && this.has_ended_(pressed.job)) {
        this.pressed.value = null;  // the arm is at the goal
        return;
      }
      void this.api_.renew_jog(pressed.arm, key).then((answer) => {
        if (answer.ok || this.asked_ !== asked) return;
        this.pressed.value = null;  // the goal was reached, the renewal was too late, or control was taken
        if (answer.problem.type.endsWith('jog-lease-expired')) this.refusal.value = `${kText.jog.lease_expired} ${answer.problem.detail ?? ''}`.trim();
        this.lose_control(answer);
      });
      this.beat(asked, lease_s);
    }, every_ms);
  }

  private lose_control(answer: Answer<Jog>): void {
    if (answer.ok || !answer.problem.type.endsWith('not-in-control')) return;
    this.key.value = null;
    this.refusal.value = answer.problem.detail ?? answer.problem.title;
    void this.look();
  }

  private accepted<T>(answer: Answer<T>): answer is { ok: true; value: T } {
    this.refusal.value = answer.ok ? null : (answer.problem.detail ?? answer.problem.title);
    return answer.ok;
  }
}
