// The range of cell time that the timeline shows. The range follows now, or it is fixed. Pure.

export interface Span {
  /** Length in seconds of cell time. */
  length_s: number;
  /**
   * The beginning of a fixed range. Null if the range follows now: now is then at the share kNowAt
   * of the length.
   */
  fixed_from_s: number | null;
}

// More room is left for the past than for the future, because predictions rarely reach far.
export const kNowAt = 0.75;
export const kFollowing: Span = { length_s: 50, fixed_from_s: null };

const kShortest_s = 4;
const kLongest_s = 3600;
const kAhead_s = 600;

export function begin_of(span: Span, now_s: number): number {
  return span.fixed_from_s ?? now_s - kNowAt * span.length_s;
}

/**
 * Multiplies the length of the range by `factor`. In a fixed range, the time at the share `share`
 * of the length stays in place.
 */
export function zoomed(span: Span, factor: number, now_s: number, share = kNowAt): Span {
  const length_s = Math.min(kLongest_s, Math.max(kShortest_s, span.length_s * factor));
  if (span.fixed_from_s === null) return { length_s, fixed_from_s: null };
  const fixed_s = span.fixed_from_s + share * span.length_s;
  return within({ length_s, fixed_from_s: fixed_s - share * length_s }, now_s);
}

/** Fixes the range and moves it by `by_s`. */
export function moved(span: Span, by_s: number, now_s: number): Span {
  return within({ length_s: span.length_s, fixed_from_s: begin_of(span, now_s) + by_s }, now_s);
}

/**
 * Fixes the range around a time. Accepts any time, because a page may be opened at a past time
 * before it knows the current time.
 */
export function around(span: Span, t_s: number): Span {
  return { length_s: span.length_s, fixed_from_s: t_s - span.length_s / 2 };
}

function within(span: Span, now_s: number): Span {
  if (span.fixed_from_s === null) return span;
  const from_s = Math.min(now_s + kAhead_s - span.length_s, Math.max(-0.5 * span.length_s, span.fixed_from_s));
  return { ...span, fixed_from_s: from_s };
}

/** Returns the smallest step between time labels with which there are at most `most` labels. */
export function tick_of(length_s: number, most: number): number {
  const wanted_s = length_s / Math.max(1, most);
  const steps = [0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1200];
  return steps.find((step) => step >= wanted_s) ?? 1200;
}
