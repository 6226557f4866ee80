import { describe, expect, it } from 'vitest';
import { event_beside, events_at, events_in_words, type EventMark } from '../src/timeline/events';
import { kAxis_px, sheet_of } from '../src/timeline/sheet';

const at = (key: number, t_s: number, over: Partial<EventMark> = {}): EventMark => ({ key, t_s, level: 'warning', text: `event ${key}`, arms: [], ...over });

// Newest first, as the page keeps them.
const kEvents = [at(4, 30), at(3, 20), at(2, 20), at(1, 5)];
// 10 px per second; the left end of the axis is at 0 s.
const sheet = sheet_of(72 + 10 + 500, 100, { length_s: 50, fixed_from_s: 0 }, 40);
const foot = 100 - kAxis_px;

describe('Timeline events', () => {
  it('are found on the strip above the axis, with all on the same mark', () => {
    expect(events_at(kEvents, sheet, sheet.x(20) + 4, foot - 4).map(({ key }) => key)).toEqual([3, 2]);
    expect(events_at(kEvents, sheet, sheet.x(20) + 20, foot - 4)).toEqual([]);
    expect(events_at(kEvents, sheet, sheet.x(20), foot - 40)).toEqual([]);
  });

  it('are found only where they are drawn', () => {
    const later = sheet_of(582, 100, { length_s: 50, fixed_from_s: 5.3 }, 40);
    expect(events_at(kEvents, later, later.x(5), foot - 4)).toEqual([]);
  });

  it('are stepped through by keys from the newest to either end', () => {
    const keys = [event_beside(kEvents, null, -1)];
    for (const by of [-1, -1, -1, -1, 1] as const) keys.push(event_beside(kEvents, keys.at(-1) ?? null, by));
    expect(keys.map((event) => event?.key)).toEqual([4, 3, 2, 1, 1, 2]);
    expect(event_beside([], null, 1)).toBeNull();
  });

  it('are described by level, time, text and arms not named in the text', () => {
    const apart = at(1, 61, { level: 'error', text: 'left_hand and right_hand 12 mm apart; stopped right', arms: ['left', 'right'] });
    expect(events_in_words([apart], 64.5)).toBe('Error at 0:01:01.0, 3.5 s ago: left_hand and right_hand 12 mm apart; stopped right (left)');
    expect(events_in_words([at(1, 1), at(2, 1), at(3, 1), at(4, 1), at(5, 1)], 2).split('\n').at(-1)).toBe('and 2 more');
  });
});
