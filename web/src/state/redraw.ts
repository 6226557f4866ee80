// Throttles redrawing: combines bursts, and after a slow redraw waits as long again, so that clicks
// and keys are handled in between.

import type { Timers } from '../server/connection';

const kBurst_ms = 30;
const kLongestRest_ms = 500;

export class Redraw {
  /** Something has changed since the last redraw. */
  private asked_ = false;
  /** A timer runs for the next redraw, or a redraw is in progress. */
  private waits_ = false;

  constructor(private readonly draw_: () => void, private readonly timers_: Timers, private readonly now_ms_: () => number) {}

  /** Uses a timer, because a browser busy with the 3D view has few animation frames. */
  ask(): void {
    this.asked_ = true;
    if (!this.waits_) this.wait(kBurst_ms);
  }

  private wait(delay_ms: number): void {
    this.waits_ = true;
    this.timers_.set(() => (this.asked_ ? this.draw() : this.rest()), delay_ms);
  }

  private draw(): void {
    this.asked_ = false;
    const began_ms = this.now_ms_();
    this.draw_();
    // Components are drawn after this function returns, before the next task.
    this.timers_.set(() => this.wait(Math.max(kBurst_ms, Math.min(kLongestRest_ms, this.now_ms_() - began_ms))), 0);
  }

  /** No change for a while. */
  private rest(): void {
    this.waits_ = false;
  }
}
