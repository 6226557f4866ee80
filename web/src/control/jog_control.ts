// Moves by hand: who has control, and an arm that goes on only as long as somebody holds a button. The server
// brakes it when it has not heard of that for half a second; here it is told several times in that time, and
// at once when the button is let go.

import { signal } from '@preact/signals';
import { shown_name } from '../names';
import { kText } from '../strings';
import type { Answer, Api } from '../server/api';
import type { Timers } from '../server/connection';
import type { ControlHolder, Jog } from '../server/messages';

const kBeats = 4;  // in the time of a lease
const kFirst_ms = 100;

type JogApi = Pick<Api, 'control' | 'take_control' | 'release_control' | 'jog' | 'renew_jog' | 'cancel_job'>;

/** What is pressed: from when the button is pressed until it is let go, or the move has ended. */
export interface Pressed { arm: string; state: string; job: string | null }

export class JogControl {
  readonly holder = signal<ControlHolder | null>(null);
  /** That of this page; null: it has no control. */
  readonly key = signal<string | null>(null);
  readonly pressed = signal<Pressed | null>(null);
  readonly refusal = signal<string | null>(null);
  /** As this page took control last. */
  private taken_: ControlHolder | null = null;
  private asked_ = 0;  // each press has a number, so that late answers are known

  /** `has_ended`: whether the page has heard that a job has: its hold is not asked for any more. */
  constructor(private readonly api_: JogApi, private readonly timers_: Timers, private readonly has_ended_: (job: string) => boolean = () => false) {}

  async look(): Promise<void> {
    const answer = await this.api_.control();
    if (!answer.ok) return;
    const { holder } = answer.value;
    this.holder.value = holder;
    const own = this.taken_;
    if (this.key.value === null || (own && holder?.who === own.who && holder.since_at === own.since_at)) return;
    // The server brakes what was pressed.
    this.key.value = null;
    this.pressed.value = null;
    ++this.asked_;
    if (holder) this.refusal.value = kText.jog.lost_control(shown_name(holder.who));
  }

  /** From somebody else where there is one. */
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
    if (!is_pressed) return void this.api_.cancel_job(job.id);  // let go before the answer came
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
        this.pressed.value = null;  // it is there
        return;
      }
      void this.api_.renew_jog(pressed.arm, key).then((answer) => {
        if (answer.ok || this.asked_ !== asked) return;
        this.pressed.value = null;  // it is there, it was told too late, or somebody else has taken control
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
