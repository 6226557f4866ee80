// Signals that cause redrawing. `arrivals` fires when an event waits to be applied, `changes` once for
// each change, `frames` with each pose (30 per second), and `beats` a few times per second while poses
// arrive. A signal calls a new listener
// at once; from_now() skips this first call.

import { signal, untracked, type ReadonlySignal } from '@preact/signals';

const kBeat_ms = 160;

export class Pulse {
  private readonly arrivals_ = signal(0);
  private readonly changes_ = signal(0);
  private readonly frames_ = signal(0);
  private readonly beats_ = signal(0);
  private beaten_at_ms_ = -Infinity;
  private quiet_ = false;

  constructor(private readonly now_ms_: () => number) {}

  get arrivals(): ReadonlySignal<number> { return this.arrivals_; }
  get changes(): ReadonlySignal<number> { return this.changes_; }
  get frames(): ReadonlySignal<number> { return this.frames_; }
  get beats(): ReadonlySignal<number> { return this.beats_; }

  get is_quiet(): boolean { return this.quiet_; }

  arrive(): void {
    this.arrivals_.value += 1;
  }

  change(): void {
    if (!this.quiet_) this.changes_.value += 1;
  }

  /** Fires `frames`, and `beats` if it is time. Calls `before_beat` before the latter. */
  frame(before_beat = (): void => undefined): void {
    this.frames_.value += 1;
    const now_ms = this.now_ms_();
    if (now_ms - this.beaten_at_ms_ < kBeat_ms) return;
    this.beaten_at_ms_ = now_ms;
    before_beat();
    this.beat();
  }

  beat(): void {
    this.beats_.value += 1;
  }

  /** Runs `changes`, and then fires each signal once, as for one change with one pose. */
  at_once(changes: () => void): void {
    this.quiet_ = true;
    changes();
    this.quiet_ = false;
    this.change();
    this.frames_.value += 1;
    this.beat();
  }
}

/** Calls the listener on later changes, not at once. The returned function removes the listener. */
export function from_now(changes: ReadonlySignal<number>, listener: () => void): () => void {
  let first = true;
  return changes.subscribe(() => {
    if (!first) untracked(listener);
    first = false;
  });
}
