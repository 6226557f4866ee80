// The timeline as text, for the tooltip and for screen readers.

import { step_in_words } from '../jobs/steps';
import { clock, seconds, short_id, title_of, wait_in_words } from '../wording';
import type { Lane, Mark } from './lanes';
import { shown_name } from '../names';
import { kText } from '../strings';

const kWords = kText.timeline;

export function mark_in_words(mark: Mark, now_s: number): string {
  const title = shown_name(mark.label) || short_id(mark.job);
  const until = Number.isFinite(mark.to_s) ? kWords.until(clock(mark.to_s)) : mark.stopped ? kWords.until_resumed : kWords.end_unknown;
  if (mark.kind === 'motion') {
    return Number.isFinite(mark.to_s) ? kWords.motion(title, expectation(mark), clock(mark.from_s), clock(mark.to_s)) : kWords.motion_without_end(title, expectation(mark), clock(mark.from_s));
  }
  const why = mark.stopped && mark.waits_on === null ? kWords.was_stopped : mark.waits_on ? wait_in_words(mark.waits_on) : mark.kind === 'wait' ? kWords.waits_before_start : kWords.paused;
  const length = Number.isFinite(mark.to_s) ? ` (${seconds(mark.to_s - Math.max(mark.from_s, mark.expected ? now_s : 0))})` : '';
  return kWords.mark(title, why, until, length);
}

function expectation(mark: Mark): string {
  if (!mark.expected) return '';
  return mark.state === 'running' || mark.state === 'paused' ? kWords.running : kWords.expected;
}

/** Returns the predicted motions and waits of an arm in words, soonest first. */
export function lane_in_words(lane: Lane, now_s: number): string[] {
  const expected = lane.marks.filter((mark) => mark.expected).sort((a, b) => a.from_s - b.from_s);
  const words = expected.map((mark) => mark_in_words(mark, now_s));
  words.unshift(...lane.unpredicted.map((job) => kWords.not_predicted(title_of(job), step_in_words(job, true) ?? '')));
  if (lane.waiting > 0) words.push(kWords.not_scheduled(lane.waiting));
  return words.length > 0 ? words : [kWords.nothing_planned];
}
