// Adapts frame rate and detail to the drawing time, so that the page answers clicks on a busy
// machine. Pure: it is told each drawing time.

/** The detail of a level: resolution, fine surfaces with shadows, ghosts. */
export interface Level { resolution: number; fine: boolean; ghosts: boolean }

export const kLevels: readonly [Level, ...Level[]] = [
  { resolution: 1, fine: true, ghosts: true },
  { resolution: 1, fine: false, ghosts: true },
  { resolution: 1, fine: false, ghosts: false },
  // Lower levels look poor and are hardly faster: only for machines busy otherwise.
  { resolution: 0.6, fine: false, ghosts: false },
  { resolution: 0.35, fine: false, ghosts: false },
];
// A level is lowered if drawings take longer than this for a while.
const kMost_ms = [28, 28, 45, 120, Infinity];
// A level is raised if drawings take less than this for a while. The higher level may take twice as
// long, with ghosts half more.
const kLeast_ms = [0, 12, 20, 20, 40];
/** The first level for software rendering: fine frames only at rest. */
export const kFirstInSoftware = 1;

// Longer drawings disturb the page, so they leave it increasing pauses.
const kQuick_ms = 30;
const kMostShare = 4;
const kLongestPause_ms = 2_000;
// Slightly above 30 frames per second; twice as many if drawing is cheap.
const kPeriod_ms = 28;
const kLeastPeriod_ms = 15;
const kRest = 2.5;
// Required counts in a row, so that a single slow or quick drawing changes nothing.
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

  /** True if drawing should wait while the page has other work. */
  get disturbs(): boolean {
    return this.last_ms_ > kQuick_ms;
  }

  /** Records a drawing time. Returns how long after its start the next drawing may begin. */
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
    // After a failed rise, wait longer before the next try.
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
