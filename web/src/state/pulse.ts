// When to look again: `changes`, once per change; `frames`, with each pose (30 a second); `beats`, some
// times a second while poses come in. A signal tells its value at once, too, which a listener here has seen.

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

  /** Nobody looks at each of these changes: they are told as one, with a pose. */
  at_once(changes: () => void): void {
    this.quiet_ = true;
    changes();
    this.quiet_ = false;
    this.change();
    this.frames_.value += 1;
    this.beat();
  }
}

/** For what draws itself. The answer ends it. */
export function from_now(changes: ReadonlySignal<number>, listener: () => void): () => void {
  let first = true;
  return changes.subscribe(() => {
    if (!first) untracked(listener);
    first = false;
  });
}
