// Limits how often the page is redrawn. Changes in a burst are drawn together. After a slow redraw
// the page waits as long again, so that clicks and keys are handled in between.

import type { Timers } from '../server/connection';

const kBurst_ms = 30;
const kLongestRest_ms = 500;

export class Redraw {
  /** True if something has changed since the last redraw. */
  private asked_ = false;
  /** True while a timer for the next redraw is set, or a redraw is in progress. */
  private waits_ = false;

  constructor(private readonly draw_: () => void, private readonly timers_: Timers, private readonly now_ms_: () => number) {}

  /**
   * Requests a redraw. It is done by a timer, because a browser busy with the 3D view has few
   * animation frames.
   */
  ask(): void {
    this.asked_ = true;
    if (!this.waits_) this.wait(kBurst_ms);
  }

  private wait(delay_ms: number): void {
    this.waits_ = true;
    this.timers_.set(() => (this.asked_ ? this.draw() : this.rest()), delay_ms);
  }

  private draw(): void {
    const began_ms = this.now_ms_();
    this.draw_();
    this.asked_ = false;  // what changed meanwhile is drawn too: components are drawn after this function
    // Measures in a new task, because components are drawn after this function returns and before
    // the next task.
    this.timers_.set(() => this.wait(Math.max(kBurst_ms, Math.min(kLongestRest_ms, this.now_ms_() - began_ms))), 0);
  }

  /** Called when nothing has changed for a while. The next change starts a new timer. */
  private rest(): void {
    this.waits_ = false;
  }
}
