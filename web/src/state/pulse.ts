// Signals that cause redrawing. `changes` fires once for each change, `frames` with each pose (30
// per second), and `beats` a few times per second while poses arrive. A signal calls a new listener
// at once; from_now() skips this first call.

import { signal, untracked, type ReadonlySignal } from '@preact/signals';

const kBeat_ms = 160;

export class Pulse {
  private readonly changes_ = signal(0);
  private readonly frames_ = signal(0);
  private readonly beats_ = signal(0);
  private beaten_at_ms_ = -Infinity;
  private quiet_ = false;

  constructor(private readonly now_ms_: () => number) {}

  get changes(): ReadonlySignal<number> { return this.changes_; }
  get frames(): ReadonlySignal<number> { return this.frames_; }
  get beats(): ReadonlySignal<number> { return this.beats_; }

  get is_quiet(): boolean { return this.quiet_; }

  change(): void {
    if (!this.quiet_) this.changes_.value += 1;
  }

  frame(): void {
    this.frames_.value += 1;
    const now_ms = this.now_ms_();
    if (now_ms - this.beaten_at_ms_ < kBeat_ms) return;
    this.beaten_at_ms_ = now_ms;
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
