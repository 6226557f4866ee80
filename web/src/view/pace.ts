// Adapts the frame rate and the level of detail to the time that drawing takes, so that the page
// answers clicks on a busy machine. Pure: the caller reports each drawing time.

/**
 * A level of detail: the share of the full resolution, fine surfaces with shadows or quick
 * surfaces, and whether ghosts are drawn.
 */
export interface Level { resolution: number; fine: boolean; ghosts: boolean }

export const kLevels: readonly [Level, ...Level[]] = [
  { resolution: 1, fine: true, ghosts: true },
  { resolution: 1, fine: false, ghosts: true },
  { resolution: 1, fine: false, ghosts: false },
  // The next levels look poor and are only slightly faster. They are for machines that other
  // programs keep busy.
  { resolution: 0.6, fine: false, ghosts: false },
  { resolution: 0.35, fine: false, ghosts: false },
];
// By level: if drawings take longer than this for a while, the next level with less detail is used.
const kMost_ms = [28, 28, 45, 120, Infinity];
// By level: if drawings take less than this for a while, the next level with more detail is used.
// More detail may take twice as long; adding ghosts alone takes half as long again.
const kLeast_ms = [0, 12, 20, 20, 40];
/** The first level for software rendering, which draws fine frames only at rest. */
export const kFirstInSoftware = 1;

// A drawing that takes longer disturbs the page. The longer it takes, the longer is the pause after
// it.
const kQuick_ms = 30;
const kMostShare = 4;
const kLongestPause_ms = 2_000;
// The period is slightly below that of 30 frames per second. If drawing is cheap, there are twice
// as many frames.
const kPeriod_ms = 28;
const kLeastPeriod_ms = 15;
const kRest = 2.5;
// How many drawings in a row must be long, very long or quick before the level changes. A single
// slow or quick drawing changes nothing.
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

  /**
   * True if the last drawing was so long that the next should wait while the page has other work.
   */
  get disturbs(): boolean {
    return this.last_ms_ > kQuick_ms;
  }

  /**
   * Records how long a drawing took. Returns the time from the start of this drawing to the
   * earliest start of the next.
   */
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
    // If the level was raised shortly before, that was too early: the next try comes later.
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
