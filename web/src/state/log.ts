// What the server told, in its order: what the state at an earlier time is derived from. It reaches back some
// minutes; what is older is folded into one snapshot, so that its size is bounded.

import type { SequencedMessage } from '../server/messages';

/** Cell time that is kept at least. */
const kKept_s = 300;
const kMost = 20_000;

export class Log {
  private entries_: SequencedMessage[] = [];
  private turn_ = 0;

  /** `fold`: all these as one. `most`: of so many events about half is folded, however new they are. */
  constructor(private readonly fold_: (entries: readonly SequencedMessage[]) => SequencedMessage | null, private readonly most_ = kMost) {}

  get entries(): readonly SequencedMessage[] { return this.entries_; }

  /** Another number whenever entries were put in, or taken out, before others. */
  get turn(): number { return this.turn_; }

  /** Another run of the server begins anew. */
  push(message: SequencedMessage): void {
    if (this.entries_.length > 0 && this.entries_[0]?.stream !== message.stream) this.clear();
    this.entries_.push(message);
  }

  /** What was before its first. */
  put_before(messages: readonly SequencedMessage[]): void {
    this.entries_ = [...messages, ...this.entries_];
    this.turn_ += 1;
  }

  clear(): void {
    this.entries_ = [];
    this.turn_ += 1;
  }

  /** So many were told by then. */
  count_until(t_s: number): number {
    let [low, high] = [0, this.entries_.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.entries_[middle]?.t_s ?? Infinity) <= t_s) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** Whether some between this many and the next one were never heard. */
  is_torn_after(count: number): boolean {
    const next = this.entries_[count];
    return count > 0 && next?.type === 'snapshot' && next.data.gap === true;
  }

  /** What is too old, or too much, is folded: seldom, as it costs. */
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
