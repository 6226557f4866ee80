// How often and how finely the view is drawn: it gives way when drawings take long, so that the
// page answers clicks on a machine that has other things to do. Pure: told how long each took.

/** What a drawing at this level leaves out: fine surfaces with shadows, ghosts, points. */
export interface Level { resolution: number; fine: boolean; ghosts: boolean }

export const kLevels: readonly [Level, ...Level[]] = [
  { resolution: 1, fine: true, ghosts: true },
  { resolution: 1, fine: false, ghosts: true },
  { resolution: 1, fine: false, ghosts: false },
  // Below that a picture is no good, and hardly quicker: only for machines that are busy otherwise.
  { resolution: 0.6, fine: false, ghosts: false },
  { resolution: 0.35, fine: false, ghosts: false },
];
// A level whose drawings take longer for a while is left for the next.
const kMost_ms = [28, 28, 45, 120, Infinity];
// One whose drawings take less is left for the one before: that may take twice as long, with ghosts half more.
const kLeast_ms = [0, 12, 20, 20, 40];
/** Where software draws: fine pictures are for what stands still. */
export const kFirstInSoftware = 1;

// A picture that takes no longer does not disturb the page; one that takes longer leaves it more and more time.
const kQuick_ms = 30;
const kMostShare = 4;
const kLongestPause_ms = 2_000;
// Thirty pictures a second and some to spare; twice as many where they cost next to nothing.
const kPeriod_ms = 28;
const kLeastPeriod_ms = 15;
const kRest = 2.5;
// So many in a row, so that one hiccup, or one quick drawing between slow ones, changes nothing.
const kLongInARow = 10;
const kVeryLong_ms = 120;
const kVeryLongInARow = 2;
const kQuickInARow = 90;
const kMostQuickInARow = 16 * kQuickInARow;

export class Pace {
  private long_ = 0;
  private very_long_ = 0;
  private quick_ = 0;
  private wanted_ = kQuickInARow;
  private since_rise_ = Infinity;
  private last_ms_ = 0;

  constructor(private level_ = 0) {}

  get level(): Level {
    return kLevels[this.level_] ?? kLevels[0];
  }

  /** Whether the page is better left alone when it has something to do. */
  get disturbs(): boolean {
    return this.last_ms_ > kQuick_ms;
  }

  /** A drawing took so long; answers how long after its beginning the next one may begin. */
  took(took_ms: number): number {
    const most_ms = kMost_ms[this.level_] ?? Infinity;
    this.last_ms_ = took_ms;
    this.long_ = took_ms > most_ms ? this.long_ + 1 : 0;
    this.very_long_ = took_ms > Math.max(kVeryLong_ms, most_ms) ? this.very_long_ + 1 : 0;
    this.quick_ = took_ms < (kLeast_ms[this.level_] ?? 0) ? this.quick_ + 1 : 0;
    this.since_rise_ += 1;
    if (this.long_ >= kLongInARow || this.very_long_ >= kVeryLongInARow) this.fall();
    else if (this.quick_ >= this.wanted_) this.rise();
    const share = Math.min(kMostShare, Math.max(1, took_ms / kQuick_ms));
    const least_ms = Math.min(kPeriod_ms, Math.max(kLeastPeriod_ms, kRest * took_ms));
    return Math.max(least_ms, Math.min(share * took_ms, took_ms + kLongestPause_ms));
  }

  private fall(): void {
    if (this.level_ + 1 >= kLevels.length) return;
    // What was tried in vain is tried again later, and later.
    this.wanted_ = this.since_rise_ < kQuickInARow ? Math.min(2 * this.wanted_, kMostQuickInARow) : kQuickInARow;
    this.change(1);
  }

  private rise(): void {
    if (this.level_ === 0) return;
    this.since_rise_ = 0;
    this.change(-1);
  }

  private change(by: number): void {
    this.level_ += by;
    this.long_ = 0;
    this.very_long_ = 0;
    this.quick_ = 0;
  }
}
