// Signals for redrawing: `changes` once per change, `frames` with each pose (30 per second),
// `beats` a few times per second while poses arrive. Signals call a new listener at once; the
// listeners here skip that call.

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

  /** Applies many changes as one change with one pose. */
  at_once(changes: () => void): void {
    this.quiet_ = true;
    changes();
    this.quiet_ = false;
    this.change();
    this.frames_.value += 1;
    this.beat();
  }
}

/** Calls the listener on later changes. Returns a function that ends it. */
export function from_now(changes: ReadonlySignal<number>, listener: () => void): () => void {
  let first = true;
  return changes.subscribe(() => {
    if (!first) untracked(listener);
    first = false;
  });
}
