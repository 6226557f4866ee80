// The log of the server's events, from which past states are derived. Its size is bounded: entries
// that are some minutes old are folded into one snapshot.

import type { SequencedMessage } from '../server/messages';

/** Events of at least this much cell time stay in the log. */
const kKept_s = 300;
const kMost = 20_000;

export class Log {
  private entries_: SequencedMessage[] = [];
  private turn_ = 0;

  /**
   * `fold` combines entries into one snapshot. If there are more than `most` entries, about half of
   * them are folded.
   */
  constructor(private readonly fold_: (entries: readonly SequencedMessage[]) => SequencedMessage | null, private readonly most_ = kMost) {}

  get entries(): readonly SequencedMessage[] { return this.entries_; }

  /**
   * A number that changes when earlier entries are inserted, changed or removed, so that what was
   * derived from them becomes invalid.
   */
  get turn(): number { return this.turn_; }

  /** Appends an event. An event of another session clears the log first. */
  push(message: SequencedMessage): void {
    if (this.entries_.length > 0 && this.entries_[0]?.stream !== message.stream) this.clear();
    this.entries_.push(message);
  }

  /** Inserts events before all others. */
  put_before(messages: readonly SequencedMessage[]): void {
    this.entries_ = [...messages, ...this.entries_];
    this.turn_ += 1;
  }

  clear(): void {
    this.entries_ = [];
    this.turn_ += 1;
  }

  /** Returns the number of events up to and including a time. */
  count_until(t_s: number): number {
    let [low, high] = [0, this.entries_.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.entries_[middle]?.t_s ?? Infinity) <= t_s) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** Returns true if events are missing between the first `count` entries and the next entry. */
  is_torn_after(count: number): boolean {
    const next = this.entries_[count];
    return count > 0 && next?.type === 'snapshot' && next.data.gap === true;
  }

  /** Folds old entries, or entries above the limit. This is expensive, so it is done rarely. */
  trim(): void {
    const { length } = this.entries_;
    const [first, last] = [this.entries_[0], this.entries_[length - 1]];
    if (!first || !last) return;
    const too_old = last.t_s - first.t_s > 2 * kKept_s;
    if (!too_old && length <= this.most_) return;
    const count = Math.max(too_old ? this.count_until(last.t_s - kKept_s) : 0, length > this.most_ ? length >> 1 : 0);
    const folded = this.fold_(this.entries_.slice(0, count));
    this.entries_.splice(0, count, ...(folded ? [folded] : []));
    this.turn_ += 1;
  }
}
