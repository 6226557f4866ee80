// The measured joint positions of the last minutes, for past poses and for plots. They are kept in
// a ring buffer of fixed size.

const kFrames = 9_000;  // five minutes at 30 Hz

// The address of the page holds the shown time in hundredths of a second.
const kRounding_s = 0.01;

// If data of steady rate lacks at least this many frames in a row, there is a gap.
const kHole = 5;

interface Frame { t_s: number; row: readonly number[]; broken: boolean; fresh: boolean }

export interface Curves { t_s: number[]; q: number[][] }

/**
 * Says if there is data for a time (`kept`). If not, says where the time lies: before or after all
 * data, or in a gap.
 */
export type Heard = 'kept' | 'before' | 'after' | 'gap' | 'nothing';

export class Trace {
  private names_: string[] = [];
  private t_s_ = new Float64Array(0);
  private q_ = new Float32Array(0);
  /** 1 if there is a gap between this frame and the frame before. */
  private breaks_ = new Uint8Array(0);
  private broken_ = false;
  private count_ = 0;
  private next_ = 0;

  constructor(private capacity_ = kFrames) {}

  clear(): void {
    this.count_ = 0;
    this.next_ = 0;
    this.broken_ = false;
  }

  /** Notes that there is a gap before the next frame. */
  break_off(): void {
    this.broken_ = this.count_ > 0;
  }

  /** Replaces all frames. */
  load(names: readonly string[], t_s: readonly number[], q: readonly (readonly number[])[]): void {
    this.capacity_ = Math.max(kFrames, t_s.length);
    this.begin([...names]);
    this.t_s_.set(t_s);
    q.forEach((row, i) => this.q_.set(row, i * names.length));
    this.count_ = t_s.length;
    this.next_ = t_s.length % this.capacity_;
  }

  /**
   * Merges frames of steady rate from the server, ordered by time. Takes the frames before the
   * page's first frame, and the frames in gaps.
   */
  fill(names: readonly string[], t_s: readonly number[], q: readonly (readonly number[])[]): void {
    if (this.count_ === 0) this.begin([...names]);
    const columns = this.names_.map((name) => names.indexOf(name));
    if (columns.includes(-1) || t_s.length === 0) return;
    const own = Array.from({ length: this.count_ }, (_, i): Frame => ({
      t_s: this.time(i), row: this.names_.map((_, joint) => this.value(i, joint)), broken: this.breaks_[this.slot(i)] === 1, fresh: false,
    }));
    const fresh = t_s.flatMap((at_s, i): Frame[] => {
      const heard = this.heard(at_s);
      if (heard === 'kept' || heard === 'after') return [];
      return [{ t_s: at_s, row: columns.map((column) => q[i]?.[column] ?? NaN), broken: false, fresh: true }];
    });
    const hole_s = kHole * ((t_s.at(-1) ?? 0) - (t_s[0] ?? 0)) / Math.max(1, t_s.length - 1);
    const all = [...own, ...fresh].sort((a, b) => a.t_s - b.t_s);
    this.clear();
    all.forEach((frame, i) => {
      const before = all[i - 1];
      const meets = before !== undefined && before.fresh !== frame.fresh;
      this.put(frame.t_s, frame.row, before !== undefined && (frame.broken || meets) && frame.t_s - before.t_s > hole_s);
    });
  }

  get names(): readonly string[] {
    return this.names_;
  }

  push(t_s: number, q: Readonly<Record<string, number>>): void {
    const names = Object.keys(q);
    if (names.length !== this.names_.length || names.some((name, i) => name !== this.names_[i])) this.begin(names);
    const last = this.last_s;
    if (last !== null && t_s < last) this.clear();
    else if (last === t_s) return;
    this.put(t_s, names.map((name) => q[name] ?? NaN), this.broken_);
    this.broken_ = false;
  }

  get first_s(): number | null {
    return this.count_ === 0 ? null : this.time(0);
  }
  get last_s(): number | null {
    return this.count_ === 0 ? null : this.time(this.count_ - 1);
  }

  heard(t_s: number): Heard {
    const frame = this.frame_at(t_s);
    return typeof frame === 'number' ? 'kept' : frame;
  }

  /**
   * Returns the positions of all joints at the last frame up to a time. Null if there is no data
   * for the time.
   */
  at(t_s: number): Record<string, number> | null {
    const frame = this.frame_at(t_s);
    if (typeof frame !== 'number') return null;
    return Object.fromEntries(this.names_.map((name, joint) => [name, this.value(frame, joint)]));
  }

  /** Returns the positions of some joints between two times, thinned to at most `most` frames. */
  between(names: readonly string[], from_s: number, to_s: number, most = 600): Curves {
    const columns = names.map((name) => this.names_.indexOf(name));
    const begin = Math.max(0, this.last_until(from_s));
    const end = this.last_until(to_s);
    const step = Math.max(1, Math.ceil((end - begin + 1) / most));
    const curves: Curves = { t_s: [], q: names.map(() => []) };
    for (let i = begin; i <= end; i += step) {
      if (this.time(i) < from_s) continue;
      curves.t_s.push(this.time(i));
      columns.forEach((column, k) => curves.q[k]?.push(column < 0 ? NaN : this.value(i, column)));
    }
    return curves;
  }

  private put(t_s: number, row: readonly number[], broken: boolean): void {
    this.t_s_[this.next_] = t_s;
    this.q_.set(row, this.next_ * row.length);
    this.breaks_[this.next_] = broken ? 1 : 0;
    this.next_ = (this.next_ + 1) % this.capacity_;
    this.count_ = Math.min(this.capacity_, this.count_ + 1);
  }

  private begin(names: string[]): void {
    this.names_ = names;
    this.t_s_ = new Float64Array(this.capacity_);
    this.q_ = new Float32Array(this.capacity_ * names.length);
    this.breaks_ = new Uint8Array(this.capacity_);
    this.clear();
  }

  /**
   * Returns the index of the frame for a time. If there is no data for it, says where the time
   * lies.
   */
  private frame_at(t_s: number): number | Exclude<Heard, 'kept'> {
    const { first_s, last_s } = this;
    if (first_s === null || last_s === null) return 'nothing';
    if (t_s < first_s - kRounding_s) return 'before';
    if (t_s > last_s + kRounding_s) return 'after';
    const frame = Math.max(0, this.last_until(t_s));
    const next = frame + 1;
    if (next === this.count_ || this.breaks_[this.slot(next)] === 0 || t_s < this.time(frame) + kRounding_s) return frame;
    return t_s > this.time(next) - kRounding_s ? next : 'gap';
  }

  private slot(i: number): number {
    return (this.next_ - this.count_ + i + this.capacity_) % this.capacity_;
  }
  private time(i: number): number {
    return this.t_s_[this.slot(i)] ?? NaN;
  }
  private value(i: number, joint: number): number {
    return this.q_[this.slot(i) * this.names_.length + joint] ?? NaN;
  }

  private last_until(t_s: number): number {
    let [low, high] = [-1, this.count_ - 1];
    while (low < high) {
      const middle = Math.ceil((low + high) / 2);
      if (this.time(middle) <= t_s) low = middle;
      else high = middle - 1;
    }
    return low;
  }
}
