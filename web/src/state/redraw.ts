// When the page is drawn anew after changes: what comes in a burst once, and after a drawing that took long
// not before as much time has passed again, so that clicks and keys always find room between two of them.

import type { Timers } from '../server/connection';

const kBurst_ms = 30;
const kLongestRest_ms = 500;

export class Redraw {
  /** Something has changed since it was drawn last. */
  private asked_ = false;
  /** It is waited for the time to draw, or for the drawing's end. */
  private waits_ = false;

  constructor(private readonly draw_: () => void, private readonly timers_: Timers, private readonly now_ms_: () => number) {}

  /** By a timer, as a browser that is busy with the 3D view gives out few animation frames. */
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
    // Components are drawn after this returns, before the next task.
    this.timers_.set(() => this.wait(Math.max(kBurst_ms, Math.min(kLongestRest_ms, this.now_ms_() - began_ms))), 0);
  }

  /** Nothing has changed for a while. */
  private rest(): void {
    this.waits_ = false;
  }
}
