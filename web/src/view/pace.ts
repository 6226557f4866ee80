// How often and how finely the view is drawn: it gives way when drawings take long, so that the
// page answers clicks on a machine that has other things to do. Pure: told how long each took.

/** What a drawing at this level leaves out; each level takes about half as long as the one before. */
export interface Level { resolution: number; shadows: boolean; ghosts: boolean }

export const kLevels: readonly Level[] = [
  { resolution: 1, shadows: true, ghosts: true },
  { resolution: 1, shadows: false, ghosts: true },
  { resolution: 0.6, shadows: false, ghosts: false },
  { resolution: 0.35, shadows: false, ghosts: false },
];

const kLeastFrame_ms = 1000 / 31;
const kLong_ms = 120;
const kQuick_ms = 25;
// So many in a row, so that one hiccup, or one quick drawing between slow ones, changes nothing.
const kLongInARow = 2;
const kQuickInARow = 90;
// Of the time, drawing may take at most a half, and on the last levels a quarter.
const kShare = 2;
const kShareWhenSlow = 4;
const kLongestPause_ms = 2_000;

export class Pace {
  private level_ = 0;
  private long_ = 0;
  private quick_ = 0;

  get level(): Level {
    return kLevels[this.level_] ?? { resolution: 1, shadows: true, ghosts: true };
  }

  /** A drawing took so long; answers how long after its beginning the next one may begin. */
  took(took_ms: number): number {
    this.long_ = took_ms > kLong_ms ? this.long_ + 1 : 0;
    this.quick_ = took_ms < kQuick_ms ? this.quick_ + 1 : 0;
    if (this.long_ >= kLongInARow && this.level_ + 1 < kLevels.length) this.change(1);
    if (this.quick_ >= kQuickInARow && this.level_ > 0) this.change(-1);
    const share = this.level_ > 1 ? kShareWhenSlow : kShare;
    return Math.max(kLeastFrame_ms - 1, Math.min(share * took_ms, took_ms + kLongestPause_ms));
  }

  private change(by: number): void {
    this.level_ += by;
    this.long_ = 0;
    this.quick_ = 0;
  }
}
